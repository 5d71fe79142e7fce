// Disks per area along an axis, of all and of each species. Average over time. The bins are those of the scene's box, whatever
// walls across this axis do; they are as long as those across the other axis are apart.

#include "observe/blocking.hpp"
#include "observe/geometry.hpp"
#include "observe/observables.hpp"
#include "observe/saved_observable.hpp"

#include <algorithm>
#include <vector>

namespace carom {

namespace {

class DensityProfile final : public SavedObservable<DensityProfile> {
 public:
  DensityProfile(const ObservableRequest& request, const ObservedRun& run)
      : SavedObservable(request, run),
        axis_(request.axis.value_or(1)),
        bins_(static_cast<std::size_t>(request.bins.value_or(100))),
        width_(run.scene.box.lengths()[axis_] / static_cast<double>(bins_)),
        kinds_(run.species_count() > 1 ? 1 + run.species_count() : 1),
        densities_(kinds_, BlockedColumn(bins_)) {}

  void sample(const State& state, const Totals&) override {
    std::vector<double> counts(kinds_ * bins_);
    for (std::size_t i = 0; i < run_.disks.count(); ++i) {
      const double bin = (state.positions(axis_, static_cast<Eigen::Index>(i)) - run_.scene.box.lower[axis_]) / width_;
      if (!(bin >= 0.0 && bin < static_cast<double>(bins_))) continue;  // beyond where a wall that moves began
      const auto at = static_cast<std::size_t>(bin);
      counts[at] += 1.0;
      if (kinds_ > 1) counts[(1 + static_cast<std::size_t>(run_.disks.species[i])) * bins_ + at] += 1.0;
    }
    const double across = box_of(run_.scene.box, state).lengths()[1 - axis_];
    for (std::size_t kind = 0; kind < kinds_; ++kind)
      for (std::size_t b = 0; b < bins_; ++b) densities_[kind].add(b, counts[kind * bins_ + b] / across);
  }

  [[nodiscard]] Measurement finish(double, const Totals&) override {
    const Box& box = run_.scene.box;
    Table table{.name = name()};
    Column middles{axis_ == 0 ? "x" : "y", "length", {}};
    for (std::size_t b = 0; b < bins_; ++b) middles.values.push_back(box.lower[axis_] + (static_cast<double>(b) + 0.5) * width_);
    table.columns.push_back(std::move(middles));
    for (std::size_t kind = 0; kind < kinds_; ++kind)
      densities_[kind].put(table, kind == 0 ? "density" : "density" + run_.suffix(kind - 1), "1 / area", 1.0 / width_);
    Measurement found{.name = name()};
    found.tables.push_back(std::move(table));
    return found;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(densities_);
  }

 private:
  int axis_;
  std::size_t bins_;
  double width_;
  std::size_t kinds_;  ///< all, then each species where there are several
  std::vector<BlockedColumn> densities_;
};

}  // namespace

MadeObservable make_density_profile(const ObservableRequest& request, const ObservedRun& run) {
  return std::make_unique<DensityProfile>(request, run);
}

}  // namespace carom
