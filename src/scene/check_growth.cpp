// Growing disks must have an end that they can reach, and walls that stay where they are.

#include "scene/checks.hpp"
#include "scene/wall_names.hpp"

#include <fmt/format.h>

#include <cmath>

namespace carom::detail {
namespace {

void check_company(const Scene& scene, const Growth& growth) {
  if (scene.run.equilibrate) {
    throw SceneError(
        growth.where,
        "[growth] and run.equilibrate cannot be combined; grow the disks in a run of their own, and equilibrate in one "
        "that starts from what they have grown to");
  }
  for (std::size_t w = 0; w < scene.effects.walls.size(); ++w) {
    const WallProperties& wall = scene.effects.walls[w];
    const char* kind = wall.mass ? "piston" : wall.velocity ? "moving wall" : nullptr;
    if (kind == nullptr) continue;
    throw SceneError(growth.where,
                     fmt::format("[growth] and the {} walls.{} cannot be combined; remove one of the two", kind, wall_names[w]));
  }
}

void check_target(const Scene& scene, const Growth& growth) {
  const double target = *growth.packing_fraction;
  const double present = scene.packing_fraction();
  const Radii radii = radii_of(scene);
  if (target > closest_packing * (1.0 + touching) && radii.equal()) {
    throw SceneError(growth.where,
                     fmt::format("growth.until.packing_fraction is {}, but that of equal disks cannot exceed {:.4g}; "
                                 "disks of random order jam near 0.84",
                                 target, closest_packing));
  }
  if (target >= 1.0) {
    throw SceneError(growth.where, fmt::format("growth.until.packing_fraction is {}; it must be below 1", target));
  }
  if (target <= present) {
    throw SceneError(growth.where,
                     fmt::format("growth.until.packing_fraction is {}, but the disks start at {:.6g}; make it larger, or "
                                 "the disks smaller",
                                 target, present));
  }
  const double diameter = 2.0 * radii.largest * std::sqrt(target / present);
  for (int axis = 0; axis < 2; ++axis) {
    const double length = scene.box.lengths()[axis];
    if (diameter < length) continue;
    throw SceneError(growth.where,
                     fmt::format("at growth.until.packing_fraction = {} the largest disk would be {:.6g} across, but the "
                                 "box is {:.6g} long in {}; end before that",
                                 target, diameter, length, axis_names[axis]));
  }
}

}  // namespace

void check_growth(const Scene& scene) {
  if (!scene.effects.growth) return;
  const Growth& growth = *scene.effects.growth;
  check_company(scene, growth);
  if (!growth.packing_fraction && !growth.reduced_pressure && !scene.run.time) {
    throw SceneError(
        growth.where,
        "[growth] has no end; give until = { packing_fraction = 0.84 }, until = { pressure = 1e6 }, or time in [run]");
  }
  if (growth.packing_fraction && scene.disk_count() > 0) check_target(scene, growth);
}

}  // namespace carom::detail
