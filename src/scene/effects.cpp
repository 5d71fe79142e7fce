// Which effects a scene calls for.

#include "scene/contact_scales.hpp"
#include "scene/effect_traits.hpp"

#include <carom/effects.hpp>

#include <algorithm>

namespace carom {

std::vector<std::string> Effects::acting() const {
  std::vector<std::string> names;
  for (const detail::EffectTraits& effect : detail::all_effects())
    if (effect.acts(*this)) names.emplace_back(effect.name);
  return names;
}

bool Effects::dissipate() const {
  const double roughness = collision.roughness.value_or(-1.0);
  return collision.restitution.value_or(1.0) < 1.0 || (roughness > -1.0 && roughness < 1.0) ||
         std::ranges::any_of(walls, [](const WallProperties& wall) { return wall.restitution.value_or(1.0) < 1.0; });
}

double NonAdditivity::between(std::int64_t one, std::int64_t other) const {
  if (one == other) return 0.0;
  for (const Pair& pair : pairs)
    if ((pair.species[0] == one && pair.species[1] == other) || (pair.species[0] == other && pair.species[1] == one))
      return pair.delta;
  return delta;
}

std::vector<double> deltas_of(const NonAdditivity& mixture, std::size_t species) {
  std::vector<double> deltas(species * species, mixture.delta);
  for (std::size_t k = 0; k < species; ++k) deltas[k * species + k] = 0.0;
  for (auto pair = mixture.pairs.rbegin(); pair != mixture.pairs.rend(); ++pair) {
    const auto one = static_cast<std::size_t>(pair->species[0]), other = static_cast<std::size_t>(pair->species[1]);
    if (one < species && other < species && one != other)
      deltas[one * species + other] = deltas[other * species + one] = pair->delta;
  }
  return deltas;
}

void put_in_circle(Box& box, Effects& effects, const Circle& circle) {
  const Eigen::Vector2d radius = Eigen::Vector2d::Constant(circle.radius);
  box = {circle.centre - radius, circle.centre + radius, {Boundary::walls, Boundary::walls}, true};
  effects.circle = circle;
}

bool conserves_momentum(const Box& box, const Effects& effects, int axis) {
  const auto changes_it = [&](const detail::EffectTraits& effect) { return !effect.conserves_momentum && effect.acts(effects); };
  return box.periodic(axis) && effects.acceleration()[axis] == 0.0 && std::ranges::none_of(detail::all_effects(), changes_it);
}

bool centre_of_mass_is_thermal(const Box& box, const Effects& effects, int axis) {
  return !box.periodic(axis) || detail::any_acting(effects, &detail::EffectTraits::thermalises_centre_of_mass);
}

std::vector<std::string> names_of(const Effects& effects, bool walled) {
  std::vector<std::string> names = {effects.collision.rule == CollisionRule::reversal ? "reversal" : "specular"};
  if (walled) names.emplace_back("walls");
  for (const detail::EffectTraits& effect : detail::all_effects())
    if (effect.is_present(effects)) names.emplace_back(effect.name);
  return names;
}

std::string words_beyond_the_rule(const Effects& effects) {
  const std::vector<std::string> names = names_of(effects, false);
  std::string words;
  for (std::size_t k = 1; k < names.size(); ++k) words += (k > 1 ? ", " : "") + names[k];
  return words;
}

}  // namespace carom
