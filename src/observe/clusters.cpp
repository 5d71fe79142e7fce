// Clusters of disks whose surfaces are nearer than a gap: how many and how large, and whether one percolates. Averages over time.

#include "observe/blocking.hpp"
#include "observe/disk_clusters.hpp"
#include "observe/observables.hpp"
#include "observe/saved_observable.hpp"
#include "scene/contact_scales.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

namespace carom {

namespace {

class Clusters final : public SavedObservable<Clusters> {
 public:
  Clusters(const ObservableRequest& request, const ObservedRun& run)
      : SavedObservable(request, run),
        scales_(contact_scales<double>(run.scene.effects, run.disks)),
        gap_(request.range.value_or(0.1) * run.mean_diameter),
        sizes_(static_cast<std::size_t>(std::bit_width(run.disks.count()))) {}

  void sample(const State& state, const Totals&) override {
    std::vector<double> radii = run_.disks.radius;
    for (double& radius : radii) radius *= state.scale;
    const DiskClusters found(box_of(run_.scene.box, state), state.positions, radii, gap_, scales_);
    const auto count = static_cast<double>(radii.size());
    double clusters = 0.0, squares = 0.0, largest = 0.0;
    std::array<bool, 2> percolates = {};
    std::vector<double> in_octave(sizes_.size());
    for (std::size_t i = 0; i < radii.size(); ++i) {
      if (found.cluster(i) != i) continue;
      const auto size = static_cast<double>(found.size(i));
      clusters += 1.0, squares += size * size, largest = std::max(largest, size);
      in_octave[static_cast<std::size_t>(std::bit_width(found.size(i))) - 1] += 1.0;
      for (std::size_t axis = 0; axis < 2; ++axis)
        percolates[axis] = percolates[axis] || found.percolates(i, static_cast<int>(axis));
    }
    contacts_.add(2.0 * static_cast<double>(found.pairs()) / count);
    clusters_.add(clusters / count);
    mean_size_.add(squares / count);
    largest_.add(largest / count);
    percolating_x_.add(percolates[0] ? 1.0 : 0.0);
    percolating_y_.add(percolates[1] ? 1.0 : 0.0);
    percolating_.add(percolates[0] || percolates[1] ? 1.0 : 0.0);
    for (std::size_t k = 0; k < in_octave.size(); ++k) sizes_.add(k, in_octave[k] / count);
  }

  [[nodiscard]] Measurement finish(double, const Totals&) override {
    Measurement found{.name = name()};
    put(found, {.name = "neighbours"}, contacts_);
    put(found, {.name = "clusters_per_disk"}, clusters_);
    put(found, {.name = "mean_size"}, mean_size_);
    put(found, {.name = "largest"}, largest_);
    for (const auto& [name, blocking] : {std::pair{"percolating", &percolating_}, std::pair{"percolating_x", &percolating_x_},
                                         std::pair{"percolating_y", &percolating_y_}})
      if (run_.scene.box.is_circle)
        found.scalars.push_back({.name = name, .note = "a circular box has no two sides to be joined"});
      else
        put(found, {.name = name}, *blocking);
    Table table{.name = name()};
    table.columns = {{"size", "", {}}, {"size_to", "", {}}};
    for (std::size_t k = 0; k < sizes_.size(); ++k) {
      table.columns[0].values.push_back(std::ldexp(1.0, static_cast<int>(k)));
      table.columns[1].values.push_back(
          std::min(std::ldexp(1.0, static_cast<int>(k) + 1) - 1.0, static_cast<double>(run_.disks.count())));
    }
    sizes_.put(table, "clusters_per_disk", "");
    note_lower_bounds(found, sizes_.has_lower_bounds());
    found.tables.push_back(std::move(table));
    return found;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(sizes_, contacts_, clusters_, mean_size_, largest_, percolating_, percolating_x_, percolating_y_);
  }

 private:
  ContactScales<double> scales_;
  double gap_;
  BlockedColumn sizes_;  ///< of clusters of 1, 2 to 3, 4 to 7, ... disks
  Blocking contacts_, clusters_, mean_size_, largest_, percolating_, percolating_x_, percolating_y_;
};

}  // namespace

MadeObservable make_clusters(const ObservableRequest& request, const ObservedRun& run) {
  return std::make_unique<Clusters>(request, run);
}

}  // namespace carom
