// Walls with properties stand where the box has walls, and moving ones leave room for the disks and for what stands in the box.

#include "scene/checks.hpp"
#include "scene/fixed_shapes.hpp"
#include "scene/number_keys.hpp"
#include "scene/walls.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace carom::detail {
namespace {

std::string path_of(std::size_t wall) { return fmt::format("walls.{}", wall_names[wall]); }

/// A diffuse wall forgets how a disk came in; a piston finds its own velocity.
void check_kind(const WallProperties& wall, const std::string& path) {
  const auto refuse_both = [&](const char* one, const char* other, const char* reason) {
    throw Refusal(path, fmt::format("{} has {} and {}, but {}; remove one of the two", path, one, other, reason));
  };
  if (wall.temperature && wall.restitution)
    refuse_both("temperature", "restitution", "a wall that draws velocities anew has no restitution");
  if (wall.temperature && wall.mass) refuse_both("temperature", "mass", "a wall that draws velocities anew cannot be a piston");
  if (wall.velocity && wall.mass) refuse_both("velocity", "mass", "a piston moves as it is pushed");
  if (wall.vibration && wall.temperature)
    refuse_both("temperature", "vibration", "a wall that draws velocities anew does not reflect");
  if (wall.vibration && wall.velocity) refuse_both("velocity", "vibration", "a wall that vibrates stays where it is");
  if (wall.vibration && wall.mass) refuse_both("vibration", "mass", "a piston moves as it is pushed");
  if (wall.tangential_velocity && !wall.temperature)
    throw Refusal(path,
                  fmt::format("{} has tangential_velocity but no temperature; disks do not notice that a smooth wall slides, "
                              "so give both, such as {}",
                              path, keys::tangential_velocity.example));
  if (wall.mass.has_value() == wall.load.has_value()) return;
  throw Refusal(path, fmt::format("{} has {} but no {}; a piston needs both, such as {}", path, wall.mass ? "mass" : "load",
                                  wall.mass ? "load" : "mass", keys::piston_mass.example));
}

double velocity_of(const WallProperties& wall) { return wall.velocity.value_or(0.0); }

/// Returns for how long walls move in any case; the time to equilibrate comes before that of the run.
double duration(const Run& run) {
  const double before = run.equilibrate ? run.equilibrate->time.value_or(0.0) : 0.0;
  return before + run.time.value_or(0.0);
}

/// Returns which of the two walls across an axis to name where they come together.
std::size_t faster_inward(const Effects& effects, std::size_t lower) {
  return velocity_of(effects.walls[lower]) >= -velocity_of(effects.walls[lower + 1]) ? lower : lower + 1;
}

void check_gap(const Scene& scene, int axis) {
  const std::size_t lower = 2 * static_cast<std::size_t>(axis);
  const double closing = velocity_of(scene.effects.walls[lower]) - velocity_of(scene.effects.walls[lower + 1]);
  if (!(closing > 0.0)) return;
  const double time = duration(scene.run);
  const double diameter = 2.0 * radii_of(scene).largest;
  const double gap = scene.box.lengths()[axis] - closing * time;
  if (gap > 0.0 && gap >= diameter) return;
  const std::size_t wall = faster_inward(scene.effects, lower);
  const double room = (scene.box.lengths()[axis] - diameter) / closing;
  throw Refusal(
      path_of(wall),
      fmt::format("by time {:.6g} the moving walls would leave {:.6g} between {} and {}, but the largest disk is {:.6g} "
                  "across; make walls.{} slower, or end before time {:.6g}",
                  time, gap, wall_names[lower], wall_names[lower + 1], diameter, wall_names[wall], room));
}

void check_sweep(const Scene& scene, std::size_t w) {
  const WallProperties& wall = scene.effects.walls[w];
  const int axis = axis_of_wall(w);
  const bool upper = w % 2 == 1;
  const double inward = upper ? -velocity_of(wall) : velocity_of(wall);
  if (!(inward > 0.0)) return;
  const double travel = inward * duration(scene.run);
  const std::vector<Obstacle>& shapes = scene.effects.obstacles;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const Rectangle bounds = bounds_of(shapes[k]);
    const double room = upper ? scene.box.upper[axis] - bounds.upper[axis] : bounds.lower[axis] - scene.box.lower[axis];
    if (travel <= room) continue;
    throw Refusal(path_of(w), fmt::format("walls.{} would run into {} at time {:.6g}; make it slower, or end before that",
                                          wall_names[w], path_of_shape(scene.effects, k), room / inward));
  }
}

}  // namespace

void check_walls(const Scene& scene) {
  for (std::size_t w = 0; w < scene.effects.walls.size(); ++w) {
    const WallProperties& wall = scene.effects.walls[w];
    const int axis = axis_of_wall(w);
    check_kind(wall, path_of(w));
    if (!wall.present()) continue;
    if (scene.box.is_circle)
      throw Refusal(path_of(w), fmt::format("walls.{} is given, but the box is a circle, which has no sides; remove it, or take "
                                            "x and y in [box] in place of circle",
                                            wall_names[w]));
    if (scene.box.periodic(axis)) {
      throw Refusal(path_of(w),
                    fmt::format("walls.{} is given, but the box is periodic in {} and has no wall there; remove it, or "
                                "take boundary.{} = \"walls\"",
                                wall_names[w], axis_names[axis], axis_names[axis]));
    }
    check_sweep(scene, w);
  }
  check_gap(scene, 0);
  check_gap(scene, 1);
}

}  // namespace carom::detail
