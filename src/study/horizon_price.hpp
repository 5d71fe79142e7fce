#pragma once
// What a precision costs.

#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <string>

namespace carom {

/// Seconds of this thread's processor time that the event loop of `engine` takes from `start` to `time`: the least of a few
/// turns, since what disturbs only adds. Throws as make_simulation.
[[nodiscard]] double seconds_in_loop(const Scene& scene, const State& start, const std::string& engine, double time);

}  // namespace carom
