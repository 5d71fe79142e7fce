// Growing disks must have an end that they can reach, and walls that stay where they are.

#include "scene/checks.hpp"
#include "scene/growth_room.hpp"
#include "scene/number_keys.hpp"
#include "scene/walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace carom::detail {
namespace {

void check_company(const Scene& scene) {
  for (std::size_t w = 0; w < scene.effects.walls.size(); ++w) {
    const WallProperties& wall = scene.effects.walls[w];
    const char* kind = wall.mass ? "piston" : moves(wall) ? "moving wall" : nullptr;
    if (kind == nullptr) continue;
    throw Refusal("growth",
                  fmt::format("[growth] and the {} walls.{} cannot be combined; remove one of the two", kind, wall_names[w]));
  }
}

/// Disks of different species must not reach from one image of another to the next.
void check_unlike(const Scene& scene, double scale) {
  for (const UnlikeContact& pair : unlike_contacts(scene))
    for (int axis = 0; axis < 2; ++axis) {
      const double length = scene.box.lengths()[axis];
      if (!scene.box.periodic(axis) || scale * pair.largest < length) continue;
      throw Refusal("growth",
                    fmt::format("disks of species {} and {} would grow until they touch {:.6g} apart, but the periodic box "
                                "is {:.6g} long in {}; end before that",
                                pair.one, pair.other, scale * pair.largest, length, axis_names[axis]));
    }
}

void check_target(const Scene& scene, const Growth& growth) {
  const double target = *growth.packing_fraction;
  const double present = scene.packing_fraction();
  const Radii radii = radii_of(scene);
  if (target < 1.0 && target > radii.densest() * (1.0 + touching) && !brings_unlike_nearer(scene)) {
    throw Refusal("growth", fmt::format("growth.until.packing_fraction is {}, but that of equal disks cannot exceed {:.4g}; "
                                        "disks of random order jam near 0.84",
                                        target, closest_packing));
  }
  if (target >= 1.0) {
    throw Refusal("growth", fmt::format("growth.until.packing_fraction is {}; it must be below 1", target));
  }
  if (target <= present) {
    throw Refusal("growth", fmt::format("growth.until.packing_fraction is {}, but the disks start at {:.6g}; make it larger, or "
                                        "the disks smaller",
                                        target, present));
  }
  const double scale = std::sqrt(target / present), diameter = 2.0 * radii.largest * scale;
  check_unlike(scene, scale);
  for (int axis = 0; axis < 2; ++axis) {
    const double length = scene.box.lengths()[axis];
    if (scale < growth_room(scene.box, axis, radii.largest)) continue;
    throw Refusal("growth", fmt::format("at growth.until.packing_fraction = {} the largest disk would be {:.6g} across, but the "
                                        "box is {:.6g} long in {}; end before that",
                                        target, diameter, length, axis_names[axis]));
  }
}

/// Checks a run that only its time can end. One that ends by pressure or collisions may end earlier.
void check_time(const Scene& scene, const Growth& growth) {
  const Run& run = scene.run;
  const bool may_end_before = growth.reduced_pressure || run.collisions;
  if (growth.packing_fraction || !run.time || (may_end_before && scene.disk_count() > 1)) return;
  const double radius = radii_of(scene).largest, scale = 1.0 + growth.rate * *run.time;
  check_unlike(scene, scale);
  for (int axis = 0; axis < 2; ++axis) {
    if (scale < growth_room(scene.box, axis, radius)) continue;
    throw Refusal("growth",
                  fmt::format("by run.time = {} the largest disk would be {:.6g} across, but it fills the box, {:.6g} long "
                              "in {}, at time {:.6g}; end before that, or make growth.rate smaller",
                              *run.time, 2.0 * radius * scale, scene.box.lengths()[axis], axis_names[axis],
                              std::max(0.0, scene.box.lengths()[axis] / (2.0 * radius) - 1.0) / growth.rate));
  }
}

}  // namespace

std::string ends_of_growth(const char* has) {
  return fmt::format("growth.until has {}; give exactly one, {{ packing_fraction = 0.84 }} or {{ pressure = 1e6 }}", has);
}

void check_growth(const Scene& scene) {
  if (!scene.effects.growth) return;
  const Growth& growth = *scene.effects.growth;
  require("growth.until", growth.packing_fraction, keys::until_fraction);
  require("growth.until", growth.reduced_pressure, keys::until_pressure);
  if (growth.packing_fraction && growth.reduced_pressure)
    throw Refusal("growth.until", ends_of_growth("both packing_fraction and pressure"));
  if (growth.packing_fraction && scene.disk_count() > 0) check_target(scene, growth);
  if (!(growth.rate > 0.0)) return;
  check_company(scene);
  if (!growth.packing_fraction && !growth.reduced_pressure && !scene.run.time && scene.run.collisions) {
    throw Refusal("growth",
                  "[growth] has no end; give until = { packing_fraction = 0.84 }, until = { pressure = 1e6 }, or time in [run]");
  }
  if (scene.disk_count() > 0) check_time(scene, growth);
}

}  // namespace carom::detail
