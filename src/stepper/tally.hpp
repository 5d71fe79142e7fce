#pragma once
// The counts and the log of a step: the same totals and event log as those of engines, for what the method did, whether or not it
// should have.

#include "core/instant.hpp"
#include "core/running_totals.hpp"
#include "core/sides.hpp"
#include "core/vec2.hpp"

#include <carom/state.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom {

class Tally {
 public:
  /// A pair's velocities were changed. `virial` is r . dp of the pair as it stood: negative where disks that were already
  /// parting were sent back. `lost` is the energy that the collision took.
  void pair(std::size_t i, std::size_t j, double virial, double lost, const Vec2<double>& v_i, const Vec2<double>& v_j) {
    ++totals.pair;
    totals.virial.add(virial);
    if (lost != 0) totals.dissipated.add(lost);
    if (!recording) return;
    const bool in_order = i < j;
    log.push_back({time.high, time.low, static_cast<std::int32_t>(in_order ? i : j), static_cast<std::int32_t>(in_order ? j : i),
                   in_order ? v_i : v_j, in_order ? v_j : v_i});
  }

  /// A velocity was reversed at a wall; `impulse` and `energy` are what the wall took, the impulse outward positive.
  void wall(std::size_t i, Wall which, double impulse, double energy, const Vec2<double>& v) {
    ++totals.wall;
    totals.wall_impulse[index_of(which)].add(impulse);
    if (energy != 0) totals.wall_energy[index_of(which)].add(energy);
    if (recording) log.push_back({time.high, time.low, static_cast<std::int32_t>(i), which, v, Eigen::Vector2d::Zero()});
  }

  /// A velocity was reversed at fixed shape `which`, which took `impulse`, and `outward` of it where it is the rim of a
  /// circular box.
  void shape(std::size_t i, std::int32_t which, const Vec2<double>& impulse, double outward, const Vec2<double>& v) {
    ++totals.obstacle;
    add_to_shapes(impulse, outward);
    if (recording)
      log.push_back({time.high, time.low, static_cast<std::int32_t>(i), first_obstacle - which, v, Eigen::Vector2d::Zero()});
  }
  /// Adds to what fixed shapes have taken.
  void add_to_shapes(const Vec2<double>& impulse, double outward) {
    if (outward != 0)
      totals.circle_impulse.add(outward);
    else
      for (int k = 0; k < 2; ++k) totals.obstacle_impulse[static_cast<std::size_t>(k)].add(impulse[k]);
  }

  RunningTotals totals;
  bool recording = false;
  Instant time;  ///< of the present step, or of the contact where the method finds it
  std::vector<Event> log;
};

}  // namespace carom
