// Simulations that begin with a state given in place of the scene's own start.

#include "support/effect_scenes.hpp"
#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace carom::test {
namespace {

TEST(GivenState, TheScenesOwnStartGivenBackLeavesTheSameBits) {
  const Scene scene = mixture_scene(20, 0.4, Boundary::periodic);
  for (const char* engine : {"fast", "textbook"}) {
    Simulation drawn = make_simulation(scene, engine);
    Simulation given = make_simulation(scene, drawn.state(), engine);
    EXPECT_EQ(given.engine(), engine);
    drawn.run_until(3.0);
    given.run_until(3.0);
    EXPECT_TRUE(same_bits(drawn.state(), given.state())) << engine;
  }
}

TEST(GivenState, ItsTimeIsZeroAndItsImagesGoOn) {
  const Scene scene = gas_scene(9, 0.2, Boundary::periodic);
  Simulation first = make_simulation(scene);
  first.run_until(20.0);
  const State middle = first.state();
  ASSERT_FALSE((middle.images.array() == 0).all());
  const Simulation second = make_simulation(scene, middle);
  EXPECT_EQ(second.time(), 0.0);
  EXPECT_EQ(second.totals().pair, 0U);
  EXPECT_EQ(second.state().images, middle.images);
}

TEST(GivenState, OneThatDoesNotFitTheSceneIsRefused) {
  const Scene scene = gas_scene(9, 0.2, Boundary::periodic);
  const State good = make_simulation(scene).state();
  const auto refused = [&](auto spoil) {
    State state = good;
    spoil(state);
    EXPECT_THROW(make_simulation(scene, state), std::invalid_argument);
  };
  refused([](State& state) { state.positions.conservativeResize(2, 8); });
  refused([](State& state) { state.velocities.conservativeResize(2, 10); });
  refused([](State& state) { state.positions(0, 3) = std::numeric_limits<double>::quiet_NaN(); });
  refused([](State& state) { state.velocities(1, 3) = std::numeric_limits<double>::infinity(); });
  refused([&](State& state) { state.positions(0, 3) = scene.box.upper[0]; });
  refused([&](State& state) { state.positions(1, 3) = std::nextafter(scene.box.lower[1], -1e9); });
}

TEST(GivenState, OneOutsideWallsIsRefused) {
  const Scene scene = gas_scene(9, 0.2, Boundary::walls);
  const State good = make_simulation(scene).state();
  for (const double x : {std::nextafter(scene.box.lower[0], -1e9), std::nextafter(scene.box.upper[0], 1e9), 1e6}) {
    State state = good;
    state.positions(0, 3) = x;
    EXPECT_THROW(make_simulation(scene, state), std::invalid_argument) << x;
  }
}

TEST(GivenState, OneOutsideACircularBoxIsRefused) {
  const Scene scene = parse_scene(
      "[box]\ncircle = { centre = [0, 0], radius = 5 }\n[[disks]]\ncount = 1\nradius = 0.5\nmass = 1\n"
      "positions = [[0, 0]]\nvelocities = { speed = 1 }\n[collision]\nrule = \"specular\"\n[run]\ntime = 1\n");
  State state = make_simulation(scene).state();
  state.positions.col(0) = Eigen::Vector2d(4.5, 4.5);
  EXPECT_THROW(make_simulation(scene, state), std::invalid_argument) << "in a corner of the square round it";
}

TEST(GivenState, WhatEffectsGoOnFromIsFinite) {
  Scene scene = gas_scene(4, 0.2, Boundary::walls);
  State good = make_simulation(scene).state();
  good.spins = Eigen::VectorXd::Zero(4);
  good.walls = {{scene.box.lower[0], 0.0}, {scene.box.upper[0], 0.0}, {scene.box.lower[1], 0.0}, {scene.box.upper[1], 0.0}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [&](auto with, auto spoil) {
    Scene affected = scene;
    with(affected);
    EXPECT_NO_THROW(make_simulation(affected, good));
    State state = good;
    spoil(state);
    EXPECT_THROW(make_simulation(affected, state), std::invalid_argument);
    EXPECT_NO_THROW(make_simulation(scene, state)) << "it is not asked for";
  };
  refused([](Scene& s) { s.effects.collision.roughness = 0.5; }, [&](State& state) { state.spins[2] = nan; });
  refused([](Scene& s) { s.effects.growth = Growth{.rate = 0.1, .packing_fraction = 0.5}; },
          [&](State& state) { state.scale = nan; });
  refused([](Scene& s) { s.effects.growth = Growth{.rate = 0.1, .packing_fraction = 0.5}; },
          [](State& state) { state.scale = 0.0; });
  refused([](Scene& s) { s.effects.walls[1].mass = s.effects.walls[1].load = 1.0; },
          [&](State& state) { state.walls[1].velocity = nan; });
  refused([](Scene& s) { s.effects.walls[1].velocity = 0.1; }, [&](State& state) { state.walls[1].position = nan; });
}

/// The state of a run with an effect begins a run without: no engine takes more of it along than another.
TEST(GivenState, OfAnotherSceneBringsNoEffectAlong) {
  const Box box = box_of(8.0, 4.0, Boundary::walls);
  const Scene plain = scene_of_placed(box, {{{2.0, 2.0}, {1.0, 0.0}}, {{5.0, 2.0}, {-1.0, 0.0}}});
  State state = make_simulation(plain).state();
  state.scale = 1.5;
  state.spins = Eigen::Vector2d(3.0, 4.0);
  state.walls = {{-1.0, -0.5}, {9.0, 0.5}, {-1.0, 0.0}, {5.0, 0.0}};
  state.shear_displacement = 1.0;
  Scene rough = plain, size_kept = plain, wall_at_rest = plain;
  rough.effects.collision.roughness = 0.0;
  size_kept.effects.growth = Growth{};
  wall_at_rest.effects.walls[0].velocity = 0.0;
  for (const char* engine : {"fast", "general", "textbook"}) {
    Simulation first = make_simulation(plain, state, engine);
    EXPECT_EQ(first.state().scale, 1.0);
    EXPECT_TRUE(first.state().walls.empty());
    first.record_events(true);
    first.run_until(4.0);
    const std::vector<Event> events = first.take_events();
    ASSERT_EQ(events.size(), 2U) << engine;
    EXPECT_EQ(events[0].time, 1.0) << engine << ": two disks of radius 1/2, three apart, meet at speed 2";
    EXPECT_EQ(events[1].time, 3.5) << engine << ": from 3 to the wall at 0";
  }
  for (const char* engine : engines_with_effects) {
    EXPECT_EQ(make_simulation(rough, state, engine).state().spins, state.spins);
    for (const Scene& neutral : {size_kept, wall_at_rest}) {
      Simulation simulation = make_simulation(neutral, state, engine);
      EXPECT_EQ(simulation.state().scale, 1.0);
      simulation.record_events(true);
      simulation.run_until(4.0);
      EXPECT_EQ(simulation.take_events()[1].time, 3.5) << engine;
    }
  }
}

TEST(GivenState, AWallOfAVelocityOfItsOwnHasIt) {
  Scene scene = scene_of_placed(box_of(8.0, 4.0, Boundary::walls), {{{4.0, 2.0}, {1.0, 0.0}}});
  scene.effects.walls[1].velocity = 0.5;
  State state = make_simulation(scene).state();
  state.walls = {{0.0, 0.0}, {8.5, -7.0}, {0.0, 0.0}, {4.0, 0.0}};
  for (const char* engine : engines_with_effects) {
    const State begun = make_simulation(scene, state, engine).state();
    ASSERT_EQ(begun.walls.size(), 4U);
    EXPECT_EQ(begun.walls[1].position, 8.5);
    EXPECT_EQ(begun.walls[1].velocity, 0.5);
  }
}

TEST(GivenState, EnginesWiderThanDoubleSayWhatDoublesCannotHold) {
  const Scene scene = gas_scene(16, 0.4, Boundary::periodic);
  Simulation wide = make_simulation(scene, "textbook-quad");
  wide.run_until(1.0);
  const State state = wide.state();
  ASSERT_EQ(state.remainders.cols(), 16);
  const double half_an_ulp = std::ldexp(scene.box.lengths().maxCoeff(), -53);
  EXPECT_LE(state.remainders.cwiseAbs().maxCoeff(), half_an_ulp);
  EXPECT_GT(state.remainders.cwiseAbs().minCoeff(), 0.0);
  EXPECT_EQ(make_simulation(scene, "textbook").state().remainders.cols(), 0);
}

}  // namespace
}  // namespace carom::test
