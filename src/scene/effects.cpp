// Which effects a scene calls for.

#include <carom/effects.hpp>

#include <algorithm>

namespace carom {

namespace {

bool is_hard(const WallProperties& wall) {
  return wall.restitution.value_or(1.0) == 1.0 && !wall.temperature && wall.velocity.value_or(0.0) == 0.0 && !wall.mass;
}

template <class Property>
bool any(const std::array<WallProperties, 4>& walls, Property&& property) {
  return std::any_of(walls.begin(), walls.end(), property);
}

}  // namespace

bool Effects::neutral() const {
  return collision.restitution.value_or(1.0) == 1.0 && collision.roughness.value_or(-1.0) == -1.0 &&
         (!gravity || gravity->acceleration.isZero(0.0)) && std::all_of(walls.begin(), walls.end(), is_hard) &&
         obstacles.empty() && (!growth || growth->rate == 0.0) && (!thermostat || thermostat->rate == 0.0) &&
         (!shear || shear->rate == 0.0) && (!square_well || square_well->depth == 0.0);
}

bool Effects::dissipate() const {
  const double roughness = collision.roughness.value_or(-1.0);
  return collision.restitution.value_or(1.0) < 1.0 || (roughness > -1.0 && roughness < 1.0) ||
         any(walls, [](const WallProperties& wall) { return wall.restitution.value_or(1.0) < 1.0; });
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
