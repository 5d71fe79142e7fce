// The [[obstacles]] tables: how they are read, what is wrong with them, and which of them a disk lies upon.

#include "scene/fixed_shapes.hpp"

#include "scene/checks.hpp"
#include "scene/number_keys.hpp"
#include "scene/read_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace carom {
namespace {

/// Returns the point of the segment between `from` and `to` nearest to `point`. The two ends may be equal.
Eigen::Vector2d nearest_on_segment(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Eigen::Vector2d& point) {
  const Eigen::Vector2d along = to - from;
  const double square = along.squaredNorm();
  if (!(square > 0.0)) return from;
  const double share = std::clamp(along.dot(point - from) / square, 0.0, 1.0);
  return share == 1.0 ? to : Eigen::Vector2d(from + share * along);
}

double distance(const Obstacle& shape, const Eigen::Vector2d& point) {
  if (const auto* disk = std::get_if<DiskObstacle>(&shape)) return (point - disk->centre).norm();
  const auto& segment = std::get<SegmentObstacle>(shape);
  return (point - nearest_on_segment(segment.from, segment.to, point)).norm();
}

/// A segment may be as long as the box, so no single image of the point is sure to be the nearest: all next to the box are tried.
double distance(const Box& box, const Obstacle& shape, const Eigen::Vector2d& point) {
  const int columns = box.periodic(0) ? 1 : 0;
  const int rows = box.periodic(1) ? 1 : 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = -columns; i <= columns; ++i) {
    for (int j = -rows; j <= rows; ++j) {
      nearest = std::min(nearest, distance(shape, point + box.lengths().cwiseProduct(Eigen::Vector2d(i, j))));
    }
  }
  return nearest;
}

}  // namespace

std::string path_of_shape(std::size_t k) { return fmt::format("obstacles.{}", k); }

std::optional<ShapeOverlap> overlapped_shape(const Box& box, const Effects& effects, const Eigen::Vector2d& position,
                                             double radius, double tolerance) {
  const std::span<const Obstacle> shapes = fixed_shapes(effects);
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const auto* disk = std::get_if<DiskObstacle>(&shapes[k]);
    const double contact = radius + (disk == nullptr ? 0.0 : disk->radius);
    const double depth = contact - distance(box, shapes[k], position);
    if (depth > tolerance * contact) return ShapeOverlap{k, depth, contact};
  }
  return std::nullopt;
}

namespace detail {
namespace {

using keys::disk_example;
using keys::segment_example;

Eigen::Vector2d read_point(const TableReader& table, const char* key, std::string_view example) {
  return read_pair(table.require(key, fmt::format("give it, such as {}", example)), table.path(key), example);
}

DiskObstacle read_disk(const toml::table& node, const std::string& path) {
  const TableReader table(node, path, {"centre", "radius"});
  return {read_point(table, "centre", disk_example), table.required_number(keys::obstacle_radius)};
}

SegmentObstacle read_segment(const toml::table& node, const std::string& path) {
  const TableReader table(node, path, {"from", "to"});
  return {read_point(table, "from", segment_example), read_point(table, "to", segment_example)};
}

}  // namespace

Obstacle read_obstacle(const toml::table& node, const std::string& path) {
  const TableReader table(node, path, {"disk", "segment"});
  const toml::table* disk = table.table("disk", std::string(disk_example));
  const toml::table* segment = table.table("segment", std::string(segment_example));
  if ((disk == nullptr) == (segment == nullptr)) {
    throw SceneError(table.where(), fmt::format("{} has {}; give exactly one, disk = {} or segment = {}", path,
                                                disk == nullptr ? "neither disk nor segment" : "both disk and segment",
                                                disk_example, segment_example));
  }
  if (disk != nullptr) return read_disk(*disk, table.path("disk"));
  return read_segment(*segment, table.path("segment"));
}

std::vector<Obstacle> read_obstacles(const toml::node& node) {
  const toml::array* list = node.as_array();
  if (list == nullptr) refuse(node, "obstacles", "a list of tables: write [[obstacles]] with double brackets");
  std::vector<Obstacle> obstacles;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const std::string path = path_of_shape(i);
    const toml::node& entry = (*list)[i];
    if (!entry.is_table()) refuse(entry, path, "a table: write [[obstacles]] with double brackets");
    obstacles.push_back(read_obstacle(*entry.as_table(), path));
  }
  return obstacles;
}

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

void check_fixed_shapes(const Scene& scene) {
  const std::span<const Obstacle> obstacles = fixed_shapes(scene.effects);
  if (obstacles.empty()) return;
  for (std::size_t o = 0; o < obstacles.size(); ++o) {
    const std::string path = path_of_shape(o);
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
      const auto found = overlapped_shape(scene.box, scene.effects, positions[i], species.radius_of(disk), touching);
      if (!found) continue;
      const bool round = std::holds_alternative<DiskObstacle>(obstacles[found->shape]);
      throw Refusal(fmt::format("disks.{}.positions.{}", s, i),
                    fmt::format("disk {} overlaps {} by {:.6g}; its centre must be at least {:.6g} from {}", first_id + disk,
                                path_of_shape(found->shape), found->depth, found->contact,
                                round ? "the centre of that disk" : "that segment"));
    }
    first_id += species.count;
  }
}

}  // namespace detail
}  // namespace carom
