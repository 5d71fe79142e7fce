// Obstacles, arcs and circular boxes in fixed steps: against flat walls where these are met head-on, against exact events, and
// the rules of the simple methods in closed form.

#include "observe/mechanics.hpp"
#include "support/effect_scenes.hpp"
#include "support/exact_run.hpp"
#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace carom::test {
namespace {

Simulation steps_from(const Scene& scene, const std::vector<Placed>& disks, const FixedStep& step) {
  Simulation simulation = make_simulation(scene, system_of(scene.box, disks).state, step);
  simulation.record_events(true);
  return simulation;
}

/// A disk of radius 1/2 flies along x, from 2 towards what is at 4.
const std::vector<Placed> flying = {{{2.0, 4.0}, {1.0, 0.0}, 0.5, 2.0}};

Scene one_disk(const Box& box) { return scene_of(box, {species_of(1, 0.5, 2.0, RandomPositions{}, AtRest{})}); }

/// Walls at 0 and 4; the second is what stands there in the other scenes.
Scene between_walls() { return one_disk({{0.0, 0.0}, {4.0, 8.0}, {Boundary::walls, Boundary::walls}}); }

/// The room up to x = 12 with one obstacle, whose surface is met at x = 4.
Scene room_with(const Obstacle& obstacle) {
  Scene scene = one_disk({{0.0, 0.0}, {12.0, 8.0}, {Boundary::walls, Boundary::walls}});
  scene.effects.obstacles = {obstacle};
  return scene;
}

/// A circle from x = 0 to 4 round the line of flight.
Scene in_a_circle() {
  Scene scene = one_disk({});
  put_in_circle(scene.box, scene.effects, {{2.0, 4.0}, 2.0});
  return scene;
}

TEST(StepShapes, WhatIsMetHeadOnIsMetAsAWall) {
  const std::vector<Scene> scenes = {room_with(DiskObstacle{{6.0, 4.0}, 2.0}), room_with(SegmentObstacle{{4.0, 1.0}, {4.0, 7.0}}),
                                     room_with(ArcObstacle{{6.0, 4.0}, 2.0, 100.0, 260.0}),
                                     room_with(ArcObstacle{{1.5, 4.0}, 2.5, -45.0, 45.0}), in_a_circle()};
  for (const std::string& method : fixed_step_names())
    for (double dt : {0.0625, 0.21}) {
      if (method == "soft") dt /= 64.0;  // its springs are the softer the longer a step is
      Simulation wall = steps_from(between_walls(), flying, {method, dt});
      for (std::size_t k = 0; k < scenes.size(); ++k) {
        const bool is_rim = k + 1 == scenes.size();
        if (method == "naive" && !is_rim) continue;  // its walls are met by the centre, and obstacles by the edge
        SCOPED_TRACE(fmt::format("{} {} shape {}", method, dt, k));
        Simulation shape = steps_from(scenes[k], flying, {method, dt});
        Simulation twin = steps_from(between_walls(), flying, {method, dt});
        for (const double time : {1.45, 1.7, 1.9, 2.5, 3.0}) {
          shape.run_until(time);
          twin.run_until(time);
          EXPECT_NEAR(shape.state().positions(0, 0), twin.state().positions(0, 0), 1e-13) << time;
          EXPECT_NEAR(shape.state().positions(1, 0), 4.0, 1e-13) << time;
          EXPECT_NEAR(shape.state().velocities(0, 0), twin.state().velocities(0, 0), 1e-13) << time;
        }
        EXPECT_EQ(shape.counts().obstacle, twin.counts().wall);
        EXPECT_EQ(shape.counts().wall, 0U);
        EXPECT_NEAR(shape.totals().obstacle_impulse.x(), is_rim ? 0.0 : twin.totals().wall_impulse[1], 1e-12);
        EXPECT_NEAR(shape.totals().circle_impulse, is_rim ? twin.totals().wall_impulse[1] : 0.0, 1e-12);
        for (const Event& event : shape.take_events()) EXPECT_EQ(event.partner, first_obstacle);
      }
    }
}

/// The rule to the letter, in a loop: what is beyond is reversed whatever way it goes.
TEST(StepShapes, NaiveStepsReverseWhatIsBeyondTheRimWhereverItGoes) {
  const std::vector<Placed> slanting = {{{2.0, 4.0}, {0.3, 1.0}, 0.5, 2.0}};
  constexpr double dt = 0.375;
  for (const char* method : {"naive", "naive-edge"}) {
    Simulation s = steps_from(in_a_circle(), slanting, {method, dt});
    Eigen::Vector2d r(2.0, 4.0), v(0.3, 1.0);
    const double limit = method == std::string("naive") ? 2.0 : 1.5;
    std::uint64_t reversed = 0;
    for (int step = 0; step < 60; ++step) {
      s.run_until(step * dt);
      EXPECT_LT((s.state().positions.col(0) - r).norm(), 1e-11) << method << ' ' << step;
      const Eigen::Vector2d outward = (r - Eigen::Vector2d(2.0, 4.0)).normalized();
      if ((r - Eigen::Vector2d(2.0, 4.0)).norm() > limit) {
        ++reversed;
        v -= 2.0 * outward.dot(v) * outward;
      }
      EXPECT_EQ(s.counts().obstacle, reversed) << method << ' ' << step;
      r += dt * v;
    }
    EXPECT_GT(reversed, 3U);
  }
}

/// Twelve disks among a fixed disk, a segment and an arc, in a circle or in a box of walls or edges.
Scene among_shapes(int kind, std::uint64_t seed) {
  Scene scene = mixture_scene(12, 0.12, kind == 1 ? Boundary::walls : Boundary::periodic, seed);
  const Eigen::Vector2d middle = 0.5 * (scene.box.lower + scene.box.upper);
  const double half = 0.5 * scene.box.lengths().minCoeff();
  scene.effects.obstacles = {
      DiskObstacle{middle - Eigen::Vector2d(half / 3.0, 0.0), half / 8.0}, ArcObstacle{middle, half / 1.5, 20.0, 130.0},
      SegmentObstacle{middle + Eigen::Vector2d(0.1, -half / 2.0), middle + Eigen::Vector2d(half / 2.0, -half / 2.5)}};
  if (kind == 0) put_in_circle(scene.box, scene.effects, {middle, half});
  for (Species& species : scene.species) species.positions = RandomPositions{};
  if (kind != 2) scene.effects.gravity = Gravity{{0.25, -1.0}};
  return scene;
}

TEST(StepShapes, BacktrackAndSweptHaveTheEventsOfTheExactEngine) {
  int backtracks = 0;
  std::uint64_t at_shapes = 0;
  for (const int kind : {0, 1, 2})
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const Scene scene = among_shapes(kind, seed);
      const State start = make_simulation(scene).state();
      constexpr double end = 1.5;
      const ExactRun exact = exact_run(scene, start, end);
      ASSERT_GT(exact.events.size(), 5U);
      at_shapes += exact.totals.obstacle;
      const auto hold = [&](const FixedStep& step) {
        const std::string what = fmt::format("{}, box {}, seed {}, dt = {}", step.method, kind, seed, step.dt);
        Simulation s = make_simulation(scene, start, step);
        s.record_events(true);
        s.run_until(end);
        expect_the_events_of(exact, s, 1e-7, what);
        EXPECT_LT(rms_difference(scene, s.state(), exact.end), 1e-7) << what;
        EXPECT_EQ(s.counts().obstacle, exact.totals.obstacle) << what;
        EXPECT_NEAR(s.totals().circle_impulse, exact.totals.circle_impulse, 1e-6) << what;
        EXPECT_LT((s.totals().obstacle_impulse - exact.totals.obstacle_impulse).norm(), 1e-6) << what;
      };
      for (const double dt : {0.01, 0.1, 0.5, 1.5}) hold({"swept", dt});
      if (const std::optional<double> dt = backtrack_step(exact, end)) ++backtracks, hold({"backtrack", *dt});
    }
  EXPECT_GE(backtracks, 6);
  EXPECT_GT(at_shapes, 30U);
}

TEST(StepShapes, GridStepsAreGuardedStepsToTheLastBit) {
  for (const int kind : {0, 1, 2}) {
    const Scene scene = among_shapes(kind, 7);
    const State start = make_simulation(scene).state();
    Simulation guarded = make_simulation(scene, start, FixedStep{"guarded", 0.003});
    Simulation grid = make_simulation(scene, start, FixedStep{"grid", 0.003});
    guarded.run_until(6.0);
    grid.run_until(6.0);
    EXPECT_EQ(guarded.state().positions, grid.state().positions) << kind;
    EXPECT_GT(guarded.counts().obstacle, 5U) << kind;
  }
}

TEST(StepShapes, DisksStayInACircleAndKeepTheirEnergy) {
  for (const std::string& method : fixed_step_names()) {
    if (method == "naive" || method == "naive-edge") continue;
    Scene scene = among_shapes(0, 3);
    scene.effects.gravity.reset();
    const FixedStep step{method, method == "soft" ? 1e-3 : 2e-3};
    Simulation s = make_simulation(scene, step);
    const double energy = kinetic_energy(s.disks(), s.state());
    s.run_until(5.0);
    const State state = s.state();
    // Springs change it by a random share of 6e-4 in a contact, and hold some of it while it lasts (soft.hpp).
    EXPECT_NEAR(kinetic_energy(s.disks(), state) / energy, 1.0, method == "soft" ? 0.1 : 1e-10) << method;
    for (Eigen::Index i = 0; i < 12; ++i)
      EXPECT_LT((state.positions.col(i) - scene.effects.circle->centre).norm(), scene.effects.circle->radius) << method;
  }
}

}  // namespace
}  // namespace carom::test
