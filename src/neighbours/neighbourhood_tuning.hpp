#pragma once
// The width of neighbourhoods. Wide ones are left seldom, but every prediction has more neighbours to examine. The best
// width depends on density, on how the disks are spread, and changes while a system melts, clusters or is compressed; so it is
// found by trial, again and again. What counts is work, not seconds: the same run takes the same decisions on every machine.

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace carom {

class HalfWidthSearch {
 public:
  /// Returns the work that so many disks took that left their neighbourhoods, so many entries of lists that changed in
  /// consequence, and so many groups of four neighbours that predictions examined after the first eight; in units of one such
  /// group. Measured: 100 to 150, 20 and 10 ns.
  [[nodiscard]] static double work(std::uint64_t left, std::uint64_t changes, std::uint64_t groups) {
    return 12.0 * static_cast<double>(left) + 2.0 * static_cast<double>(changes) + static_cast<double>(groups);
  }

  /// Returns a half-width to start with for disks of mean diameter `sigma` and area `area` per disk: about seven neighbours on a
  /// list, which are examined in one go. The neighbourhoods of two disks come within contact over an area of 16 h^2 + 16 h sigma
  /// + pi sigma^2.
  [[nodiscard]] static double first_half_width(double sigma, double area) {
    const double beyond = std::fmax(8.0 * area / 16.0 - sigma * sigma * 3.14159 / 16.0, 0.01 * sigma * sigma);
    return 0.5 * (std::sqrt(sigma * sigma + 4.0 * beyond) - sigma);
  }

  /// Returns the half-width to go on with, after `half_width` has cost `work` per length travelled by all.
  ///
  /// A trial is compared with the width before it, measured before and after: a system that changes by itself would otherwise
  /// make any trial look good, or bad.
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

/// Counts of what neighbourhoods of one width have cost.
struct TuningCounters {
  std::uint64_t neighbourhoods_left = 0;
  std::uint64_t groups_examined = 0;  ///< by predictions after collisions: of four neighbours each, after the first eight

  template <class Archive>
  void serialize(Archive& archive) {
    archive(neighbourhoods_left, groups_examined);
  }
};

/// Counts what neighbourhoods cost while a run goes on, and judges their half-width when enough has been counted.
class NeighbourhoodTuning {
 public:
  void count_left() { ++counters_.neighbourhoods_left; }
  /// Counts the predictions of two disks that have so many neighbours.
  void count_examined(std::uint32_t neighbours_a, std::uint32_t neighbours_b) {
    counters_.groups_examined += groups(neighbours_a) + groups(neighbours_b);
  }

  [[nodiscard]] const TuningCounters& counters() const { return counters_; }
  void set_counters(const TuningCounters& counters) { counters_ = counters; }
  /// Adds what another engine has counted.
  void add(const TuningCounters& counters) {
    counters_.neighbourhoods_left += counters.neighbourhoods_left;
    counters_.groups_examined += counters.groups_examined;
  }

  /// Begins anew: all neighbourhoods have just been made, and no disk leaves its own for a while.
  void restart() {
    settling_ = true;
    travelled_ = 0.0;
  }

  /// The half-width to go on with, at most `widest`, after disks have gone the mean path `path` (length) since the last call with
  /// neighbourhoods of this one. `spacing` is that of disks, `list_changes` counts the changes of neighbour lists so far. It
  /// requires neighbourhoods to be made anew where it differs.
  [[nodiscard]] double next(double half_width, double widest, double path, double spacing, std::uint64_t list_changes) {
    travelled_ += path;
    double to = half_width;
    if (settling_) {
      if (travelled_ < 4.0 * half_width) return half_width;
      settling_ = false;
    } else {
      const auto [left, examined] = counters_;
      if (travelled_ < 4.0 * spacing || left + examined < 4000) return half_width;
      const double work = HalfWidthSearch::work(left, list_changes - changes_before_, examined) / travelled_;
      to = std::min(search_.next(half_width, work), widest);
      settling_ = to != half_width;
    }
    travelled_ = 0.0;
    counters_ = {};
    changes_before_ = list_changes;
    return to;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(search_, settling_, travelled_, counters_, changes_before_);
  }

 private:
  [[nodiscard]] static std::uint32_t groups(std::uint32_t neighbours) { return (std::max(neighbours, 8U) - 5U) / 4U; }

  HalfWidthSearch search_;
  bool settling_ = true;    ///< the neighbourhoods are too new for their cost to be judged
  double travelled_ = 0.0;  ///< mean path of a disk since the half-width was last judged
  TuningCounters counters_;
  std::uint64_t changes_before_ = 0;  ///< list changes when it was last judged
};

}  // namespace carom
