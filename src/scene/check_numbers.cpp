// Numbers of effects that a program gave: those of a file are within their bounds when they have been read.

#include "scene/checks.hpp"
#include "scene/wall_names.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace carom::detail {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr double smallest_normal = std::numeric_limits<double>::min();

/// NaN is in no range; infinity neither.
void require(double value, double lowest, double highest, const std::string& name, const char* range, const Location& where) {
  if (value >= lowest && value <= highest && std::isfinite(value)) return;
  throw SceneError(where, fmt::format("{} is {}; it must be {}", name, value, range));
}
void require(const std::optional<double>& value, double lowest, double highest, const std::string& name, const char* range,
             const Location& where) {
  if (value) require(*value, lowest, highest, name, range, where);
}

void check_collision(const Collision& collision) {
  const Location where{"collision", 0, 0};
  require(collision.restitution, 0.0, 1.0, "collision.restitution", "between 0 and 1", where);
  require(collision.roughness, -1.0, 1.0, "collision.roughness", "between -1 and 1", where);
  require(collision.elastic_below, 0.0, unbounded, "collision.elastic_below", "finite and not negative", where);
}

void check_wall(const WallProperties& wall, const std::string& name) {
  require(wall.restitution, 0.0, 1.0, name + ".restitution", "between 0 and 1", wall.where);
  require(wall.temperature, smallest_normal, unbounded, name + ".temperature", "finite and positive", wall.where);
  require(wall.velocity, -unbounded, unbounded, name + ".velocity", "finite", wall.where);
  require(wall.mass, smallest_normal, unbounded, name + ".mass", "finite and positive", wall.where);
  require(wall.load, 0.0, unbounded, name + ".load", "finite and not negative", wall.where);
}

void check_obstacle(const Obstacle& obstacle, const std::string& name) {
  const auto point = [&](const Eigen::Vector2d& p, const char* what) {
    for (const double coordinate : p) require(coordinate, -unbounded, unbounded, name + what, "finite", obstacle.where);
  };
  if (const auto* disk = std::get_if<DiskObstacle>(&obstacle.shape)) {
    point(disk->centre, ".disk.centre");
    require(disk->radius, smallest_normal, unbounded, name + ".disk.radius", "finite and positive", obstacle.where);
  } else {
    point(std::get<SegmentObstacle>(obstacle.shape).from, ".segment.from");
    point(std::get<SegmentObstacle>(obstacle.shape).to, ".segment.to");
  }
}

}  // namespace

void check_numbers(const Effects& effects) {
  check_collision(effects.collision);
  for (std::size_t w = 0; w < effects.walls.size(); ++w) check_wall(effects.walls[w], fmt::format("walls.{}", wall_names[w]));
  for (std::size_t k = 0; k < effects.obstacles.size(); ++k) check_obstacle(effects.obstacles[k], fmt::format("obstacles.{}", k));
  if (const auto& gravity = effects.gravity)
    for (const double g : gravity->acceleration)
      require(g, -unbounded, unbounded, "gravity.acceleration", "finite", gravity->where);
  if (const auto& growth = effects.growth) {
    require(growth->rate, 0.0, unbounded, "growth.rate", "finite and not negative", growth->where);
    require(growth->packing_fraction, smallest_normal, 1.0, "growth.until.packing_fraction", "between 0 and 1", growth->where);
    require(growth->reduced_pressure, smallest_normal, unbounded, "growth.until.reduced_pressure", "finite and positive",
            growth->where);
  }
  if (const auto& thermostat = effects.thermostat) {
    require(thermostat->temperature, smallest_normal, unbounded, "thermostat.temperature", "finite and positive",
            thermostat->where);
    require(thermostat->rate, 0.0, unbounded, "thermostat.rate", "finite and not negative", thermostat->where);
  }
  if (const auto& shear = effects.shear) require(shear->rate, -unbounded, unbounded, "shear.rate", "finite", shear->where);
  if (const auto& well = effects.square_well) {
    require(well->width, 1.0 + std::numeric_limits<double>::epsilon(), unbounded, "square_well.width", "finite and above 1",
            well->where);
    require(well->depth, -unbounded, unbounded, "square_well.depth", "finite", well->where);
  }
}

}  // namespace carom::detail
