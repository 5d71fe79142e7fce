#pragma once
// Pressure from momentum transfer: the virial that collisions hand over per unit of time, with its standard error.

#include <carom/observe.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace carom {

/// The rate at which a total increases, as a ratio estimate over blocks of time. Bounded memory: when there are 64 blocks,
/// neighbours are joined. So a long run ends with 32 to 63 blocks, each much longer than any correlation.
class BlockedRate {
 public:
  /// The total's value at a time later than the last one given; the first block begins at time 0 with total 0.
  void add(double time, double total);

  /// Returns total / time at the last point; empty before the first.
  [[nodiscard]] std::optional<double> rate() const;

  /// Standard error of rate(); empty with fewer than 8 blocks, where it would be a guess.
  [[nodiscard]] std::optional<double> standard_error() const;

  /// Compares the rate of the first part of the blocks with that of the rest; nothing where they are few, or their rate is not
  /// known well.
  [[nodiscard]] std::optional<Halves> halves() const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(blocks_, joined_, pending_, time_, total_);
  }

 private:
  struct Block {
    double duration;
    double increase;
    Block& operator+=(const Block& other) {
      duration += other.duration, increase += other.increase;
      return *this;
    }
  };
  /// Returns the standard error of the increase over the blocks from `begin` on, by `length` of them together. `all` is their
  /// sum.
  [[nodiscard]] double error_of_increase(std::size_t begin, std::size_t length, const Block& all) const;

  std::vector<Block> blocks_;
  std::size_t joined_ = 1;   ///< points that make one block
  std::size_t pending_ = 0;  ///< points in the last block
  double time_ = 0.0;
  double total_ = 0.0;
};

/// Z = 1 + W / (2 t N kT), with W the sum over collisions of sigma_ij times the normal impulse.
[[nodiscard]] constexpr double compressibility(double virial_rate, double disks, double temperature) {
  return 1.0 + virial_rate / (2.0 * disks * temperature);
}

/// Returns the mean size of a component of the velocity over that of a Maxwell gas of the same mean square, where d components
/// share one fixed kinetic energy: c = sqrt(d / 2) Gamma(d / 2) / Gamma((d + 1) / 2), which is 1 for many; 1 with d <= 0.
[[nodiscard]] double mean_speed_factor(double d);

}  // namespace carom
