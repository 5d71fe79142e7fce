#include "observe/equilibrium.hpp"

#include "observe/any_wall.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace carom {

namespace {

bool has_walls_of_different_temperature(const Effects& effects) {
  std::optional<double> first;
  if (effects.thermostat && effects.thermostat->rate > 0.0) first = effects.thermostat->temperature;
  for (const WallProperties& wall : effects.walls) {
    if (!wall.temperature) continue;
    if (first && *first != *wall.temperature) return true;
    first = wall.temperature;
  }
  return false;
}

}  // namespace

std::string_view why_no_Z(const Effects& effects) {
  const Collision& collision = effects.collision;
  if (collision.restitution.value_or(1.0) != 1.0 || std::abs(collision.roughness.value_or(-1.0)) != 1.0)
    return "collisions take energy away";
  if (effects.gravity && !effects.gravity->acceleration.isZero(0.0)) return "pressure and density change with height";
  if (any_wall(effects, [](const WallProperties& wall) { return wall.mass || wall.velocity.value_or(0.0) != 0.0; }))
    return "the area changes";
  if (any_wall(effects, [](const WallProperties& wall) { return wall.restitution.value_or(1.0) != 1.0; }))
    return "walls take energy away";
  if (has_walls_of_different_temperature(effects)) return "walls differ in temperature, or from the thermostat";
  if (!effects.obstacles.empty()) return "obstacles carry pressure and take up area";
  if (effects.growth && effects.growth->rate != 0.0) return "disks grow";
  if (effects.shear && effects.shear->rate != 0.0) return "shear heats the disks";
  return {};
}

bool temperature_fluctuates(const Effects& effects) {
  return effects.collision.roughness.value_or(-1.0) != -1.0 || (effects.thermostat && effects.thermostat->rate > 0.0) ||
         any_wall(effects, [](const WallProperties& wall) { return wall.temperature.has_value(); }) ||
         (effects.square_well && effects.square_well->depth != 0.0);
}

std::string_view why_errors_are_of_one_start(const Scene& scene) {
  Effects others = scene.effects;
  others.obstacles.clear();  // they turn velocities, and change no speed
  if (others.collision.rule != CollisionRule::reversal || temperature_fluctuates(others) || !why_no_Z(others).empty()) return {};
  std::optional<double> mass;
  for (const Species& species : scene.species)
    for (std::int64_t i = 0; i < (species.masses.empty() ? std::min<std::int64_t>(species.count, 1) : species.count); ++i) {
      if (mass.value_or(species.mass_of(i)) != species.mass_of(i)) return {};
      mass = species.mass_of(i);
    }
  return "disks of equal mass only exchange velocities under reversal: errors are those within this run, not those between "
         "starts";
}

}  // namespace carom
