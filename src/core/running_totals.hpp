#pragma once
// The counts and sums of an engine while it runs.

#include "core/exact_sum.hpp"

#include <carom/state.hpp>

#include <array>
#include <cstddef>

namespace carom {

/// Totals as they grow: sums without rounding.
struct RunningTotals : Counts {
  ExactSum virial, virial_yx;
  std::array<ExactSum, 4> wall_impulse, wall_energy;
  ExactSum dissipated, thermostat_energy, growth_energy, shear_energy;
  std::array<ExactSum, 2> obstacle_impulse;

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
      totals.wall_energy[w] = wall_energy[w].value();
    }
    totals.dissipated = dissipated.value();
    totals.thermostat_energy = thermostat_energy.value();
    totals.growth_energy = growth_energy.value();
    totals.shear_energy = shear_energy.value();
    for (std::size_t k = 0; k < obstacle_impulse.size(); ++k)
      totals.obstacle_impulse[static_cast<Eigen::Index>(k)] = obstacle_impulse[k].value();
    return totals;
  }
};

}  // namespace carom
