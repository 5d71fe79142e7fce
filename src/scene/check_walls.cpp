// Walls with properties stand where the box has walls, and moving ones leave room for the disks and for what stands in the box.

#include "core/oscillating_fall_time.hpp"
#include "scene/checks.hpp"
#include "scene/fixed_shapes.hpp"
#include "scene/growth_room.hpp"
#include "scene/number_keys.hpp"
#include "scene/walls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

/// Returns the motion of a wall, inward as up, from where a period has it in the middle of its way.
OscillatingFloor<double> floor_of(const Oscillation& motion) {
  return {motion.amplitude, motion.frequency, motion.phase, motion.form == WaveForm::sawtooth};
}

}  // namespace

double inward_after(const Oscillation& oscillation, double time) {
  if (!oscillation.moves()) return 0.0;
  const OscillatingFloor<double> floor = floor_of(oscillation);
  return floor.height(time) - floor.height(0.0);
}

double inward_reach(const Oscillation& oscillation) {
  return oscillation.moves() ? oscillation.amplitude - floor_of(oscillation).height(0.0) : 0.0;
}

double joint_reach(const std::optional<Oscillation>& one, const std::optional<Oscillation>& other) {
  const auto reach = [](const std::optional<Oscillation>& wall) { return wall ? inward_reach(*wall) : 0.0; };
  const bool in_step = one && other && one->moves() && other->moves() && one->frequency == other->frequency &&
                       one->form == WaveForm::sine && other->form == WaveForm::sine;
  if (!in_step) return reach(one) + reach(other);
  // Two sines of one frequency add up to a sine.
  const SineAndCosine<double> a = sine_and_cosine(one->phase), b = sine_and_cosine(other->phase);
  const double sine = one->amplitude * a.sine + other->amplitude * b.sine;
  const double cosine = one->amplitude * a.cosine + other->amplitude * b.cosine;
  return std::sqrt(sine * sine + cosine * cosine) - sine;
}

namespace detail {
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
  const bool vibrates = wall.vibration || wall.oscillation;
  if (vibrates && wall.temperature) refuse_both("temperature", "vibration", "a wall that draws velocities anew does not reflect");
  if (vibrates && wall.velocity)
    refuse_both("velocity", "vibration", wall.vibration ? "a wall that vibrates stays where it is" : "a wall has one motion");
  if (vibrates && wall.mass) refuse_both("vibration", "mass", "a piston moves as it is pushed");
  if (wall.vibration && wall.oscillation)
    refuse_both("vibration", "oscillation", "a wall vibrates with an amplitude or without one");
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

/// Returns the least gap between walls in which the number of a disk's bounces stays that of seconds, as where disks grow.
double least_gap(double diameter) { return diameter / (1.0 - detail::room_left); }
bool leave_room(double gap, double diameter) { return gap > 0.0 && gap >= least_gap(diameter); }

/// Returns what ends the sentence about a gap that does not.
const char* why_no_room(double gap, double diameter) {
  return gap >= diameter ? ", and would bounce ever faster in so little room" : "";
}

/// Walls that vibrate may come together far before the end, so the run has to leave room for it at any time.
void check_vibrating_gap(const Scene& scene, int axis) {
  const std::size_t lower = 2 * static_cast<std::size_t>(axis);
  const auto& walls = scene.effects.walls;
  const double reach = joint_reach(walls[lower].oscillation, walls[lower + 1].oscillation);
  if (!(reach > 0.0)) return;
  const double closing = std::max(velocity_of(walls[lower]) - velocity_of(walls[lower + 1]), 0.0) * duration(scene.run);
  const double diameter = 2.0 * radii_of(scene).largest, gap = scene.box.lengths()[axis] - closing - reach;
  if (leave_room(gap, diameter)) return;
  const std::size_t wall = walls[lower].oscillation ? lower : lower + 1;
  throw Refusal(path_of(wall) + ".vibration",
                fmt::format("with their vibration the walls would leave {:.6g} between {} and {}, but the largest disk is {:.6g} "
                            "across{}; make the amplitude smaller, or the box larger",
                            gap, wall_names[lower], wall_names[lower + 1], diameter, why_no_room(gap, diameter)));
}

void check_gap(const Scene& scene, int axis) {
  const std::size_t lower = 2 * static_cast<std::size_t>(axis);
  const double closing = velocity_of(scene.effects.walls[lower]) - velocity_of(scene.effects.walls[lower + 1]);
  if (!(closing > 0.0)) return;
  const double time = duration(scene.run);
  const double diameter = 2.0 * radii_of(scene).largest;
  const double gap = scene.box.lengths()[axis] - closing * time;
  if (leave_room(gap, diameter)) return;
  const std::size_t wall = faster_inward(scene.effects, lower);
  const double room = (scene.box.lengths()[axis] - least_gap(diameter)) / closing;
  throw Refusal(
      path_of(wall),
      fmt::format("within a time of {:.6g} the moving walls would leave {:.6g} between {} and {}, but the largest disk is {:.6g} "
                  "across{}; make walls.{} slower, or let them move for less than {:.6g}",
                  time, gap, wall_names[lower], wall_names[lower + 1], diameter, why_no_room(gap, diameter), wall_names[wall],
                  room));
}

void check_vibrating_sweep(const Scene& scene, std::size_t w) {
  const WallProperties& wall = scene.effects.walls[w];
  if (!wall.oscillation || !wall.oscillation->moves()) return;
  const int axis = axis_of_wall(w);
  const double reach = inward_reach(*wall.oscillation);
  const std::vector<Obstacle>& shapes = scene.effects.obstacles;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const Rectangle bounds = bounds_of(shapes[k]);
    const double room =
        is_upper_wall(w) ? scene.box.upper[axis] - bounds.upper[axis] : bounds.lower[axis] - scene.box.lower[axis];
    if (reach <= room) continue;
    throw Refusal(
        path_of(w) + ".vibration",
        fmt::format("walls.{} comes {:.6g} inward in each period and would run into {}, which is {:.6g} from it; make the "
                    "amplitude smaller",
                    wall_names[w], reach, path_of_shape(scene.effects, k), room));
  }
}

/// A disk that a sine leaves no way down hops on it, 2^-40 of a radius high. A hop must be slow beside the wall: at 2^-30 of a
/// radius it has 1/23 of the wall's speed.
void check_amplitude(const Scene& scene, std::size_t w) {
  const std::optional<Oscillation>& motion = scene.effects.walls[w].oscillation;
  if (!motion || !motion->moves() || motion->form != WaveForm::sine) return;
  const double smallest = 0x1p-30 * radii_of(scene).smallest;
  if (motion->amplitude >= smallest) return;
  throw Refusal(
      path_of(w) + ".vibration",
      fmt::format("{0}.vibration.amplitude is {1:.3g}, and that of a sine must be at least {2:.3g}, the smallest radius over "
                  "2^30; give a wall without amplitude as {0}.vibration = SPEED",
                  path_of(w), motion->amplitude, smallest));
}

void check_sweep(const Scene& scene, std::size_t w) {
  const WallProperties& wall = scene.effects.walls[w];
  const int axis = axis_of_wall(w);
  const bool upper = is_upper_wall(w);
  const double inward = upper ? -velocity_of(wall) : velocity_of(wall);
  if (!(inward > 0.0)) return;
  const double travel = inward * duration(scene.run);
  const std::vector<Obstacle>& shapes = scene.effects.obstacles;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const Rectangle bounds = bounds_of(shapes[k]);
    const double room = upper ? scene.box.upper[axis] - bounds.upper[axis] : bounds.lower[axis] - scene.box.lower[axis];
    if (travel <= room) continue;
    throw Refusal(path_of(w),
                  fmt::format("walls.{} would run into {} after a time of {:.6g}; make it slower, or let it move less long",
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
    check_vibrating_sweep(scene, w);
    check_amplitude(scene, w);
  }
  for (const int axis : {0, 1}) {
    check_gap(scene, axis);
    check_vibrating_gap(scene, axis);
  }
}

}  // namespace detail
}  // namespace carom
