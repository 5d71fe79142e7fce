// Inelastic collapse at one instant: speeds that fall to nothing, and gases that cool until nothing is left to compute with.

#include "core/all_events.hpp"
#include "observe/mechanics.hpp"
#include "support/effect_scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace carom::test {
namespace {

using V = Eigen::Vector2d;

constexpr const char* all_engines[] = {"general", "textbook", "textbook-float", "textbook-long-double", "textbook-quad"};
constexpr const char* engines_of_doubles[] = {"general", "textbook", "textbook-long-double", "textbook-quad"};

/// Disks of radius 1/2 in a row, each touching the next, that fly to the left at `speed`. The wall there is 1 away.
Scene row(int count, double restitution, double speed = 1.0) {
  std::vector<Placed> disks;
  for (int k = 0; k < count; ++k) disks.push_back({{1.5 + k, 8.0}, {-speed, 0.0}});
  Scene scene = scene_of_placed(box_of(64.0, 16.0, Boundary::walls), disks);
  scene.effects.collision.restitution = restitution;
  scene.run.time = 16.0 / speed;
  return scene;
}

/// Each disk that comes to the wall comes back against the others, and all collide without end until all are at rest: momentum
/// goes into the wall, and what is left of speeds after a round is a share of what it was before. Where places are rounded in
/// steps, gaps of a step may put an end to that, when speeds are so low that it makes no difference.
void expect_collapse(const Scene& scene, const std::string& engine, double when) {
  SCOPED_TRACE(engine);
  Simulation simulation = make_simulation(scene, engine);
  const double before = kinetic_energy(simulation.disks(), simulation.state());
  const RunResult result = run_schedule(simulation);
  EXPECT_TRUE(result.faults.empty());
  const State end = simulation.state();
  const double left = kinetic_energy(simulation.disks(), end) / before;
  const bool single = engine == "textbook-float";  // it rounds a place of 8 by 2^-21
  if (engine == "general") {
    EXPECT_LT(left, 1e-28);
    EXPECT_TRUE(result.stopped == StopReason::collapsed || result.stopped == StopReason::time) << to_string(result.stopped);
  } else {
    EXPECT_EQ(result.stopped, StopReason::collapsed);
    EXPECT_FALSE(result.stopped_disks.empty());
    EXPECT_NEAR(simulation.time() / when, 1.0, single ? 1e-6 : 1e-13);
  }
  EXPECT_TRUE(end.positions.allFinite());
  EXPECT_TRUE(end.velocities.allFinite());
  double taken = simulation.totals().dissipated;
  for (const double energy : simulation.totals().wall_energy) taken += energy;
  EXPECT_NEAR(left + taken / before, 1.0, single ? 1e-5 : 1e-12);
}

TEST(EnginesCollapse, OfARowAtAWallEndsTheRunInEveryEngine) {
  for (const char* engine : all_engines)
    for (const int count : {3, 5}) expect_collapse(row(count, 0.0), engine, 1.0);
}

TEST(EnginesCollapse, NamesTheDisksOfTheRow) {
  for (const char* engine : all_engines) {
    // The partner gives half of what it has left to the one at the wall, and the wall half of that: quarters of powers of two.
    Scene scene =
        scene_of_placed(box_of(16.0, 16.0, Boundary::walls),
                        {{{3.5, 8.0}, {-1.0, 0.0}, 0.75}, {{2.0, 8.0}, {-1.0, 0.0}, 0.75}, {{10.0, 10.0}, {0.0, 0.5}, 0.75}});
    scene.effects.collision.restitution = 0.0;
    scene.effects.walls[0].restitution = 0.5;
    scene.run.time = 8.0;
    Simulation simulation = make_simulation(scene, engine);
    const RunResult result = run_schedule(simulation);
    EXPECT_EQ(result.stopped, StopReason::collapsed) << engine;
    EXPECT_EQ(result.stopped_disks, std::vector<std::int32_t>({0, 1})) << engine;
    EXPECT_EQ(simulation.time(), 1.25) << engine;
    EXPECT_EQ(simulation.state().velocities.col(2), V(0.0, 0.5));
  }
}

TEST(EnginesCollapse, IsTheSameUnderReversal) {
  for (const char* engine : all_engines) {
    Scene scene = row(3, 0.0);
    scene.effects.collision.rule = CollisionRule::reversal;
    expect_collapse(scene, engine, 1.0);
  }
}

TEST(EnginesCollapse, ComesAtAnyScaleOfSpeed) {
  for (const char* engine : engines_of_doubles) {
    const double speed = 0x1p-465;  // 1e-140
    Scene scene = row(5, 0.0, speed);
    Simulation simulation = make_simulation(scene, engine);
    EXPECT_EQ(run_schedule(simulation).stopped, StopReason::collapsed) << engine;
    if (std::string(engine) != "general") {
      EXPECT_EQ(simulation.time(), 1.0 / speed);
    }
    EXPECT_TRUE(simulation.state().velocities.allFinite());
  }
}

TEST(EnginesCollapse, ComesAtObstaclesToo) {
  for (const Obstacle& obstacle : {Obstacle(DiskObstacle{{0.5, 8.0}, 0.5}), Obstacle(SegmentObstacle{{1.0, 4.0}, {1.0, 12.0}})})
    for (const char* engine : all_engines) {
      Scene scene = row(3, 0.0);
      for (V& place : std::get<ListedPositions>(scene.species.front().positions).values) place.x() += 1.0;
      scene.effects.obstacles = {obstacle};
      expect_collapse(scene, engine, 1.0);
    }
}

TEST(EnginesCollapse, ComesWhereTheWallAloneTakesEnergy) {
  // Elastic disks of masses 1 and 3, and a wall that takes: the heavy one comes at the light one again and again.
  for (const char* engine : all_engines) {
    Scene scene = row(2, 1.0);
    scene.species.front().masses = {1.0, 1e6};
    scene.effects.walls[0].restitution = 0.0;
    Simulation simulation = make_simulation(scene, engine);
    const RunResult result = run_schedule(simulation);
    EXPECT_EQ(result.stopped, StopReason::collapsed) << engine;
    EXPECT_TRUE(simulation.state().velocities.allFinite());
  }
}

/// A light disk between a wall and a heavy one that comes nearer: its flights become as short as the rounding of places.
TEST(EnginesCollapse, OfALightDiskBetweenAWallAndAHeavyOneComesAtOneTime) {
  for (const double mass : {1e6, 1e10, 1e16}) {
    Scene scene = scene_of_placed(box_of(6.0, 6.0, Boundary::walls), {{{1.5, 3.0}, {1.0, 0.1}}, {{4.0, 3.2}, {-1.0, 0.3}}});
    scene.species.front().masses = {1.0, mass};
    scene.effects.collision = {.rule = CollisionRule::reversal, .restitution = 0.5};
    scene.run.time = 20.0;
    Simulation simulation = make_simulation(scene, "general"), twin = make_simulation(scene, "textbook");
    EXPECT_EQ(run_schedule(simulation).stopped, StopReason::collapsed) << mass;
    EXPECT_EQ(run_schedule(twin).stopped, StopReason::collapsed) << mass;
    EXPECT_NEAR(simulation.time(), twin.time(), 4e-10);  // 100,000 events, each within 2^-50 of an epoch of 4
    EXPECT_LT(simulation.totals().pair, 101'000U);
  }
}

/// Beside a wall that moves, coordinates are rounded to one step or the next, and a disk at rest falls that far again and again.
TEST(EnginesCollapse, OfADiskAtRestOnAWallThatMovesEndsTheRunThere) {
  const auto disk_above = [](double x, double restitution) {
    Scene scene = scene_of_placed(box_of(4.0, 4.0, Boundary::walls), {{{x, 2.1}, {0.1, 0.05}}});
    scene.effects.gravity = Gravity{{-0.3, 0.0}};
    scene.effects.walls[0].restitution = restitution;
    scene.run.time = 40.0;
    return scene;
  };
  std::vector<Scene> scenes;
  for (int k = 0; k < 6; ++k) {
    Scene& saw = scenes.emplace_back(disk_above(1.5 + 0.037 * k, 0.5));
    saw.effects.walls[0].oscillation = Oscillation{WaveForm::sawtooth, 0.0017, 0.53, 0.0};
    Scene& sine = scenes.emplace_back(disk_above(1.5 + 0.037 * k, 0.5));
    sine.effects.walls[0].oscillation = Oscillation{WaveForm::sine, 0.0017, 0.53, 0.0};
    Scene& rising = scenes.emplace_back(disk_above(1.87 + 0.037 * k, 0.5));
    rising.effects.walls[0].velocity = 0.01;
    Scene& growing = scenes.emplace_back(disk_above(1.5 + 0.01 * k, 0.5));
    growing.effects.growth = Growth{.rate = 0.0079};
  }
  for (const Scene& scene : scenes) {
    double ends[2];
    for (const int k : {0, 1}) {
      Simulation simulation = make_simulation(scene, k == 0 ? "general" : "textbook");
      EXPECT_EQ(run_schedule(simulation).stopped, StopReason::collapsed);
      EXPECT_LT(simulation.totals().wall, 101'000U);
      ends[k] = simulation.time();
    }
    EXPECT_NEAR(ends[0], ends[1], 1e-3);  // hops end in one where rounding has it, each shorter than the last
  }
}

/// It leaves the wall with the speed at which its surface grows, and must not meet it again for an ulp.
TEST(EnginesCollapse, IsNotWhereADiskGrowsAtAWallThatTakesAllOfItsSpeed) {
  for (int k = 0; k < 100; ++k) {
    Scene scene = scene_of_placed(box_of(10.0, 10.0, Boundary::walls), {{{2.0 + 0.06 * k, 5.0}, {1.0, 0.1}}});
    scene.effects.walls[1].restitution = 0.0;
    scene.effects.growth = Growth{.rate = 0.0043};
    scene.run.time = 20.0;
    Simulation simulation = make_simulation(scene, "general"), twin = make_simulation(scene, "textbook");
    EXPECT_EQ(run_schedule(simulation).stopped, StopReason::time) << k;
    EXPECT_EQ(run_schedule(twin).stopped, StopReason::time) << k;
    EXPECT_LE(simulation.totals().wall, twin.totals().wall) << k;
  }
}

TEST(EnginesCollapse, IsNotWhatALightDiskDoesToHeavyOnes) {
  // A disk of 1e-300 of the mass gives its neighbours 1e-300 of its speed: that is slow, and no collapse.
  for (const char* engine : engines_with_effects) {
    const Scene scene = [] {
      Scene heavy = scene_of_placed(
          box_of(64.0, 16.0, Boundary::walls),
          {{{3.0, 8.0}, {0.0, 0.0}, 0.5, 1.0}, {{4.0, 8.0}, {0.0, 0.0}, 0.5, 1.0}, {{6.0, 8.0}, {-1.0, 0.0}, 0.5, 1e-300}});
      heavy.effects.collision.restitution = 0.5;
      heavy.run.time = 8.0;
      return heavy;
    }();
    Simulation simulation = make_simulation(scene, engine);
    EXPECT_EQ(run_schedule(simulation).stopped, StopReason::time) << engine;
    const State end = simulation.state();
    // -(1 + e) 1e-300 goes through the row: a quarter stays with the one that was hit.
    EXPECT_NEAR(end.velocities(0, 2), 0.5, 1e-15);
    EXPECT_NEAR(end.velocities(0, 1) / -0.375e-300, 1.0, 1e-14);
    EXPECT_NEAR(end.velocities(0, 0) / -1.125e-300, 1.0, 1e-14);
  }
}

TEST(EnginesCollapse, IsNotWhereDisksStickTogetherAtRest) {
  // Two disks: the second collision already leaves both at rest, to the last bit.
  for (const char* engine : all_engines) {
    Simulation simulation = make_simulation(row(2, 0.0), engine);
    EXPECT_EQ(run_schedule(simulation).stopped, StopReason::time) << engine;
    EXPECT_EQ(simulation.state().velocities.cwiseAbs().maxCoeff(), 0.0);
  }
}

TEST(EnginesCollapse, IsPutOffByTheTcModel) {
  for (const char* engine : all_engines) {
    Scene scene = row(5, 0.0);
    scene.effects.collision.elastic_below = 1e-3;
    Simulation simulation = make_simulation(scene, engine);
    EXPECT_EQ(run_schedule(simulation).stopped, StopReason::time) << engine;
  }
}

// ------------------------------------------------------------------------------------------------------- cooling

Scene cooling_gas(int count, double restitution) {
  Scene scene = gas_scene(count, 0.1, Boundary::periodic);
  scene.effects.collision.restitution = restitution;
  scene.run.time.reset();
  scene.run.collisions = 100'000'000;
  return scene;
}

/// Mean of |v_x| + |v_y|.
double mean_speed(const State& state) { return state.velocities.cwiseAbs().sum() / static_cast<double>(state.velocities.cols()); }

TEST(Cooling, OfAGasAtRestAsAWholeGoesOnUntilSquaresVanish) {
  for (const char* engine : all_engines) {
    SCOPED_TRACE(engine);
    Simulation simulation = make_simulation(cooling_gas(16, 0.5), engine);
    const RunResult result = run_schedule(simulation);
    EXPECT_EQ(result.stopped, StopReason::cooled);
    const State end = simulation.state();
    const bool single = std::string(engine) == "textbook-float";
    // The bound is crossed between two epochs.
    EXPECT_LT(mean_speed(end), single ? 1e-14 : 1e-149);
    EXPECT_GT(mean_speed(end), single ? 1e-20 : 1e-160);
    // At the last epoch's beginning the common motion was below 2^13 roundings of the speeds, which have fallen since.
    const double common = end.velocities.rowwise().mean().cwiseAbs().maxCoeff();
    EXPECT_LT(common, (single ? 0x1p-7 : 0x1p-36) * mean_speed(end));
    EXPECT_NEAR(simulation.totals().dissipated / 15.0, 1.0, single ? 1e-5 : 1e-12) << "(N - 1) kT";
  }
}

TEST(Cooling, OfAGasThatMovesAsAWholeEndsWhereItWaitsForCollisions) {
  for (const char* engine : engines_with_effects) {
    SCOPED_TRACE(engine);
    Scene scene = cooling_gas(4, 0.5);
    State start = draw_start(scene).state;
    start.velocities.colwise() += V(0.5, -0.25);
    Simulation simulation = make_simulation(scene, start, engine);
    EXPECT_EQ(run_schedule(simulation).stopped, StopReason::cooled);
    const Eigen::Vector2d common = simulation.state().velocities.rowwise().mean();
    EXPECT_NEAR(common.x(), 0.5, 1e-13);
    EXPECT_NEAR(common.y(), -0.25, 1e-13);
    State end = simulation.state();
    end.velocities.colwise() -= common;
    EXPECT_LT(mean_speed(end), 0x1p-14);
    EXPECT_GT(mean_speed(end), 0x1p-24) << "it is told in time";
  }
}

/// Disks that stick together wait for a collision that never comes.
TEST(Cooling, OfDisksThatNeverMeetAgainEndsAtOnce) {
  for (const char* engine : engines_with_effects) {
    SCOPED_TRACE(engine);
    Scene scene = scene_of_placed(box_of(8.0, 8.0, Boundary::periodic), {{{2.0, 4.0}, {1.0, 0.25}}, {{6.0, 4.0}, {0.0, 0.25}}});
    scene.effects.collision.restitution = 0.0;
    scene.run.time.reset();
    scene.run.collisions = 1000;
    Simulation simulation = make_simulation(scene, engine);
    EXPECT_EQ(run_schedule(simulation).stopped, StopReason::cooled);
    EXPECT_LE(detail::all_events(simulation.counts()), 2'000'000U);
  }
}

TEST(Cooling, EndsAtTheSameEventOnSeveralCoresAndHoweverItIsSampled) {
  Scene scene = cooling_gas(50, 0.5);
  State start = draw_start(scene).state;
  start.velocities.colwise() += V(0x1p14, -0x1p13);
  const auto end = [&](const Threads& threads, const RunHooks& hooks) {
    Simulation simulation = make_simulation(scene, start);
    simulation.set_threads(threads);
    EXPECT_EQ(run_schedule(simulation, hooks).stopped, StopReason::cooled);
    return std::tuple(simulation.counts().pair, simulation.time(), state_hash(simulation.state()));
  };
  RunHooks verifies;
  verifies.verify_every = 1000;
  const auto alone = end({}, {});
  EXPECT_EQ(end({.domains = 2}, {}), alone);
  EXPECT_EQ(end({}, verifies), alone);
  scene.run.sample_every_collisions = 7;
  EXPECT_EQ(end({}, {}), alone);
  scene.run.sample_every_collisions = 1;
  EXPECT_EQ(end({.domains = 3}, {}), alone);
}

/// Disks that keep their distances are found by their time of flight.
TEST(Cooling, OfDisksWithOneVelocityEndsAtTheSameTimeHoweverItIsRun) {
  Scene scene = cooling_gas(400, 0.5);
  State start = draw_start(scene).state;
  start.velocities.colwise() = V(0.5, 0.25);
  const auto end = [&](const Threads& threads) {
    Simulation simulation = make_simulation(scene, start);
    simulation.set_threads(threads);
    EXPECT_EQ(run_schedule(simulation).stopped, StopReason::cooled);
    EXPECT_EQ(simulation.counts().pair, 0U);
    return std::pair(simulation.time(), state_hash(simulation.state()));
  };
  const auto alone = end({});
  EXPECT_EQ(end({.domains = 2}), alone);
  scene.run.sample_every = 3.0;
  EXPECT_EQ(end({}), alone);
  EXPECT_EQ(end({.domains = 3}), alone);
}

TEST(Cooling, LeavesARunItsTimeHoweverDisksMoveTogether) {
  // At e = 0 the two go on side by side, for as long as was asked.
  for (const char* engine : engines_with_effects) {
    Scene scene = scene_of_placed(box_of(8.0, 8.0, Boundary::periodic), {{{2.0, 4.0}, {1.0, 0.25}}, {{6.0, 4.0}, {0.0, 0.25}}});
    scene.effects.collision.restitution = 0.0;
    scene.run.time = 4e5;  // past a million events
    Simulation simulation = make_simulation(scene, engine);
    EXPECT_EQ(run_schedule(simulation).stopped, StopReason::time) << engine;
    EXPECT_EQ(simulation.state().velocities.col(0), V(0.5, 0.25));
    EXPECT_EQ(simulation.state().velocities.col(1), V(0.5, 0.25));
  }
}

TEST(Cooling, LeavesARunItsTimeHoweverOftenDisksMeet) {
  Scene scene = cooling_gas(16, 0.9);
  scene.run.collisions.reset();
  scene.run.time = 20.0;
  Simulation simulation = make_simulation(scene);
  EXPECT_EQ(run_schedule(simulation).stopped, StopReason::time);
  EXPECT_GT(simulation.counts().pair, 64U);
}

TEST(Cooling, HappensBesideGravityThatDoesNotPull) {
  for (const char* engine : engines_with_effects) {
    Scene scene = cooling_gas(4, 0.5);
    scene.effects.gravity = Gravity{};
    Simulation simulation = make_simulation(scene, engine);
    EXPECT_EQ(run_schedule(simulation).stopped, StopReason::cooled) << engine;
  }
}

TEST(Cooling, OfGrowingDisksLeavesTheEnergyInTheirMotionAgainstEachOther) {
  // Rescaling gives them back what collisions take, and would give as much to what rounding leaves of their common motion: by a
  // factor for each collision of theirs, until nothing else is left.
  for (const char* engine : engines_with_effects) {
    Scene scene = gas_scene(16, 0.1, Boundary::periodic);
    scene.effects.collision.restitution = 0.5;
    scene.effects.growth = Growth{.rate = 1e-5};
    Simulation simulation = make_simulation(scene, engine);
    ASSERT_EQ(simulation.run_until(1e4, {.collisions = 4000}), StopReason::collisions);
    const State end = simulation.state();
    EXPECT_LT(end.velocities.rowwise().mean().cwiseAbs().maxCoeff(), 0x1p-36 * mean_speed(end)) << engine;
  }
}

TEST(InelasticRun, ThatComesToAStandIsCollapsed) {
  // Two disks that fill the way from wall to wall: elastic ones are jammed (StartRefusals), these lose a little each time.
  Scene scene = scene_of(box_of(2.0, 1.5, Boundary::walls), {species_of(2, 0.5, 1.0, ListedPositions{{{0.5, 0.75}, {1.5, 0.75}}},
                                                                        ListedVelocities{{{1.0, 0.0}, {0.0, 0.0}}})});
  scene.effects.collision.restitution = 0.9999;
  Simulation simulation = make_simulation(scene);
  EXPECT_EQ(simulation.run_until(1.0), StopReason::collapsed);
  EXPECT_EQ(simulation.time(), 0.0);
}

}  // namespace
}  // namespace carom::test
