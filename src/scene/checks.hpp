#pragma once
// The checks of a whole scene, one file each, and what they share.

#include "scene/draft.hpp"

#include <numbers>
#include <span>

namespace carom::detail {

/// Given positions may miss a wall or each other by this fraction of the contact distance: what decimal input rounds away.
inline constexpr double touching = 1e-9;
/// pi / (2 sqrt 3): no arrangement of equal disks is denser, in a rectangle or on a torus.
inline constexpr double closest_packing = std::numbers::pi / (2.0 * std::numbers::sqrt3);
inline constexpr const char* axis_names[] = {"x", "y"};

/// The place of disk i of a species: its row where it has one, else what the caller names.
Location place(const DisksDraft& disks, std::size_t i, const Location& otherwise);

/// The positions of a species that gives them one by one; else none.
std::span<const Eigen::Vector2d> given_positions(const Species& species);

/// The smallest and the largest radius of all disks; both 0 where there is no disk.
struct Radii {
  double smallest = 0.0;
  double largest = 0.0;

  [[nodiscard]] bool equal() const { return largest <= smallest * (1.0 + touching); }
  /// No packing fraction is above it.
  [[nodiscard]] double densest() const { return equal() ? closest_packing : 1.0; }
};
Radii radii_of(const Scene& scene);
/// Over all disks. Requires one.
double mean_diameter(const Scene& scene);

/// Numbers of effects out of their ranges, which a file cannot hold.
void check_numbers(const Effects& effects);
/// Effects that cannot act together, or not in this box.
void check_effects(const Scene& scene);
void check_walls(const Scene& scene);
void check_growth(const Scene& scene);
void check_observe(const Scene& scene);
/// Obstacles must lie in the box, and given disks clear of them.
void check_obstacles(const SceneDraft& draft);

}  // namespace carom::detail
