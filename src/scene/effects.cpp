// Which effects a scene calls for.

#include <carom/effects.hpp>

#include <algorithm>

namespace carom {

namespace {

template <class Property>
bool any(const std::array<WallProperties, 4>& walls, Property&& property) {
  return std::any_of(walls.begin(), walls.end(), property);
}

}  // namespace

std::vector<std::string> Effects::acting() const {
  std::vector<std::string> names;
  const auto put = [&](bool acts, const char* name) {
    if (acts) names.emplace_back(name);
  };
  put(collision.restitution.value_or(1.0) != 1.0, "restitution");
  put(collision.roughness.value_or(-1.0) != -1.0, "roughness");
  put(dissipate() && collision.elastic_below.value_or(0.0) > 0.0, "elastic_below");
  put(gravity && !gravity->acceleration.isZero(0.0), "gravity");
  put(any(walls, [](const WallProperties& wall) { return wall.restitution.value_or(1.0) != 1.0; }), "inelastic_walls");
  put(any(walls, [](const WallProperties& wall) { return wall.temperature.has_value(); }), "thermal_walls");
  put(any(walls, [](const WallProperties& wall) { return wall.velocity.value_or(0.0) != 0.0; }), "moving_walls");
  put(any(walls, [](const WallProperties& wall) { return wall.mass.has_value(); }), "pistons");
  put(!obstacles.empty(), "obstacles");
  put(growth && growth->rate != 0.0, "growth");
  put(thermostat && thermostat->rate != 0.0, "thermostat");
  put(shear && shear->rate != 0.0, "shear");
  put(square_well && square_well->depth != 0.0, "square_well");
  return names;
}

bool Effects::dissipate() const {
  const double roughness = collision.roughness.value_or(-1.0);
  return collision.restitution.value_or(1.0) < 1.0 || (roughness > -1.0 && roughness < 1.0) ||
         any(walls, [](const WallProperties& wall) { return wall.restitution.value_or(1.0) < 1.0; });
}

bool keeps_momentum(const Box& box, const Effects& effects, int axis) {
  const bool pushed = (effects.thermostat && effects.thermostat->rate > 0.0) || !effects.obstacles.empty() ||
                      any(effects.walls, [](const WallProperties& wall) { return wall.temperature.has_value(); });
  return box.periodic(axis) && !pushed;
}

std::vector<std::string> names_of(const Effects& effects, bool walled) {
  std::vector<std::string> names = {effects.collision.rule == CollisionRule::reversal ? "reversal" : "specular"};
  const auto put = [&](bool present, const char* name) {
    if (present) names.emplace_back(name);
  };
  put(walled, "walls");
  put(effects.collision.restitution.has_value(), "restitution");
  put(effects.collision.roughness.has_value(), "roughness");
  put(effects.collision.elastic_below.has_value(), "elastic_below");
  put(effects.gravity.has_value(), "gravity");
  put(any(effects.walls, [](const WallProperties& wall) { return wall.restitution.has_value(); }), "inelastic_walls");
  put(any(effects.walls, [](const WallProperties& wall) { return wall.temperature.has_value(); }), "thermal_walls");
  put(any(effects.walls, [](const WallProperties& wall) { return wall.velocity.has_value(); }), "moving_walls");
  put(any(effects.walls, [](const WallProperties& wall) { return wall.mass.has_value(); }), "pistons");
  put(!effects.obstacles.empty(), "obstacles");
  put(effects.growth.has_value(), "growth");
  put(effects.thermostat.has_value(), "thermostat");
  put(effects.shear.has_value(), "shear");
  put(effects.square_well.has_value(), "square_well");
  return names;
}

std::string words_beyond_the_rule(const Effects& effects) {
  const std::vector<std::string> names = names_of(effects, false);
  std::string words;
  for (std::size_t k = 1; k < names.size(); ++k) words += (k > 1 ? ", " : "") + names[k];
  return words;
}

}  // namespace carom
