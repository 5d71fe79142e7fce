// The [walls] table: one key per side of the box that is more than a hard wall at rest.

#include "scene/read_tables.hpp"
#include "scene/wall_names.hpp"

#include <fmt/format.h>

namespace carom::detail {
namespace {

struct Exclusion {
  const char* one;
  const char* other;
  const char* reason;
};

/// A diffuse wall forgets how a disk came in; a piston finds its own velocity.
constexpr Exclusion exclusions[] = {
    {"temperature", "restitution", "a wall that draws velocities anew has no restitution"},
    {"temperature", "mass", "a wall that draws velocities anew cannot be a piston"},
    {"velocity", "mass", "a piston moves as it is pushed"},
};

WallProperties read_wall(const toml::table& node, const std::string& path) {
  const TableReader table(node, path, {"restitution", "temperature", "velocity", "mass", "load"});
  WallProperties wall;
  wall.where = table.where();
  wall.restitution = table.number_between("restitution", 0.0, 1.0, "{ restitution = 0.8 }");
  wall.temperature = table.number("temperature", Range::above_zero, "{ temperature = 2.0 }");
  wall.velocity = table.number("velocity", Range::any, "{ velocity = -0.1 }");
  wall.mass = table.number("mass", Range::above_zero, "{ mass = 10.0, load = 5.0 }");
  wall.load = table.number("load", Range::zero_or_more, "{ mass = 10.0, load = 5.0 }");
  for (const Exclusion& pair : exclusions) {
    if (table.find(pair.one) == nullptr || table.find(pair.other) == nullptr) continue;
    throw SceneError(wall.where,
                     fmt::format("{} has {} and {}, but {}; remove one of the two", path, pair.one, pair.other, pair.reason));
  }
  if (wall.mass.has_value() != wall.load.has_value()) {
    throw SceneError(wall.where, fmt::format("{} has {} but no {}; a piston needs both, such as {{ mass = 10.0, load = 5.0 }}",
                                             path, wall.mass ? "mass" : "load", wall.mass ? "load" : "mass"));
  }
  if (!wall.present()) {
    throw SceneError(wall.where,
                     fmt::format("{} says nothing; give restitution, temperature, velocity, or mass and load, or remove "
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
