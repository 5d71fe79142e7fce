#pragma once
// Why an engine runs, where that does not follow from the scene.

namespace carom::detail {

/// What Simulation::engine_reason() returns where make_simulation() was given the name of an engine.
inline constexpr const char* engine_was_asked_for = "it was asked for";

}  // namespace carom::detail
