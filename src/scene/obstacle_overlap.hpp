#pragma once
// Whether a disk lies upon an obstacle of the scene.

#include <carom/box.hpp>
#include <carom/effects.hpp>

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

namespace carom {

struct ObstacleOverlap {
  std::size_t obstacle = 0;
  double depth = 0.0;    ///< contact distance minus distance, > 0
  double contact = 0.0;  ///< distance from the centre of the disk to the centre of the obstacle, or to the segment
};

/// Returns the first obstacle that a disk overlaps by more than `tolerance` of their contact distance, periodic images counted;
/// empty where there is none. Requires position and obstacles in the box.
[[nodiscard]] std::optional<ObstacleOverlap> overlapped_obstacle(const Box& box, const std::vector<Obstacle>& obstacles,
                                                                 const Eigen::Vector2d& position, double radius,
                                                                 double tolerance);

}  // namespace carom
