#pragma once
// The counts and sums of an engine while it runs.

#include "core/exact_sum.hpp"

#include <carom/state.hpp>

#include <algorithm>
#include <array>
#include <cstddef>

namespace carom {

/// Adds what another engine has counted of other events, but for its epochs and lists.
inline void add_counts(Counts& to, const Counts& more) {
  to.pair += more.pair, to.wall += more.wall, to.other += more.other, to.stale += more.stale;
  to.obstacle += more.obstacle, to.well += more.well, to.thermostat += more.thermostat;
  to.numerics.simultaneous += more.numerics.simultaneous;
  to.numerics.overlapping += more.numerics.overlapping;
  to.numerics.grazing += more.numerics.grazing;
  to.numerics.already_receding += more.numerics.already_receding;
  to.numerics.deepest_overlap = std::max(to.numerics.deepest_overlap, more.numerics.deepest_overlap);
}

/// Totals as they grow: sums without rounding.
struct RunningTotals : Counts {
  ExactSum virial, virial_yx;
  std::array<ExactSum, 4> wall_impulse, wall_shear, wall_energy, wall_work;
  ExactSum dissipated, thermostat_energy, growth_energy, shear_energy;
  std::array<ExactSum, 2> obstacle_impulse;
  ExactSum circle_impulse;

  /// Adds what another engine has counted of other events.
  void add(const RunningTotals& more) {
    add_counts(*this, more);
    virial.add(more.virial), virial_yx.add(more.virial_yx);
    for (std::size_t w = 0; w < wall_impulse.size(); ++w) {
      wall_impulse[w].add(more.wall_impulse[w]), wall_shear[w].add(more.wall_shear[w]);
      wall_energy[w].add(more.wall_energy[w]), wall_work[w].add(more.wall_work[w]);
    }
    dissipated.add(more.dissipated), thermostat_energy.add(more.thermostat_energy);
    growth_energy.add(more.growth_energy), shear_energy.add(more.shear_energy);
    for (std::size_t k = 0; k < obstacle_impulse.size(); ++k) obstacle_impulse[k].add(more.obstacle_impulse[k]);
    circle_impulse.add(more.circle_impulse);
  }
  /// Goes on from what another engine has counted. Requires nothing but new epochs and lists to have been counted here.
  void go_on_from(const RunningTotals& before) {
    const Numerics begun = numerics;
    *this = before;
    numerics.epochs += begun.epochs;
    numerics.list_rebuilds += begun.list_rebuilds;
    numerics.longest_neighbour_list = begun.longest_neighbour_list;
  }

  /// Returns the totals so far. Takes a microsecond: not for every event.
  [[nodiscard]] Totals rounded() const {
    Totals totals{static_cast<const Counts&>(*this)};
    totals.virial = virial.value();
    totals.virial_yx = virial_yx.value();
    for (std::size_t w = 0; w < wall_impulse.size(); ++w) {
      totals.wall_impulse[w] = wall_impulse[w].value();
      totals.wall_shear[w] = wall_shear[w].value();
      totals.wall_energy[w] = wall_energy[w].value();
      totals.wall_work[w] = wall_work[w].value();
    }
    totals.dissipated = dissipated.value();
    totals.thermostat_energy = thermostat_energy.value();
    totals.growth_energy = growth_energy.value();
    totals.shear_energy = shear_energy.value();
    for (std::size_t k = 0; k < obstacle_impulse.size(); ++k)
      totals.obstacle_impulse[static_cast<Eigen::Index>(k)] = obstacle_impulse[k].value();
    totals.circle_impulse = circle_impulse.value();
    return totals;
  }
};

}  // namespace carom
