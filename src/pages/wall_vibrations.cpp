#include "pages/wall_vibrations.hpp"

#include "scene/changes.hpp"
#include "scene/walls.hpp"

#include <array>
#include <optional>

namespace carom {

namespace {

void add(const Box& box, const Effects& effects, std::vector<WallVibration>& vibrations) {
  const std::array<double, 4> edges = {box.lower.x(), box.upper.x(), box.lower.y(), box.upper.y()};
  for (std::size_t side = 0; side < 4; ++side) {
    const std::optional<Oscillation>& asked = effects.walls[side].oscillation;
    if (!asked || !asked->moves()) continue;
    const double inward = inward_reach(*asked), outward = 2.0 * asked->amplitude - inward;
    const bool is_lower = side % 2 == 0;
    vibrations.push_back({side, edges[side] - (is_lower ? outward : inward), edges[side] + (is_lower ? inward : outward)});
  }
}

}  // namespace

std::vector<WallVibration> wall_vibrations(const Scene& scene) {
  std::vector<WallVibration> vibrations;
  Effects effects = scene.effects;
  add(scene.box, effects, vibrations);
  for (const Change& change : scene.changes) {
    effects = effects_after(effects, change);
    add(scene.box, effects, vibrations);
  }
  return vibrations;
}

}  // namespace carom
