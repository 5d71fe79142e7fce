#pragma once
// Scenes that list their disks one by one, as a run has left them. with_disks() of carom/scene.hpp takes those of a program.

#include <carom/scene.hpp>
#include <carom/state.hpp>

namespace carom {

/// Gives every species of a scene lists of its disks' positions and velocities in a state, which has those disks.
void list_disks(Scene& scene, const State& state);

}  // namespace carom
