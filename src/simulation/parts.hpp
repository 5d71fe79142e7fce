#pragma once
// What a Simulation is made of; seen by the code of this room alone.

#include <carom/simulation.hpp>

#include "simulation/any_engine.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace carom {

namespace detail {

/// Why run_until returned false where no limit was reached; empty where the engine can go on.
[[nodiscard]] inline std::optional<StopReason> why_stopped(const AnyEngine& engine, const Effects& effects) {
  if (!engine.fault().empty()) return StopReason::invalid_state;
  if (const auto reason = engine.ended()) return reason;
  if (engine.cooled()) return StopReason::cooled;
  if (engine.jammed()) return effects.dissipate() ? StopReason::collapsed : StopReason::jammed;
  return std::nullopt;
}

}  // namespace detail

struct Simulation::Parts {
  Scene scene;
  Disks disks;
  std::string engine_name;
  std::unique_ptr<detail::AnyEngine> engine;
  std::string engine_reason = {};
  std::optional<double> time_step = {};  ///< of a fixed-step method
  double smallest_radius = smallest_of(disks);

  bool recording = false;          ///< events, for the user
  std::vector<Event> events = {};  ///< recorded and not yet taken, before those that the engine has
  std::vector<Event> last = {};    ///< of next_event(), kept for its memory

  /// Simulation::run_until() for an exact time.
  StopReason run_to(const Instant& target, const RunLimits& limits);
  /// Goes to the next event, unless `target` or the limit of collisions comes first or the engine cannot go on. `arrived`:
  /// whether it stands at the target.
  std::optional<Event> next_event(const Instant& target, std::uint64_t collision_limit, bool& arrived);

  [[nodiscard]] static double smallest_of(const Disks& disks) {
    return disks.count() == 0 ? 0.0 : *std::min_element(disks.radius.begin(), disks.radius.end());
  }
};

}  // namespace carom
