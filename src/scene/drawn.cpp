#include "scene/drawn.hpp"

#include "scene/effect_traits.hpp"

#include <algorithm>
#include <variant>

namespace carom {

namespace {

bool is_drawn(const Positions& positions) {
  return std::holds_alternative<RandomPositions>(positions) || std::holds_alternative<GrownPositions>(positions);
}

/// Returns whether velocities are random; a law by which all disks are at rest draws nothing.
bool is_drawn(const Velocities& velocities) {
  if (const auto* uniform = std::get_if<UniformVelocities>(&velocities)) return uniform->maximum > 0.0;
  if (const auto* thermal = std::get_if<MaxwellVelocities>(&velocities)) return thermal->temperature > 0.0;
  const auto* fixed = std::get_if<FixedSpeed>(&velocities);
  return fixed != nullptr && fixed->speed > 0.0;
}

}  // namespace

bool start_is_drawn(const Scene& scene) {
  return std::any_of(scene.species.begin(), scene.species.end(), [](const Species& species) {
    return species.count > 0 && (species.radii_are_drawn || is_drawn(species.positions) || is_drawn(species.velocities));
  });
}

bool run_is_drawn(const Scene& scene) {
  return start_is_drawn(scene) || detail::any_acting(scene.effects, &detail::EffectTraits::draws_random_numbers);
}

}  // namespace carom
