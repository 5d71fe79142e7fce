// Disks per area along an axis, of all and of each species. Average over time. The bins cover all that the walls across this axis
// reach in the run, as far as that is known when it begins; they are as long as the walls across the other axis are apart.
//
// In a circular box the bins are rings of one width about the centre, or strips across an axis, and the area is that of a ring,
// or of the part of a strip inside the circle. As between walls, no centre comes nearer to the rim than its radius.

#include "observe/area_in_circle.hpp"
#include "observe/blocking.hpp"
#include "observe/observables.hpp"
#include "observe/saved_observable.hpp"
#include "observe/wall_reach.hpp"
#include "scene/observables_known.hpp"

#include <algorithm>
#include <numbers>
#include <vector>

namespace carom {

namespace {

class DensityProfile final : public SavedObservable<DensityProfile> {
 public:
  DensityProfile(const ObservableRequest& request, const ObservedRun& run)
      : SavedObservable(request, run),
        axis_(request.axis.value_or(run.scene.box.is_circle ? radial : 1)),
        bins_(static_cast<std::size_t>(request.bins.value_or(100))),
        from_(axis_ == radial ? 0.0 : run.scene.box.lower[axis_]),
        width_((axis_ == radial ? 0.5 * run.scene.box.lengths().x() : run.scene.box.lengths()[axis_]) /
               static_cast<double>(bins_)),
        kinds_(run.species_count() > 1 ? 1 + run.species_count() : 1),
        densities_(kinds_, BlockedColumn(bins_)) {
    for (std::size_t b = 0; b < bins_ && run.scene.box.is_circle; ++b) areas_.push_back(area_of(b));
  }

  void start(const State& state) override {
    if (run_.scene.box.is_circle) return;
    const Box reach = reach_of_walls(run_, state);
    from_ = reach.lower[axis_];
    width_ = reach.lengths()[axis_] / static_cast<double>(bins_);
  }

  void sample(const State& state, const Totals&) override {
    std::vector<double> counts(kinds_ * bins_);
    seen_ += run_.disks.count();
    for (std::size_t i = 0; i < run_.disks.count(); ++i) {
      const double bin = (place_of(state.positions.col(static_cast<Eigen::Index>(i))) - from_) / width_;
      if (!(bin >= 0.0 && bin < static_cast<double>(bins_))) {  // behind a wall whose way was not known
        ++outside_;
        continue;
      }
      const auto at = static_cast<std::size_t>(bin);
      counts[at] += 1.0;
      if (kinds_ > 1) counts[(1 + static_cast<std::size_t>(run_.disks.species[i])) * bins_ + at] += 1.0;
    }
    const double across = areas_.empty() ? box_of(run_.scene.box, state).lengths()[1 - axis_] : 0.0;
    for (std::size_t kind = 0; kind < kinds_; ++kind)
      for (std::size_t b = 0; b < bins_; ++b)
        densities_[kind].add(b, counts[kind * bins_ + b] / (areas_.empty() ? across : areas_[b]));
  }

  [[nodiscard]] Measurement finish(double, const Totals&) override {
    Table table{.name = name()};
    Column middles{axis_ == radial ? "r" : axis_ == 0 ? "x" : "y", "length", {}};
    for (std::size_t b = 0; b < bins_; ++b) middles.values.push_back(from_ + (static_cast<double>(b) + 0.5) * width_);
    table.columns.push_back(std::move(middles));
    for (std::size_t kind = 0; kind < kinds_; ++kind)
      densities_[kind].put(table, kind == 0 ? "density" : "density" + run_.suffix(kind - 1), "1 / area",
                           areas_.empty() ? 1.0 / width_ : 1.0);
    Measurement found{.name = name(), .note = note_on_disks_outside(outside_, seen_)};
    note_lower_bounds(found, std::ranges::any_of(densities_, &BlockedColumn::has_lower_bounds));
    found.tables.push_back(std::move(table));
    return found;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(from_, width_, densities_, seen_, outside_);
  }

 private:
  static constexpr int radial = detail::radial_axis;

  [[nodiscard]] double place_of(const Eigen::Vector2d& position) const {
    if (axis_ != radial) return position[axis_];
    return (position - 0.5 * (run_.scene.box.lower + run_.scene.box.upper)).norm();
  }

  /// Returns the area of a bin in a circular box.
  [[nodiscard]] double area_of(std::size_t bin) const {
    const auto before = static_cast<double>(bin);
    if (axis_ == radial) return std::numbers::pi * width_ * width_ * (2.0 * before + 1.0);
    Rectangle strip{run_.scene.box.lower, run_.scene.box.upper};
    strip.lower[axis_] = from_ + before * width_;
    strip.upper[axis_] = from_ + (before + 1.0) * width_;
    return area_in_circle(strip, run_.scene.box);
  }

  int axis_;
  std::size_t bins_;
  double from_, width_;        ///< of the first bin its begin, of each its width
  std::size_t kinds_;          ///< all, then each species where there are several
  std::vector<double> areas_;  ///< of each bin in a circular box; empty in others
  std::vector<BlockedColumn> densities_;
  std::uint64_t seen_ = 0, outside_ = 0;  ///< disks at the samples, in all and in no bin
};

}  // namespace

MadeObservable make_density_profile(const ObservableRequest& request, const ObservedRun& run) {
  return std::make_unique<DensityProfile>(request, run);
}

}  // namespace carom
