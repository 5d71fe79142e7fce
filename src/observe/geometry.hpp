#pragma once
// Box and disks of a state at one instant, whose walls may have moved, whose disks may have grown and whose edges may be sheared:
// lengths, areas and the deepest overlap.

#include "neighbours/disks_at_rest.hpp"

#include <carom/box.hpp>
#include <carom/effects.hpp>
#include <carom/state.hpp>

#include <vector>

namespace carom {

/// Returns scale * Disks::radius
[[nodiscard]] std::vector<double> radii_of(const Disks& disks, const State& state);

/// Returns the sum of pi r^2 over the area of the box, both as the state has them; 0 without disks
[[nodiscard]] double packing_fraction(const Box& box, const Disks& disks, const State& state);

/// Returns the diameter of the largest disk as the state has it; 1 without disks. Three-dimensional readers take it for the box's
/// thickness.
[[nodiscard]] double largest_diameter(const Disks& disks, const State& state);

/// Returns how far along x the nearest images above stand to the right of those below, between minus half and half the length of
/// the box, where its edges are sheared; 0 otherwise.
[[nodiscard]] double tilt_of(const Eigen::Vector2d& lengths, const State& state);

/// `box` and `effects` are the scene's. Requires positions inside the box as the state has it.
[[nodiscard]] DeepestOverlap deepest_overlap(const Box& box, const Effects& effects, const Disks& disks, const State& state);

}  // namespace carom
