#pragma once
// The rates of events in a scene, from a short run; the studies choose their steps by them.

#include <carom/scene.hpp>
#include <carom/state.hpp>

namespace carom {

struct EventRates {
  double time = 0.0;             ///< simulated time of the short run; 0 where nothing moves
  double collision_rate = 0.0;   ///< collisions of one disk per time, 0 where no pair met
  double events_per_time = 0.0;  ///< number of events of every kind per time, bookkeeping too
  bool stuck = false;            ///< jammed at the time reached: collisions without end at one instant
};

/// Looks at some thousand events (two hundred where collisions lose energy, for the gas slows down) or four per disk, whichever
/// is more, but no longer than the fastest disk needs for about 4096 times the mean spacing of disks times the root of their
/// number: a scene where nothing meets ends too. Throws as make_simulation.
EventRates measure_event_rates(const Scene& scene, const State& start);

/// Collisions of pairs that no step of a study comes near, which holds a few per disk or 20,000 events: time has all but stopped.
[[nodiscard]] std::uint64_t stall_limit(std::uint64_t disks);

}  // namespace carom
