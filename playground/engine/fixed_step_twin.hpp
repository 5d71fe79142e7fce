#pragma once
// The same disks by fixed steps, beside the exact run.

#include "json.hpp"
#include "live/live_run.hpp"
#include "observe/energy.hpp"
#include "overlaps.hpp"

#include <carom/simulation.hpp>

#include <emscripten.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace carom::playground {

class FixedStepTwin {
 public:
  /// Begins with the disks as they are in the run now. Throws std::invalid_argument where the method cannot run the scene.
  FixedStepTwin(const LiveRun& run, const std::string& method, double dt)
      : simulation_(make_simulation(run.simulation().scene(), state_of(run), FixedStep{method, dt})),
        box_at_start_(run.first_scene().box),
        before_(run.time()) {}

  /// Follows the run to its time, for at most `budget` milliseconds.
  void follow(const LiveRun& run, double budget) {
    const double end = emscripten_get_now() + budget, target = run.time() - before_;
    while (simulation_.time() < target && emscripten_get_now() < end)
      simulation_.run_until(std::min(target, simulation_.time() + 20.0 * simulation_.time_step().value_or(1.0)));
  }
  [[nodiscard]] State state() const { return simulation_.state(); }

  /// Returns what went wrong so far, and looks which disks overlap now. The time is that of the run's clock.
  std::string json() {
    const State now = state();
    const Scene& scene = simulation_.scene();
    const Overlaps found = overlaps_of(scene.box, simulation_.disks(), now, overlapping_);
    deepest_ = std::max(deepest_, found.deepest);
    const double energy = energies_of(scene.box, scene.effects, simulation_.disks(), now, box_at_start_).total();
    return fmt::format("{{\"time\":{},\"overlapping\":{},\"deepest\":{},\"collisions\":{},\"energy\":{}}}",
                       json_number(before_ + simulation_.time()), found.pairs, json_number(deepest_), simulation_.counts().pair,
                       json_number(energy));
  }
  /// 1 for each disk that overlapped another when json() was called last.
  [[nodiscard]] const std::vector<std::uint8_t>& overlapping() const { return overlapping_; }

 private:
  static State state_of(const LiveRun& run) {
    State state;
    run.state(state);
    return state;
  }

  Simulation simulation_;
  Box box_at_start_;  ///< from which the run counts heights
  double before_;     ///< the time of the run at which it began
  double deepest_ = 0.0;
  std::vector<std::uint8_t> overlapping_;
};

}  // namespace carom::playground
