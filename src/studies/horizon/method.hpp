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
  double dt = 0.0;                       ///< 0: exact events
  std::optional<double> stiffness = {};  ///< of the springs of soft; empty: that which dt gives them

  [[nodiscard]] bool exact() const { return dt == 0.0; }
  /// Returns whether both are the same method with the same step.
  [[nodiscard]] bool same_step(const Method& other) const { return name == other.name && dt == other.dt; }
};

/// Returns whether a fixed-step method goes to the moment of a contact within its step. It is right to rounding then, until a
/// step has a mistake.
[[nodiscard]] bool finds_contacts(const std::string& method);

/// Returns the part of `time` whose collisions a run of this method has counted: until its last step, or all of it by exact
/// events.
[[nodiscard]] double counted_time(const Method& method, double time);

/// Returns the end of the step in which `time` lies; `time` itself by exact events, and where a step ends to rounding.
[[nodiscard]] double end_of_step(const Method& method, double time);

/// Makes a simulation by this method from a given state. Throws as make_simulation.
[[nodiscard]] Simulation begin(const Scene& scene, const State& start, const Method& method);

/// Returns the state in which the scene's measured run begins: after its equilibration, by `engine` or the one that runs the
/// scene. Empty where that was stopped by `proceed`, or ended for want of collisions.
[[nodiscard]] std::optional<State> measured_start(const Scene& scene, const std::string& engine,
                                                  const std::function<bool(const Progress&)>& proceed = {});

/// Returns the processor time of `run` in seconds, without that in which `proceed` was asked whether it may go on. `run` is given
/// the limits that ask.
[[nodiscard]] double seconds_of(const std::function<void(const RunLimits& limits)>& run, const std::function<bool()>& proceed);

/// Processor time of one run, in seconds.
struct RunSeconds {
  double setup = 0.0;         ///< to make the simulation, before its first step or event
  std::vector<double> until;  ///< in the loop, from the start to each of the times that were asked for
};

/// Returns the processor time that `method` takes from `start` to each of `times` (ascending): the least of a few runs, since
/// what disturbs only adds. `proceed` is asked some twenty times a second; where it has said stop, the seconds mean nothing.
[[nodiscard]] RunSeconds seconds_of_run(const Scene& scene, const State& start, const Method& method,
                                        const std::vector<double>& times, const std::function<bool()>& proceed = {});

}  // namespace carom
