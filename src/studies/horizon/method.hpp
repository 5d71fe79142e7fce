#pragma once
// One way to advance a scene, as the studies compare them: an exact engine by name, or a fixed-step method with its step.

#include <carom/scene.hpp>
#include <carom/simulation.hpp>
#include <carom/state.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace carom {

struct Method {
  std::string name;
  double dt = 0.0;  ///< 0: exact events

  [[nodiscard]] bool exact() const { return dt == 0.0; }
};

/// Makes a simulation by this method from a given state. Throws as make_simulation.
[[nodiscard]] Simulation begin(const Scene& scene, const State& start, const Method& method);

/// Returns the state in which the scene's measured run begins: after its equilibration, by `engine` or the one that runs the
/// scene. Empty where that was stopped by `proceed`, or ended for want of collisions.
[[nodiscard]] std::optional<State> measured_start(const Scene& scene, const std::string& engine,
                                                  const std::function<bool(const Progress&)>& proceed = {});

/// Processor time of this thread, in seconds from some zero.
[[nodiscard]] double thread_seconds();

/// Seconds of processor time that the loop of `method` takes from `start` to each of `times` (ascending): the least of a few
/// turns, since what disturbs only adds.
[[nodiscard]] std::vector<double> seconds_in_loop(const Scene& scene, const State& start, const Method& method,
                                                  const std::vector<double>& times);

}  // namespace carom
