// What space and time do not know of, an engine must not know of either: where the box is, which hand is the right one, how disks
// are called, and in what units lengths and times are given. Random scenes with any effects.

#include "support/decoded_scene.hpp"
#include "support/engine_agreement.hpp"
#include "support/scenes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace carom::test {
namespace {

constexpr std::uint64_t events = 300;

std::optional<Scene> any_scene() {
  const auto bytes = *rc::gen::container<std::vector<std::uint8_t>>(160, rc::gen::arbitrary<std::uint8_t>());
  const std::string text = decoded_scene(bytes);
  RC_LOG() << text;
  try {
    Scene scene = parse_scene(text);
    draw_start(scene);
    return scene;
  } catch (const SceneError&) {
    return std::nullopt;
  }
}

/// Whether random numbers act, which belong to disks and walls by their names.
bool draws(const Effects& effects) {
  return effects.thermostat || effects.tumbling || effects.brownian ||
         std::any_of(effects.walls.begin(), effects.walls.end(), [](const auto& wall) { return wall.temperature; });
}

template <class Change>
void for_all_positions(Scene& scene, Change&& change) {
  for (Species& species : scene.species)
    for (Eigen::Vector2d& r : std::get<ListedPositions>(species.positions).values) change(r);
}
template <class Change>
void for_all_velocities(Scene& scene, Change&& change) {
  for (Species& species : scene.species)
    for (Eigen::Vector2d& v : std::get<ListedVelocities>(species.velocities).values) change(v);
}
template <class Change>
void for_all_points(std::vector<Obstacle>& obstacles, Change&& change) {
  for (Obstacle& obstacle : obstacles) {
    if (auto* disk = std::get_if<DiskObstacle>(&obstacle)) change(disk->centre);
    if (auto* segment = std::get_if<SegmentObstacle>(&obstacle)) change(segment->from), change(segment->to);
    if (auto* arc = std::get_if<ArcObstacle>(&obstacle)) change(arc->centre);
  }
}

/// The events of `scene` and of `changed`, translated back, must not part.
template <class Back>
void expect_same_events(const Scene& scene, const Scene& changed, Back&& back) {
  const std::size_t count =
      determined(scene, run_watched(scene, "textbook", events), run_watched(scene, "textbook-long-double", events), events);
  for (const std::string& engine : engines_covering(scene)) {
    if (engine != "fast" && engine != "general" && engine != "textbook") continue;
    const WatchedRun one = run_watched(scene, engine, events);
    WatchedRun other = run_watched(changed, engine, events);
    RC_ASSERT(other.fault == "");
    for (Event& event : other.events) event = back(event);
    other.engine += ", changed";
    RC_ASSERT(first_difference(one, other, count) == "");
  }
}

// ------------------------------------------------------------------------------------------------------- mirror images

Scene mirrored(Scene scene) {
  const auto turn = [](Eigen::Vector2d& vector) { vector[0] = -vector[0]; };
  std::swap(scene.box.lower[0], scene.box.upper[0]);
  turn(scene.box.lower), turn(scene.box.upper);
  for_all_positions(scene, turn);
  for_all_velocities(scene, turn);
  Effects& effects = scene.effects;
  for_all_points(effects.obstacles, turn);
  for (Obstacle& obstacle : effects.obstacles)
    if (auto* arc = std::get_if<ArcObstacle>(&obstacle)) {
      const double from = arc->from;
      arc->from = 180.0 - arc->to, arc->to = 180.0 - from;
    }
  if (effects.circle) turn(effects.circle->centre);
  if (effects.gravity) turn(effects.gravity->acceleration);
  std::swap(effects.walls[0], effects.walls[1]);
  for (const std::size_t side : {0U, 1U})
    if (effects.walls[side].velocity) effects.walls[side].velocity = -*effects.walls[side].velocity;
  if (effects.shear) effects.shear->rate = -effects.shear->rate;
  return scene;
}

Event mirrored(Event event) {
  event.velocity[0] = -event.velocity[0];
  event.partner_velocity[0] = -event.partner_velocity[0];
  if (event.partner == wall_left || event.partner == wall_right)
    event.partner = event.partner == wall_left ? wall_right : wall_left;
  return event;
}

RC_GTEST_PROP(PropertySymmetries, MirrorImagesMoveAsMirrorImages, ()) {
  const std::optional<Scene> scene = any_scene();
  RC_PRE(scene && !draws(scene->effects));
  expect_same_events(*scene, mirrored(*scene), [](const Event& event) { return mirrored(event); });
}

// ----------------------------------------------------------------------------------------------------------- other names

RC_GTEST_PROP(PropertySymmetries, DisksByOtherNamesMoveTheSame, ()) {
  const std::optional<Scene> scene = any_scene();
  RC_PRE(scene && !draws(scene->effects));
  Scene renamed = *scene;
  std::reverse(renamed.species.begin(), renamed.species.end());
  if (renamed.effects.non_additivity)
    for (NonAdditivity::Pair& pair : renamed.effects.non_additivity->pairs)
      for (std::int64_t& one : pair.species) one = static_cast<std::int64_t>(scene->species.size()) - 1 - one;
  const auto last = static_cast<std::int32_t>(scene->disk_count()) - 1;
  expect_same_events(*scene, renamed, [last](Event event) {
    event.disk = last - event.disk;
    if (event.partner < 0) return event;
    event.partner = last - event.partner;
    std::swap(event.disk, event.partner);
    std::swap(event.velocity, event.partner_velocity);
    return event;
  });
}

// ----------------------------------------------------------------------------------------------------------- elsewhere

RC_GTEST_PROP(PropertySymmetries, APeriodicBoxMayBeginAnywhere, ()) {
  const std::optional<Scene> scene = any_scene();
  RC_PRE(scene && !draws(scene->effects) && scene->effects.obstacles.empty() && !scene->effects.shear);
  RC_PRE(scene->box.periodic(0) || scene->box.periodic(1));
  Scene shifted = *scene;
  const Box& box = scene->box;
  for_all_positions(shifted, [&](Eigen::Vector2d& r) {
    for (int axis = 0; axis < 2; ++axis) {
      if (!box.periodic(axis)) continue;
      r[axis] += 0.375 * box.lengths()[axis];
      if (r[axis] >= box.upper[axis]) r[axis] = std::max(r[axis] - box.lengths()[axis], box.lower[axis]);
    }
  });
  try {
    draw_start(shifted);
  } catch (const SceneError&) {
    RC_DISCARD("rounding has made two disks overlap");
  }
  expect_same_events(*scene, shifted, [](const Event& event) { return event; });
}

// ---------------------------------------------------------------------------------------------------------- other units

/// Lengths times 2^a, times times 2^b; masses stay.
Scene in_other_units(Scene scene, int a, int b) {
  const auto scale = [](double& number, int by) { number = std::ldexp(number, by); };
  const auto scale_if = [&](std::optional<double>& number, int by) {
    if (number) scale(*number, by);
  };
  const auto scale_both = [&](Eigen::Vector2d& vector, int by) { scale(vector[0], by), scale(vector[1], by); };
  scale_both(scene.box.lower, a), scale_both(scene.box.upper, a);
  for (Species& species : scene.species) {
    scale(species.radius, a);
    for (double& radius : species.radii) scale(radius, a);
  }
  for_all_positions(scene, [&](Eigen::Vector2d& r) { scale_both(r, a); });
  for_all_velocities(scene, [&](Eigen::Vector2d& v) { scale_both(v, a - b); });
  Effects& effects = scene.effects;
  scale_if(effects.collision.elastic_below, b);
  if (effects.gravity) scale_both(effects.gravity->acceleration, a - 2 * b);
  for (WallProperties& wall : effects.walls) {
    scale_if(wall.temperature, 2 * (a - b));
    scale_if(wall.velocity, a - b);
    scale_if(wall.tangential_velocity, a - b);
    scale_if(wall.vibration, a - b);
    if (wall.oscillation) scale(wall.oscillation->amplitude, a), scale(wall.oscillation->frequency, -b);
    scale_if(wall.load, -2 * b);  // force per length
  }
  for_all_points(effects.obstacles, [&](Eigen::Vector2d& point) { scale_both(point, a); });
  for (Obstacle& obstacle : effects.obstacles)
    if (auto* disk = std::get_if<DiskObstacle>(&obstacle))
      scale(disk->radius, a);
    else if (auto* arc = std::get_if<ArcObstacle>(&obstacle))
      scale(arc->radius, a);
  if (effects.circle) scale_both(effects.circle->centre, a), scale(effects.circle->radius, a);
  if (effects.growth) scale(effects.growth->rate, -b);
  if (effects.thermostat) scale(effects.thermostat->temperature, 2 * (a - b)), scale(effects.thermostat->rate, -b);
  if (effects.tumbling) scale(effects.tumbling->rate, -b);
  if (effects.brownian) scale(effects.brownian->temperature, 2 * (a - b)), scale(effects.brownian->rate, -b);
  if (effects.shear) scale(effects.shear->rate, -b);
  if (effects.square_well) scale(effects.square_well->depth, 2 * (a - b));
  if (effects.stepped_potential)
    for (PotentialStep& step : effects.stepped_potential->steps) scale(step.energy, 2 * (a - b));
  scale_if(scene.run.time, b);
  return scene;
}

/// As many events as that, and where they have led.
State after(const Scene& scene, const std::string& engine) {
  const auto running = make_engine(engine, scene);
  running->run_until(forever, no_limit, events);
  return running->state();
}

RC_GTEST_PROP(PropertySymmetries, OtherUnitsOfLengthAndTimeChangeNoBit, ()) {
  const std::optional<Scene> scene = any_scene();
  RC_PRE(scene.has_value());
  const int a = *rc::gen::inRange(-30, 31), b = *rc::gen::inRange(-30, 31);
  for (const std::string& engine : engines_covering(*scene)) {
    if (engine == "textbook-float") continue;  // its exponents end near
    const State one = after(*scene, engine), other = after(in_other_units(*scene, a, b), engine);
    if (!in_range(one)) continue;
    State back = other;
    back.time = std::ldexp(other.time, -b);
    back.positions *= std::ldexp(1.0, -a);
    back.velocities *= std::ldexp(1.0, b - a);
    RC_LOG() << engine << ", lengths times 2^" << a << ", times times 2^" << b << "\n";
    RC_ASSERT(same_bits(one, back));
  }
}

}  // namespace
}  // namespace carom::test
