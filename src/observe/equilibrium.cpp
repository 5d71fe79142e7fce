#include "observe/equilibrium.hpp"

#include "scene/effect_traits.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace carom {

namespace {

bool has_walls_of_different_temperature(const Effects& effects) {
  std::optional<double> first = effects.bath_temperature();
  for (const WallProperties& wall : effects.walls) {
    if (!wall.temperature) continue;
    if (first && *first != *wall.temperature) return true;
    first = wall.temperature;
  }
  return false;
}

}  // namespace

std::string_view why_no_Z(const Effects& effects) {
  if (std::abs(effects.collision.roughness.value_or(-1.0)) != 1.0) return "collisions take energy away";
  if (has_walls_of_different_temperature(effects)) return "walls differ in temperature, or from the thermostat";
  return detail::first_reason(effects, &detail::EffectTraits::why_no_Z);
}

bool temperature_fluctuates(const Effects& effects) {
  return detail::any_acting(effects, &detail::EffectTraits::lets_temperature_fluctuate);
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
