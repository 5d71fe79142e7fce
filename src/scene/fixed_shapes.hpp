#pragma once
// The fixed shapes of a scene: what stands in the box, besides walls, for disks to bounce off. Whatever draws them, keeps clear
// of them or counts them asks here.

#include "core/rectangle_bins.hpp"

#include <carom/box.hpp>
#include <carom/effects.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace carom {

/// Returns all fixed shapes: the obstacles, and then the rim of a circular box. Shape k is the partner `first_obstacle - k` of an
/// event.
[[nodiscard]] std::vector<Obstacle> fixed_shapes(const Effects& effects);

/// Returns the place of shape k in a scene file, which errors name.
[[nodiscard]] std::string path_of_shape(const Effects& effects, std::size_t k);

/// Returns the unit vector at an angle in degrees, counterclockwise from +x; exact at multiples of 90.
[[nodiscard]] Eigen::Vector2d direction(double degrees);

/// Returns whether an arc has a point in the direction of `from`, a vector from its centre.
[[nodiscard]] bool spans(const ArcObstacle& arc, const Eigen::Vector2d& from);

/// Returns the rectangle round an arc.
[[nodiscard]] Rectangle bounds_of(const ArcObstacle& arc);
/// Returns the rectangle round a shape.
[[nodiscard]] inline Rectangle bounds_of(const Obstacle& shape) {
  if (const auto* disk = std::get_if<DiskObstacle>(&shape)) {
    const Eigen::Vector2d radius = Eigen::Vector2d::Constant(disk->radius);
    return {disk->centre - radius, disk->centre + radius};
  }
  if (const auto* arc = std::get_if<ArcObstacle>(&shape)) return bounds_of(*arc);
  const auto& segment = std::get<SegmentObstacle>(shape);
  return {segment.from.cwiseMin(segment.to), segment.from.cwiseMax(segment.to)};
}
[[nodiscard]] inline std::vector<Rectangle> bounds_of(std::span<const Obstacle> shapes) {
  std::vector<Rectangle> bounds;
  for (const Obstacle& shape : shapes) bounds.push_back(bounds_of(shape));
  return bounds;
}

struct ShapeOverlap {
  std::size_t shape = 0;
  double depth = 0.0;    ///< contact distance minus distance, > 0
  double contact = 0.0;  ///< distance from the centre of the disk to the centre of a fixed disk, or to the segment, arc or rim
};

/// Returns the first fixed shape that a disk overlaps by more than `tolerance` of their contact distance, periodic images
/// counted; empty where there is none. A disk outside a circular box overlaps its rim. Requires position and shapes in the box.
[[nodiscard]] std::optional<ShapeOverlap> overlapped_shape(const Box& box, const Effects& effects,
                                                           const Eigen::Vector2d& position, double radius, double tolerance);

}  // namespace carom
