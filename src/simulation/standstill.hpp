#pragma once
// Tells a run that goes nowhere. Disks that jam need not collide at one instant: where two times differ by their last digit only,
// every event may move the clock by that digit, and a run would take years for the next thousandth of a unit of time.

#include "core/instant.hpp"
#include "simulation/all_events.hpp"
#include "simulation/any_engine.hpp"

#include <carom/state.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace carom::detail {

class Standstill {
 public:
  explicit Standstill(const Disks& disks)
      : disks_(disks.count()), smallest_(disks_ == 0 ? 0.0 : *std::min_element(disks.radius.begin(), disks.radius.end())) {}

  /// Asked now and then. True where over the last million events, and a hundred per disk, even the fastest disk went less than
  /// 2^-50 of the smallest radius from one of its events to the next: less than coordinates can tell.
  [[nodiscard]] bool reached(const AnyEngine& engine) {
    const std::uint64_t events = all_events(engine.totals());
    if (events < events_) start(engine, events);  // the clock was reset
    const std::uint64_t done = events - events_;
    if (done < 1'000'000 + 100 * disks_) return false;
    const State state = engine.state();
    const double fastest = state.velocities.size() > 0 ? state.velocities.cwiseAbs().maxCoeff() : 0.0;
    const double way = fastest * engine.now().since<double>(since_);  // of the fastest, in `done` events of all
    const double of_one = static_cast<double>(done) / static_cast<double>(std::max<std::size_t>(disks_, 1));
    start(engine, events);
    return way < of_one * 0x1p-50 * smallest_ * state.scale;
  }

 private:
  void start(const AnyEngine& engine, std::uint64_t events) {
    since_ = engine.now();
    events_ = events;
  }

  std::size_t disks_;
  double smallest_;
  Instant since_;
  std::uint64_t events_ = 0;
};

}  // namespace carom::detail
