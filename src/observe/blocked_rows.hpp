#pragma once
// Blocking for rows that get a sample each at every step, as the lags of a correlation do: the same levels and estimates as a
// Blocking per row gives, at a small part of the price. Sums of x and x^2 take the place of running means (no division), and all
// rows go from level to level together. x is taken from the first sample of its row on, which keeps the digits of the variance.

#include "observe/lag_rows.hpp"

#include <carom/blocking.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace carom {

class BlockedRows {
 public:
  BlockedRows() = default;
  explicit BlockedRows(std::size_t rows) : rows_(rows), first_(rows) {}

  /// The samples of the next steps, one line of all rows after the other; they are overwritten. Row k begins at step k = 0, 1, 2,
  /// ...: what is there before means nothing. Blocks are the same steps for all rows, so that a row may leave its first sample
  /// out of the longer ones. How many steps come together changes no bit.
  void add(std::span<double> samples);
  /// Nothing before the row has begun. `known`: see Blocking.
  [[nodiscard]] std::optional<Blocking::Estimate> estimate(std::size_t row, std::span<const double> known = {}) const;
  /// Compares the first part of a row with the rest, as Blocking does.
  [[nodiscard]] std::optional<Halves> halves(std::size_t row, std::span<const double> known = {}) const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(rows_, first_, levels_, at_power_, at_power_before_);
  }

 private:
  /// Blocks of 2^level steps.
  struct Level {
    std::uint64_t blocks = 0;  ///< of row 0
    std::vector<double> sum, square, waiting;

    template <class Archive>
    void serialize(Archive& archive) {
      archive(blocks, sum, square, waiting);
    }
  };

  [[nodiscard]] std::uint64_t steps() const { return levels_.empty() ? 0 : levels_.front().blocks; }
  [[nodiscard]] std::vector<Blocking::Level> levels_of(const std::vector<Level>& levels, std::size_t row) const;
  [[nodiscard]] BlockSums sums_of(std::size_t level) {
    Level& here = levels_[level];
    return {here.sum.data(), here.square.data(), here.waiting.data(), rows_, rows_};
  }
  /// Adds samples of which no step but the last may be a power of two.
  void add_some(std::span<double> samples);
  void add_tree(double* x);
  std::size_t add(std::size_t level, double* x, std::size_t lines);

  std::size_t rows_ = 0;
  std::vector<double> first_;  ///< sample of every row
  const LagRowsKernel* kernel_ = &lag_rows_kernel();
  std::vector<Level> levels_;
  std::vector<Level> at_power_, at_power_before_;  ///< as they were at the last two numbers of steps that are powers of two
};

}  // namespace carom
