#pragma once
// How wide should cages be? Wide ones are left seldom, but every prediction has more neighbours to look at. The best width
// depends on density, on how the disks are spread, and changes while a system melts, clusters or is compressed; so it is found,
// and found again, by trying. What counts is work, not seconds: the same run takes the same decisions on every machine.

#include <cmath>
#include <cstdint>

namespace carom {

class CageTuner {
 public:
  /// Work in units of a look at four more neighbours: what it costs that so many disks left their cages, so many entries
  /// of lists changed in consequence, and so many looks were taken. Measured: 100 to 150, 20 and 10 ns.
  [[nodiscard]] static double work(std::uint64_t left, std::uint64_t changes, std::uint64_t looks) {
    return 12.0 * static_cast<double>(left) + 2.0 * static_cast<double>(changes) + static_cast<double>(looks);
  }

  /// A width to start with for disks of mean diameter `sigma` and area `area` per disk: about seven neighbours on a list,
  /// which are looked at in one go. The cages of two disks come within contact over an area of 16 h^2 + 16 h sigma + pi sigma^2.
  [[nodiscard]] static double first_half_width(double sigma, double area) {
    const double beyond = std::fmax(8.0 * area / 16.0 - sigma * sigma * 3.14159 / 16.0, 0.01 * sigma * sigma);
    return 0.5 * (std::sqrt(sigma * sigma + 4.0 * beyond) - sigma);
  }

  /// The half-width to go on with, after `half_width` has cost `work` per length travelled by all.
  [[nodiscard]] double next(double half_width, double work) {
    if (stage_ == Stage::settled) {
      if (std::abs(work - best_work_) <= 0.2 * best_work_) return half_width;
      stage_ = Stage::start;
    }
    if (stage_ == Stage::start) {
      accept(half_width, work);
      improved_ = false;
      factor_ = step;
      stage_ = Stage::climbing;
    } else if (work < 0.98 * best_work_) {
      accept(half_width, work);
      improved_ = true;
    } else if (factor_ == step && !improved_) {
      factor_ = 1.0 / step;
    } else {
      stage_ = Stage::settled;
      return best_;
    }
    return best_ * factor_;
  }

 private:
  enum class Stage { start, climbing, settled };
  static constexpr double step = 1.2;

  void accept(double half_width, double work) {
    best_ = half_width;
    best_work_ = work;
  }

  Stage stage_ = Stage::start;
  double best_ = 0.0;
  double best_work_ = 0.0;
  double factor_ = step;
  bool improved_ = false;
};

}  // namespace carom
