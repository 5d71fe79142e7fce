// Obstacles lie in the box, and disks whose positions are given lie clear of them.

#include "scene/checks.hpp"
#include "scene/number_keys.hpp"
#include "scene/obstacle_overlap.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace carom::detail {
namespace {

void require_inside(const Box& box, const Eigen::Vector2d& point, const std::string& path, const std::string& what) {
  for (int axis = 0; axis < 2; ++axis) {
    if (point[axis] >= box.lower[axis] && point[axis] <= box.upper[axis]) continue;
    throw Refusal(path, fmt::format("{} is outside the box: its {} = {} must lie from {} to {}", path + what, axis_names[axis],
                                    point[axis], box.lower[axis], box.upper[axis]));
  }
}

void check_numbers_of(const Obstacle& obstacle, const std::string& path) {
  if (const auto* disk = std::get_if<DiskObstacle>(&obstacle)) {
    require_pair(path + ".disk.centre", disk->centre, keys::disk_example);
    require(path + ".disk", disk->radius, keys::obstacle_radius);
  } else {
    require_pair(path + ".segment.from", std::get<SegmentObstacle>(obstacle).from, keys::segment_example);
    require_pair(path + ".segment.to", std::get<SegmentObstacle>(obstacle).to, keys::segment_example);
  }
}

/// Through a periodic edge a disk may stick out, but not so far that it meets its own image.
void check_disk(const Box& box, const DiskObstacle& disk, const std::string& path) {
  require_inside(box, disk.centre, path, ".disk.centre");
  for (int axis = 0; axis < 2; ++axis) {
    const double length = box.lengths()[axis];
    if (box.periodic(axis) && 2.0 * disk.radius >= length) {
      throw Refusal(path, fmt::format("{}.disk is {:.6g} across, so it touches its own image; it must be less than {:.6g}, the "
                                      "length of the box in {}",
                                      path, 2.0 * disk.radius, length, axis_names[axis]));
    }
    const double room = std::min(disk.centre[axis] - box.lower[axis], box.upper[axis] - disk.centre[axis]);
    if (box.periodic(axis) || room >= disk.radius * (1.0 - 2.0 * touching)) continue;
    throw Refusal(path,
                  fmt::format("{}.disk overlaps a wall by {:.6g} in {}; its centre must be at least its radius {} away from "
                              "each wall",
                              path, disk.radius - room, axis_names[axis], disk.radius));
  }
}

void check_segment(const Box& box, const SegmentObstacle& segment, const std::string& path) {
  if (segment.from == segment.to)
    throw Refusal(path + ".segment",
                  fmt::format("{}.segment runs from ({}, {}) to the same place; give it two different ends, such as {}", path,
                              segment.from.x(), segment.from.y(), keys::segment_example));
  require_inside(box, segment.from, path, ".segment.from");
  require_inside(box, segment.to, path, ".segment.to");
}

}  // namespace

void check_obstacles(const Scene& scene) {
  const std::vector<Obstacle>& obstacles = scene.effects.obstacles;
  if (obstacles.empty()) return;
  for (std::size_t o = 0; o < obstacles.size(); ++o) {
    const std::string path = fmt::format("obstacles.{}", o);
    check_numbers_of(obstacles[o], path);
    if (const auto* disk = std::get_if<DiskObstacle>(&obstacles[o])) check_disk(scene.box, *disk, path);
    if (const auto* segment = std::get_if<SegmentObstacle>(&obstacles[o])) check_segment(scene.box, *segment, path);
  }
  std::int64_t first_id = 0;
  for (std::size_t s = 0; s < scene.species.size(); ++s) {
    const Species& species = scene.species[s];
    const std::span<const Eigen::Vector2d> positions = given_positions(species);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const auto disk = static_cast<std::int64_t>(i);
      const auto found = overlapped_obstacle(scene.box, obstacles, positions[i], species.radius_of(disk), touching);
      if (!found) continue;
      const bool round = std::holds_alternative<DiskObstacle>(obstacles[found->obstacle]);
      throw Refusal(
          fmt::format("disks.{}.positions.{}", s, i),
          fmt::format("disk {} overlaps obstacles.{} by {:.6g}; its centre must be at least {:.6g} from {}", first_id + disk,
                      found->obstacle, found->depth, found->contact, round ? "the centre of that disk" : "that segment"));
    }
    first_id += species.count;
  }
}

}  // namespace carom::detail
