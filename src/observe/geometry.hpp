#pragma once
// Lengths and areas of box and disks at one instant: walls may move, and disks may grow.

#include <carom/box.hpp>
#include <carom/state.hpp>

#include <vector>

namespace carom {

/// Returns the scene's box with its walls where the state has them.
[[nodiscard]] Box box_of(const Box& box, const State& state);

/// Returns scale * Disks::radius
[[nodiscard]] std::vector<double> radii_of(const Disks& disks, const State& state);

/// Returns the sum of pi r^2 over the area of the box, both as the state has them; 0 without disks
[[nodiscard]] double packing_fraction(const Box& box, const Disks& disks, const State& state);

/// Returns the diameter of the largest disk as the state has it; 1 without disks. Three-dimensional readers take it for the box's
/// thickness.
[[nodiscard]] double largest_diameter(const Disks& disks, const State& state);

}  // namespace carom
