#pragma once
// The counts and the log of a step: the same totals and event log as those of engines, for what the method did, whether or not it
// should have.

#include "core/instant.hpp"
#include "core/running_totals.hpp"
#include "core/vec2.hpp"

#include <carom/state.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom {

class Tally {
 public:
  /// A pair's velocities were changed. `virial` is r . dp of the pair as it stood: negative where disks that were already
  /// parting were sent back.
  void pair(std::size_t i, std::size_t j, double virial, const Vec2<double>& v_i, const Vec2<double>& v_j) {
    ++totals.pair;
    totals.virial.add(virial);
    if (!recording) return;
    const bool in_order = i < j;
    log.push_back({time.high, time.low, static_cast<std::int32_t>(in_order ? i : j), static_cast<std::int32_t>(in_order ? j : i),
                   in_order ? v_i : v_j, in_order ? v_j : v_i});
  }

  /// A velocity was turned round at a wall; `impulse` is what the wall took, outward positive.
  void wall(std::size_t i, Wall which, double impulse, const Vec2<double>& v) {
    ++totals.wall;
    totals.wall_impulse[static_cast<std::size_t>(-1 - which)].add(impulse);
    if (recording) log.push_back({time.high, time.low, static_cast<std::int32_t>(i), which, v, Eigen::Vector2d::Zero()});
  }

  RunningTotals totals;
  bool recording = false;
  Instant time;  ///< of the present step, or of the contact where the method finds it
  std::vector<Event> log;
};

}  // namespace carom
