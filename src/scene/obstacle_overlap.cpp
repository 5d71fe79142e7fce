// Distances of disks from obstacles, all images of the box included.

#include "scene/obstacle_overlap.hpp"

#include "core/nearest_point.hpp"

#include <algorithm>
#include <limits>

namespace carom {
namespace {

double distance(const Obstacle& obstacle, const Eigen::Vector2d& point) {
  if (const auto* disk = std::get_if<DiskObstacle>(&obstacle)) return (point - disk->centre).norm();
  const auto& segment = std::get<SegmentObstacle>(obstacle);
  return (point - nearest_on_segment<double>(segment.from, segment.to, point)).norm();
}

/// A segment may be as long as the box, so no single image of the point is sure to be the nearest: all next to the box are tried.
double distance(const Box& box, const Obstacle& obstacle, const Eigen::Vector2d& point) {
  const int columns = box.periodic(0) ? 1 : 0;
  const int rows = box.periodic(1) ? 1 : 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = -columns; i <= columns; ++i) {
    for (int j = -rows; j <= rows; ++j) {
      nearest = std::min(nearest, distance(obstacle, point + box.lengths().cwiseProduct(Eigen::Vector2d(i, j))));
    }
  }
  return nearest;
}

}  // namespace

std::optional<ObstacleOverlap> overlapped_obstacle(const Box& box, const std::vector<Obstacle>& obstacles,
                                                   const Eigen::Vector2d& position, double radius, double tolerance) {
  for (std::size_t o = 0; o < obstacles.size(); ++o) {
    const auto* disk = std::get_if<DiskObstacle>(&obstacles[o]);
    const double contact = radius + (disk == nullptr ? 0.0 : disk->radius);
    const double depth = contact - distance(box, obstacles[o], position);
    if (depth > tolerance * contact) return ObstacleOverlap{o, depth, contact};
  }
  return std::nullopt;
}

}  // namespace carom
