// The [[obstacles]] tables: how they are read, what is wrong with them, and which of them, or the rim of a circular box, a disk
// lies upon.

#include "scene/fixed_shapes.hpp"

#include "core/nearest_image.hpp"
#include "scene/checks.hpp"
#include "scene/number_keys.hpp"
#include "scene/read_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
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

double distance(const ArcObstacle& arc, const Eigen::Vector2d& point) {
  const Eigen::Vector2d from = point - arc.centre;
  if (spans(arc, from)) return std::abs(from.norm() - arc.radius);
  return std::min((from - arc.radius * direction(arc.from)).norm(), (from - arc.radius * direction(arc.to)).norm());
}

double distance(const Obstacle& shape, const Eigen::Vector2d& point) {
  if (const auto* disk = std::get_if<DiskObstacle>(&shape)) return (point - disk->centre).norm();
  if (const auto* arc = std::get_if<ArcObstacle>(&shape)) return distance(*arc, point);
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

struct Bounds {
  Eigen::Vector2d centre;
  double radius;
};
/// Returns a circle that holds all of a shape.
Bounds bounding_circle(const Obstacle& shape) {
  if (const auto* disk = std::get_if<DiskObstacle>(&shape)) return {disk->centre, disk->radius};
  if (const auto* arc = std::get_if<ArcObstacle>(&shape)) return {arc->centre, arc->radius};
  const auto& segment = std::get<SegmentObstacle>(shape);
  return {0.5 * (segment.from + segment.to), 0.5 * (segment.to - segment.from).norm()};
}

}  // namespace

std::string path_of_shape(const Effects& effects, std::size_t k) {
  return k < effects.obstacles.size() ? detail::path_of_obstacle(k) : "box.circle";
}

std::optional<ShapeOverlap> overlapped_shape(const Box& box, const Effects& effects, const Eigen::Vector2d& position,
                                             double radius, double tolerance) {
  const std::vector<Obstacle>& shapes = effects.obstacles;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const auto* disk = std::get_if<DiskObstacle>(&shapes[k]);
    const Bounds bounds = bounding_circle(shapes[k]);
    if (nearest_image(box, position - bounds.centre).norm() > (1.0 + 1e-12) * (radius + bounds.radius)) continue;
    const double contact = radius + (disk == nullptr ? 0.0 : disk->radius);
    const double depth = contact - distance(box, shapes[k], position);
    if (depth > tolerance * contact) return ShapeOverlap{k, depth, contact};
  }
  if (!effects.circle) return std::nullopt;
  const double depth = radius - (effects.circle->radius - (position - effects.circle->centre).norm());
  if (depth > tolerance * radius) return ShapeOverlap{shapes.size(), depth, radius};
  return std::nullopt;
}

namespace detail {
namespace {

using keys::arc_example;
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

ArcObstacle read_arc(const toml::table& node, const std::string& path) {
  const TableReader table(node, path, {"centre", "radius", "from", "to"});
  return {read_point(table, "centre", arc_example), table.required_number(keys::arc_radius),
          table.required_number(keys::arc_from), table.required_number(keys::arc_to)};
}

}  // namespace

std::string path_of_obstacle(std::size_t k) { return fmt::format("obstacles.{}", k); }

Obstacle read_obstacle(const toml::table& node, const std::string& path) {
  const TableReader table(node, path, {"disk", "segment", "arc"});
  const toml::table* disk = table.table("disk", std::string(disk_example));
  const toml::table* segment = table.table("segment", std::string(segment_example));
  const toml::table* arc = table.table("arc", std::string(arc_example));
  std::vector<std::string_view> given;
  if (disk != nullptr) given.push_back("disk");
  if (segment != nullptr) given.push_back("segment");
  if (arc != nullptr) given.push_back("arc");
  if (given.size() != 1) {
    throw SceneError(table.where(), fmt::format("{} has {}; give exactly one, disk = {}, segment = {} or arc = {}", path,
                                                given.empty() ? "neither disk nor segment nor arc"
                                                              : fmt::format("{}", fmt::join(given, " and ")),
                                                disk_example, segment_example, arc_example));
  }
  if (disk != nullptr) return read_disk(*disk, table.path("disk"));
  if (segment != nullptr) return read_segment(*segment, table.path("segment"));
  return read_arc(*arc, table.path("arc"));
}

std::vector<Obstacle> read_obstacles(const toml::node& node) {
  const toml::array* list = node.as_array();
  if (list == nullptr) refuse(node, "obstacles", "a list of tables: write [[obstacles]] with double brackets");
  std::vector<Obstacle> obstacles;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const std::string path = path_of_obstacle(i);
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

/// Refuses an obstacle of which a part is outside a circular box. `farthest` is the point of it that is the farthest from the
/// centre of the circle, or with `beyond` the centre of a disk of that radius; `what` is the key.
void require_in_circle(const Box& box, const Eigen::Vector2d& farthest, const std::string& path, const std::string& what,
                       double beyond = 0.0) {
  if (!box.is_circle) return;
  const Eigen::Vector2d centre = 0.5 * (box.lower + box.upper);
  const double radius = 0.5 * box.lengths().x(), reach = (farthest - centre).norm() + beyond;
  if (reach <= radius * (1.0 + 2.0 * touching)) return;
  throw Refusal(path, fmt::format("{}{} reaches {:.6g} from the centre of the circle, beyond its rim; it must stay within {:.6g}",
                                  path, what, reach, radius));
}

/// Returns the point of an arc that is the farthest from `place`.
Eigen::Vector2d farthest_on(const ArcObstacle& arc, const Eigen::Vector2d& place) {
  const Eigen::Vector2d away = arc.centre - place;
  if (away.norm() > 0.0 && spans(arc, away)) return arc.centre + arc.radius * away.normalized();
  const Eigen::Vector2d one = arc.centre + arc.radius * direction(arc.from), other = arc.centre + arc.radius * direction(arc.to);
  return (one - place).norm() > (other - place).norm() ? one : other;
}

void check_numbers_of(const Obstacle& obstacle, const std::string& path) {
  if (const auto* disk = std::get_if<DiskObstacle>(&obstacle)) {
    require_pair(path + ".disk.centre", disk->centre, keys::disk_example);
    require(path + ".disk", disk->radius, keys::obstacle_radius);
  } else if (const auto* segment = std::get_if<SegmentObstacle>(&obstacle)) {
    require_pair(path + ".segment.from", segment->from, keys::segment_example);
    require_pair(path + ".segment.to", segment->to, keys::segment_example);
  } else {
    const auto& arc = std::get<ArcObstacle>(obstacle);
    require_pair(path + ".arc.centre", arc.centre, keys::arc_example);
    require(path + ".arc", arc.radius, keys::arc_radius);
    require(path + ".arc", arc.from, keys::arc_from);
    require(path + ".arc", arc.to, keys::arc_to);
  }
}

/// Through a periodic edge a disk may stick out, but not so far that it meets its own image.
void check_disk(const Box& box, const DiskObstacle& disk, const std::string& path) {
  require_inside(box, disk.centre, path, ".disk.centre");
  require_in_circle(box, disk.centre, path, ".disk", disk.radius);
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
  require_in_circle(box, segment.from, path, ".segment.from");
  require_in_circle(box, segment.to, path, ".segment.to");
}

/// The whole arc lies in the box: what sticks out would be met by nothing, or by its own image.
void check_arc(const Box& box, const ArcObstacle& arc, const std::string& path) {
  const double span = arc.to - arc.from;
  constexpr double full = 360.0 * (1.0 + 1e-12);  // from + 360 may be a rounding more
  if (!(span > 0.0 && span <= full))
    throw Refusal(
        path + ".arc",
        fmt::format("{}.arc runs counterclockwise from {} to {} degrees; `to` must be above `from`, by at most 360, such "
                    "as {}",
                    path, arc.from, arc.to, keys::arc_example));
  require_in_circle(box, farthest_on(arc, 0.5 * (box.lower + box.upper)), path, ".arc");
  const Rectangle bounds = bounds_of(arc);
  const double slack = 2.0 * touching * arc.radius;
  for (int axis = 0; axis < 2; ++axis) {
    if (bounds.lower[axis] >= box.lower[axis] - slack && bounds.upper[axis] <= box.upper[axis] + slack) continue;
    throw Refusal(path, fmt::format("{}.arc reaches from {:.6g} to {:.6g} in {}; it must stay in the box, from {} to {}", path,
                                    bounds.lower[axis], bounds.upper[axis], axis_names[axis], box.lower[axis], box.upper[axis]));
  }
}

}  // namespace

namespace {

/// Returns where a disk would not overlap: "at least 0.5 from that segment".
std::string where_clear(const Effects& effects, const ShapeOverlap& found) {
  if (found.shape >= effects.obstacles.size())
    return fmt::format("at most {:.6g} from that of the circle", effects.circle->radius - found.contact);
  const Obstacle& shape = effects.obstacles[found.shape];
  const char* what = std::holds_alternative<DiskObstacle>(shape)      ? "the centre of that disk"
                     : std::holds_alternative<SegmentObstacle>(shape) ? "that segment"
                                                                      : "that arc";
  return fmt::format("at least {:.6g} from {}", found.contact, what);
}

}  // namespace

void check_fixed_shapes(const Scene& scene) {
  const std::vector<Obstacle>& obstacles = scene.effects.obstacles;
  if (obstacles.empty() && !scene.effects.circle) return;
  for (std::size_t o = 0; o < obstacles.size(); ++o) {
    const std::string path = path_of_obstacle(o);
    check_numbers_of(obstacles[o], path);
    if (const auto* disk = std::get_if<DiskObstacle>(&obstacles[o])) check_disk(scene.box, *disk, path);
    if (const auto* segment = std::get_if<SegmentObstacle>(&obstacles[o])) check_segment(scene.box, *segment, path);
    if (const auto* arc = std::get_if<ArcObstacle>(&obstacles[o])) check_arc(scene.box, *arc, path);
  }
  std::int64_t first_id = 0;
  for (std::size_t s = 0; s < scene.species.size(); ++s) {
    const Species& species = scene.species[s];
    const std::span<const Eigen::Vector2d> positions = given_positions(species);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const auto disk = static_cast<std::int64_t>(i);
      const auto found = overlapped_shape(scene.box, scene.effects, positions[i], species.radius_of(disk), touching);
      if (!found) continue;
      throw Refusal(fmt::format("disks.{}.positions.{}", s, i),
                    fmt::format("disk {} overlaps {} by {:.6g}; its centre must be {}", first_id + disk,
                                path_of_shape(scene.effects, found->shape), found->depth, where_clear(scene.effects, *found)));
    }
    first_id += species.count;
  }
}

}  // namespace detail
}  // namespace carom
