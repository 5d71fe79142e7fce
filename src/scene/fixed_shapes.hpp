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

/// Returns all fixed shapes. Shape k is the partner `first_obstacle - k` of an event.
[[nodiscard]] inline std::span<const Obstacle> fixed_shapes(const Effects& effects) { return effects.obstacles; }

/// Returns the place of shape k in a scene file, which errors name.
[[nodiscard]] std::string path_of_shape(std::size_t k);

/// Returns the rectangle round a shape.
[[nodiscard]] inline Rectangle bounds_of(const Obstacle& shape) {
  if (const auto* disk = std::get_if<DiskObstacle>(&shape)) {
    const Eigen::Vector2d radius = Eigen::Vector2d::Constant(disk->radius);
    return {disk->centre - radius, disk->centre + radius};
  }
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
  double contact = 0.0;  ///< distance from the centre of the disk to the centre of a round shape, or to the segment
};

/// Returns the first fixed shape that a disk overlaps by more than `tolerance` of their contact distance, periodic images
/// counted; empty where there is none. Requires position and shapes in the box.
[[nodiscard]] std::optional<ShapeOverlap> overlapped_shape(const Box& box, const Effects& effects,
                                                           const Eigen::Vector2d& position, double radius, double tolerance);

}  // namespace carom
