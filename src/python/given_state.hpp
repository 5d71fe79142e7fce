#pragma once
// Whether disks can begin where a caller of Python puts them.

#include <carom/scene.hpp>
#include <carom/state.hpp>

namespace carom::python {

/// Throws std::invalid_argument where disks of a given state lie outside the box, upon each other, in a wall or upon an obstacle,
/// by more than any engine's rounding: a state that a run has left may begin another. All but the first may be where the scene
/// accepts overlaps. Throws as make_simulation() does where the state does not belong to the scene.
void require_apart(const Scene& scene, const State& given);

}  // namespace carom::python
