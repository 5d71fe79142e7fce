// Scenes with effects on several cores: each has the bits of the run on one.

#include "support/several_cores.hpp"

#include <carom/simulation.hpp>

#include <gtest/gtest.h>

#include <string>

namespace carom::test {
namespace {

TEST(Threads, GiveTheBitsOfOneUnderGravity) {
  for (const Boundary across : {Boundary::walls, Boundary::periodic}) {
    Scene scene = plain_gas(4000, 0.4, Boundary::walls);
    scene.box.boundary[0] = across;
    scene.effects.gravity = Gravity{{0.0, -0.2}};
    expect_same_runs(scene, {.threads = 2, .domains = 4}, 20.0, 4);
  }
}

TEST(Threads, GiveTheBitsOfOneWhereCollisionsLoseEnergy) {
  Scene scene = plain_gas(4000, 0.4, Boundary::periodic);
  scene.effects.collision.restitution = 0.9;
  expect_same_runs(scene, {.domains = 4}, 20.0, 4);
  scene.effects.collision.elastic_below = 1e-3;
  expect_same_runs(scene, {.domains = 3}, 20.0, 4);
  scene.box.boundary = {Boundary::walls, Boundary::walls};
  scene.effects.walls[2].restitution = 0.7;
  scene.effects.gravity = Gravity{{0.0, -0.1}};
  expect_same_runs(scene, {.domains = 4}, 20.0, 4);
}

/// A disk that a wall leaves no speed, and that weight presses against it, hits it again and again at one instant: far more often
/// in a window than a domain lets happen, and less often than time is taken to stand still after.
TEST(Threads, CollapseWhereOneDoes) {
  Scene scene = plain_gas(40, 0.2, Boundary::walls);
  scene.effects.walls[1].restitution = 0.0;
  scene.effects.gravity = Gravity{{0.5, 0.0}};
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads({.threads = 2, .domains = 2});
  EXPECT_EQ(alone.run_until(20.0), StopReason::collapsed);
  EXPECT_EQ(shared.run_until(20.0), StopReason::collapsed);
  expect_same(alone, shared, "collapsed");
  EXPECT_GT(shared.thread_counts().windows_redone, 0U);
}

TEST(Threads, GiveTheBitsOfOneForRoughDisks) {
  Scene scene = plain_gas(4000, 0.4, Boundary::periodic);
  scene.effects.collision.restitution = 0.95;
  scene.effects.collision.roughness = 0.3;
  expect_same_runs(scene, {.domains = 4}, 10.0, 4);
}

TEST(Threads, GiveTheBitsOfOneForDisksWithWells) {
  Scene scene = plain_gas(4000, 0.3, Boundary::periodic);
  scene.effects.square_well = SquareWell{.width = 1.6, .depth = 0.8};
  expect_same_runs(scene, {.threads = 2, .domains = 4}, 10.0, 4);
  scene.effects.square_well = SquareWell{.width = 1.9, .depth = -0.3};
  expect_same_runs(scene, {.domains = 3}, 6.0, 2);
}

TEST(Threads, GiveTheBitsOfOneForDisksWithSteppedPotentials) {
  Scene scene = plain_gas(4000, 0.3, Boundary::periodic);
  scene.effects.stepped_potential = SteppedPotential{{{1.1, 0.5}, {1.3, -0.4}, {1.6, 0.2}, {1.9, -0.1}}};
  expect_same_runs(scene, {.threads = 2, .domains = 4}, 6.0, 4);
  expect_same_runs(scene, {.threads = 3, .domains = 3}, 6.0, 2);
}

TEST(Threads, ArePutAsideWhereADiskMayHaveMorePartnersThanAMessageHolds) {
  Scene scene = mixture_scene(64, 0.3, Boundary::periodic);
  scene.effects.square_well = SquareWell{1.5, 0.5};
  for (Species& species : scene.species) species.radius = 0.5;
  EXPECT_EQ(make_simulation(scene).why_not_threads(), "");
  scene.species[0].radius = 0.1;
  EXPECT_EQ(make_simulation(scene).why_not_threads(),
            "sizes differ so much that a disk may have too many others within reach of the potential");
  scene.effects.square_well.reset();
  EXPECT_EQ(make_simulation(scene).why_not_threads(), "");
}

TEST(Threads, GiveTheBitsOfOneBetweenWallsThatVibrate) {
  Scene scene = plain_gas(3000, 0.4, Boundary::walls);
  scene.effects.collision.restitution = 0.9;
  scene.effects.collision.elastic_below = 1e-3;
  scene.effects.gravity = Gravity{{0.0, -0.5}};
  for (const WaveForm form : {WaveForm::sine, WaveForm::sawtooth}) {
    scene.effects.walls[2] = {.restitution = 0.95, .oscillation = Oscillation{form, 0.4, 1.5}};
    expect_same_runs(scene, {.threads = 2, .domains = 4}, 10.0, 4);
    scene.effects.walls[0] = {.oscillation = Oscillation{form, 2.0, 0.3, 0.6}};
    expect_same_runs(scene, {.domains = 3}, 10.0, 3);
  }
  scene.effects.walls[1] = scene.effects.walls[2] = {.vibration = 0.8};
  expect_same_runs(scene, {.domains = 8}, 10.0, 3);
}

/// Walls that go far beyond the box, where coordinates become coarser, and one that presses the gas together.
TEST(Threads, GiveTheBitsOfOneBetweenWallsThatMove) {
  Scene scene = plain_gas(3000, 0.4, Boundary::walls);
  scene.effects.walls[1].velocity = 3.0;
  scene.effects.walls[2].velocity = -1.0;
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads({.threads = 2, .domains = 4});
  for (const double time : {5.0, 40.0, 200.0}) {
    alone.run_until(time);
    shared.run_until(time);
    expect_same(alone, shared, "time " + std::to_string(time));
    EXPECT_EQ(shared.state().walls.at(1).position, alone.state().walls.at(1).position);
  }
  EXPECT_GT(shared.state().walls.at(1).position, 8.0 * scene.box.upper[0]);
  EXPECT_GT(shared.thread_counts().windows, 10U);
  scene.effects.walls[1].velocity = -0.5;
  scene.effects.walls[2].velocity = 0.0;
  expect_same_runs(scene, {.domains = 3}, 30.0, 3);
}

/// Velocities are scaled each time that a disk has collided once on average, and lists are made for larger disks now and then.
TEST(Threads, GiveTheBitsOfOneWhereDisksGrow) {
  Scene scene = plain_gas(4000, 0.3, Boundary::periodic);
  for (const double rate : {0.003, 0.05}) {
    scene.effects.growth = Growth{.rate = rate};
    expect_same_runs(scene, {.threads = 2, .domains = 4}, 8.0, 4);
  }
  scene.effects.collision.restitution = 0.95;
  scene.effects.collision.roughness = 0.3;
  expect_same_runs(scene, {.domains = 3}, 8.0, 3);
  scene = plain_gas(3000, 0.3, Boundary::walls);
  scene.effects.gravity = Gravity{{0.0, -0.1}};
  scene.effects.growth = Growth{.rate = 0.02};
  expect_same_runs(scene, {.domains = 4}, 8.0, 3);
  scene = mixture(2000);
  scene.effects.growth = Growth{.rate = 0.02};
  expect_same_runs(scene, {.domains = 4}, 8.0, 3);
}

TEST(Threads, StopWhereDisksHaveGrownAsMuchAsOnOne) {
  Scene scene = plain_gas(4000, 0.3, Boundary::periodic);
  for (const Growth& growth : {Growth{.rate = 0.1, .packing_fraction = 0.6}, Growth{.rate = 0.02, .reduced_pressure = 4.0}}) {
    scene.effects.growth = growth;
    Simulation alone = make_simulation(scene), shared = make_simulation(scene);
    shared.set_threads({.domains = 4});
    EXPECT_EQ(alone.run_until(1000.0), StopReason::grown);
    EXPECT_EQ(shared.run_until(1000.0), StopReason::grown);
    expect_same(alone, shared, "grown");
    EXPECT_GT(shared.thread_counts().windows, 10U);
  }
}

TEST(Threads, GiveTheBitsOfOneBetweenObstacles) {
  Scene scene = plain_gas(3000, 0.3, Boundary::walls);
  const double x = scene.box.upper[0] / 2.0, y = scene.box.upper[1] / 2.0;
  scene.species[0].positions = RandomPositions{};
  scene.effects.obstacles = {DiskObstacle{{x, y}, 5.0}, SegmentObstacle{{x / 3.0, y / 4.0}, {x / 3.0, y}}};
  expect_same_runs(scene, {.domains = 4}, 10.0, 4);
}

TEST(Threads, GiveTheBitsOfOneInACircle) {
  Scene scene = plain_gas(3000, 0.3, Boundary::walls);
  scene.species[0].positions = RandomPositions{};
  const Eigen::Vector2d middle = 0.5 * (scene.box.lower + scene.box.upper);
  put_in_circle(scene.box, scene.effects, {middle, 0.57 * scene.box.lengths().x()});
  scene.effects.obstacles = {ArcObstacle{middle, 0.25 * scene.box.lengths().x(), 10.0, 300.0}};
  expect_same_runs(scene, {.domains = 4}, 10.0, 4);
}

/// Between slow disks two others leave a shoulder, on which they began, 44 times as fast. The light one of them flies across half
/// a halo within a window, hits what is at home there, and is gone again when copies are compared.
TEST(Threads, FindWhatShouldersHaveMadeFast) {
  Scene scene = plain_gas(2, 0.1, Boundary::walls);
  scene.box = {{0.0, 0.0}, {400.0, 10.0}, {Boundary::walls, Boundary::walls}};
  Species& disks = scene.species[0];
  ListedPositions places;
  ListedVelocities velocities;
  disks.count = 0;
  const auto put = [&](double x, double y, const Eigen::Vector2d& v, double mass) {
    places.values.emplace_back(x, y), velocities.values.push_back(v), disks.masses.push_back(mass), ++disks.count;
  };
  for (double x = 1.5; x < 399.0; x += 3.0) put(x, 1.5, {0.02, 0.02}, 1.0), put(x, 8.5, {0.02, -0.02}, 1.0);
  put(187.0, 5.0, {0.02, 0.0}, 1.0), put(185.51, 5.0, {-0.02, 0.0}, 1000.0), put(206.0, 5.0, {0.0, 0.0}, 1000.0);
  disks.positions = places;
  disks.velocities = velocities;
  scene.effects.square_well = SquareWell{.width = 1.5, .depth = -0.4};
  for (const std::size_t domains : {2U, 3U, 4U}) {
    Simulation alone = make_simulation(scene), shared = make_simulation(scene);
    shared.set_threads({.domains = domains});
    alone.run_until(33.0);
    shared.run_until(33.0);
    expect_same(alone, shared, std::to_string(domains) + " domains");
  }
}

}  // namespace
}  // namespace carom::test
