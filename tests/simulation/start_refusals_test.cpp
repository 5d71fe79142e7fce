// Starts and schedules that a program may put together and that no run could survive.

#include "support/systems.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace carom::test {
namespace {

TEST(StartRefusals, SpeedsWhoseSquaresOverflowOrVanish) {
  for (const double speed : {1e151, 1e-151}) {
    Scene scene = gas_scene(4, 0.1, Boundary::walls);
    scene.species.front().velocities = FixedSpeed{speed};
    EXPECT_THROW(make_simulation(scene), SceneError) << speed;
  }
}

TEST(StartRefusals, BoxesThatAreNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (const double upper : {0.0, -1.0, nan, infinity}) {
    for (const int axis : {0, 1}) {
      Scene scene = gas_scene(4, 0.1, Boundary::periodic);
      scene.box.upper[axis] = upper;
      EXPECT_THROW(make_simulation(scene), SceneError) << upper;
      scene.species.clear();
      EXPECT_THROW(make_simulation(scene), SceneError) << upper;
    }
  }
}

TEST(StartRefusals, SchedulesWithoutAnEndOrAStep) {
  Scene scene = gas_scene(4, 0.1, Boundary::walls);
  Simulation endless = make_simulation(scene);
  EXPECT_THROW(run_schedule(endless), SceneError);
  scene.run.time = 1.0;
  scene.run.sample_every = 0.0;
  Simulation stepless = make_simulation(scene);
  EXPECT_THROW(run_schedule(stepless), SceneError);
  scene.run.sample_every.reset();
  scene.run.equilibrate = Run::Equilibrate{};
  Simulation aimless = make_simulation(scene);
  EXPECT_THROW(run_schedule(aimless), SceneError);
}

TEST(JammedRun, TwoDisksThatFillTheWayFromWallToWallEndWithAWord) {
  Scene scene;
  scene.box = {{0.0, 0.0}, {2.0, 1.5}, {Boundary::walls, Boundary::walls}};
  Species row;
  row.name = "row";
  row.count = 2;
  row.radius = 0.5;
  row.mass = 1.0;
  row.positions = ListedPositions{{{0.5, 0.75}, {1.5, 0.75}}};
  row.velocities = ListedVelocities{{{1.0, 0.0}, {0.0, 0.0}}};
  scene.species = {row};
  scene.run.time = 1.0;
  Simulation simulation = make_simulation(scene);
  EXPECT_EQ(run_schedule(simulation).stopped, StopReason::jammed);
  EXPECT_EQ(simulation.time(), 0.0);
}

}  // namespace
}  // namespace carom::test
