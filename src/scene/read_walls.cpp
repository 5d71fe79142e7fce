// The [walls] table: one key per side of the box that is more than a hard wall at rest.

#include "scene/read_tables.hpp"
#include "scene/walls.hpp"

#include <fmt/format.h>

namespace carom::detail {
namespace {

WallProperties read_wall(const toml::table& node, const std::string& path) {
  const TableReader table(node, path, {"restitution", "temperature", "velocity", "mass", "load"});
  WallProperties wall;
  wall.restitution = table.number(keys::wall_restitution);
  wall.temperature = table.number(keys::wall_temperature);
  wall.velocity = table.number(keys::wall_velocity);
  wall.mass = table.number(keys::piston_mass);
  wall.load = table.number(keys::piston_load);
  if (node.empty()) {
    throw SceneError(table.where(),
                     fmt::format("{} has no property; give restitution, temperature, velocity, or mass and load, or remove "
                                 "it: a wall that is not named is hard and at rest",
                                 path));
  }
  return wall;
}

}  // namespace

std::array<WallProperties, 4> read_walls(const toml::table& node) {
  const TableReader table(node, "walls", {wall_names.begin(), wall_names.end()});
  std::array<WallProperties, 4> walls;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const toml::table* wall = table.table(wall_names[w], "{ restitution = 0.8 }");
    if (wall != nullptr) walls[w] = read_wall(*wall, table.path(wall_names[w]));
  }
  return walls;
}

}  // namespace carom::detail
