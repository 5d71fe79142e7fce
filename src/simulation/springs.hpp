#pragma once
// Which springs a scene can have: those of a given stiffness that the time step leaves stable, and that its disks cannot
// overcome.

#include <carom/simulation.hpp>

namespace carom::detail {

/// Returns the smallest restitution of pairs and walls.
[[nodiscard]] double least_restitution(const Effects& effects);

/// Returns the time below which every step with springs of this stiffness is stable; infinite without disks. Requires
/// restitutions above 0.
[[nodiscard]] double stable_step(const Disks& disks, const Effects& effects, double stiffness);

/// Throws std::invalid_argument where a stiffness is given to a method without springs, or is not positive and finite, or where
/// springs make the time step unstable. Requires restitutions above 0.
void require_stable_springs(const FixedStep& step, const Disks& disks, const Effects& effects);

/// Does nothing where no stiffness was given. Throws std::invalid_argument where the disks are fast enough to leave the box
/// through a wall, m v^2 >= k radius^2, or the two fastest, which stand for all pairs, to pass through each other, mu v^2 >= k
/// (sum of radii)^2.
void require_springs_that_hold(const Simulation& simulation);

}  // namespace carom::detail
