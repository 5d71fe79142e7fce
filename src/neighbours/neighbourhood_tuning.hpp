#pragma once
// How wide should neighbourhoods be? Wide ones are left seldom, but every prediction has more neighbours to look at. The best
// width depends on density, on how the disks are spread, and changes while a system melts, clusters or is compressed; so it is
// found, and found again, by trying. What counts is work, not seconds: the same run takes the same decisions on every machine.

#include <cmath>
#include <cstdint>

namespace carom {

class HalfWidthSearch {
 public:
  /// Work in units of a look at four more neighbours: what it costs that so many disks left their neighbourhoods, so many entries
  /// of lists changed in consequence, and so many looks were taken. Measured: 100 to 150, 20 and 10 ns.
  [[nodiscard]] static double work(std::uint64_t left, std::uint64_t changes, std::uint64_t looks) {
    return 12.0 * static_cast<double>(left) + 2.0 * static_cast<double>(changes) + static_cast<double>(looks);
  }

  /// A width to start with for disks of mean diameter `sigma` and area `area` per disk: about seven neighbours on a list,
  /// which are looked at in one go. The neighbourhoods of two disks come within contact over an area of 16 h^2 + 16 h sigma + pi
  /// sigma^2.
  [[nodiscard]] static double first_half_width(double sigma, double area) {
    const double beyond = std::fmax(8.0 * area / 16.0 - sigma * sigma * 3.14159 / 16.0, 0.01 * sigma * sigma);
    return 0.5 * (std::sqrt(sigma * sigma + 4.0 * beyond) - sigma);
  }

  /// The half-width to go on with, after `half_width` has cost `work` per length travelled by all.
  ///
  /// A trial is held against the width before it, measured before and after: a system that changes by itself would
  /// otherwise make any trial look good, or bad.
  [[nodiscard]] double next(double half_width, double work) {
    switch (stage_) {
      case Stage::settled:
        if (std::abs(work - base_work_) <= 0.2 * base_work_ && ++settled_for_ < patience) return half_width;
        factor_ = step;
        improved_ = false;
        [[fallthrough]];
      case Stage::base:
        base_ = half_width;
        base_work_ = work;
        stage_ = Stage::trial;
        return base_ * factor_;
      case Stage::trial:
        trial_work_ = work;
        stage_ = Stage::base_again;
        return base_;
      case Stage::base_again:
        break;
    }
    const bool better = trial_work_ < 0.98 * 0.5 * (base_work_ + work);
    base_work_ = work;
    if (better) {
      improved_ = true;
      stage_ = Stage::base;
      return base_ * factor_;
    }
    if (factor_ == step && !improved_) {
      factor_ = 1.0 / step;
      stage_ = Stage::trial;
      return base_ * factor_;
    }
    stage_ = Stage::settled;
    settled_for_ = 0;
    return base_;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(stage_, base_, base_work_, trial_work_, factor_, improved_, settled_for_);
  }

 private:
  enum class Stage { base, trial, base_again, settled };
  static constexpr double step = 1.25;
  static constexpr int patience = 10;  ///< judgements after which a width is doubted anyway

  Stage stage_ = Stage::base;
  double base_ = 0.0;
  double base_work_ = 0.0;
  double trial_work_ = 0.0;
  double factor_ = step;
  bool improved_ = false;
  int settled_for_ = 0;
};

}  // namespace carom
