#pragma once

#include "observe/observed_run.hpp"

#include <carom/box.hpp>
#include <carom/state.hpp>

namespace carom {

/// Returns the box with each wall as far outward as it comes during the measured run, which begins with the state `start`: by its
/// velocity until the end of the run, by its vibration, and by both across the changes of the scene. A wall whose way is not
/// known beforehand stays where it is: a piston, and one that moves until a number of collisions.
[[nodiscard]] Box reach_of_walls(const ObservedRun& run, const State& start);

}  // namespace carom
