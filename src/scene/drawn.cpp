#include "scene/drawn.hpp"

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
    return species.count > 0 && (is_drawn(species.positions) || is_drawn(species.velocities));
  });
}

bool run_is_drawn(const Scene& scene) {
  const auto& walls = scene.effects.walls;
  const bool thermal = std::any_of(walls.begin(), walls.end(), [](const auto& wall) { return wall.temperature.has_value(); });
  return start_is_drawn(scene) || thermal || (scene.effects.thermostat && scene.effects.thermostat->rate > 0.0);
}

}  // namespace carom
