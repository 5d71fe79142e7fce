// The [[obstacles]] tables: fixed disks and fixed segments.

#include "scene/read_tables.hpp"

#include <fmt/format.h>

namespace carom::detail {
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
    const std::string path = fmt::format("obstacles.{}", i);
    const toml::node& entry = (*list)[i];
    if (!entry.is_table()) refuse(entry, path, "a table: write [[obstacles]] with double brackets");
    obstacles.push_back(read_obstacle(*entry.as_table(), path));
  }
  return obstacles;
}

}  // namespace carom::detail
