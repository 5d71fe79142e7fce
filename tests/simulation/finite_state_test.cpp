// A state that is not finite is never a success: whatever happens, the run ends with a sentence.

#include "simulation/finite_state.hpp"
#include "support/effect_scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace carom::test {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

State two_disks() {
  State state;
  state.positions = Eigen::Matrix2Xd::Zero(2, 2);
  state.velocities = Eigen::Matrix2Xd::Zero(2, 2);
  return state;
}

TEST(FiniteState, EveryPartOfItIsLookedAt) {
  EXPECT_EQ(detail::not_finite(two_disks()), "");
  EXPECT_EQ(detail::not_finite(State{}), "");
  const auto found = [](auto change) {
    State state = two_disks();
    change(state);
    return detail::not_finite(state);
  };
  EXPECT_EQ(found([](State& s) { s.velocities(1, 1) = no_number; }), "disk 1: its velocity is not finite");
  EXPECT_EQ(found([](State& s) { s.positions(0, 1) = infinite; }), "disk 1: its position is not finite");
  EXPECT_EQ(found([](State& s) { s.spins = Eigen::Vector2d(infinite, 0.0); }), "disk 0: its spin is not finite");
  EXPECT_EQ(found([](State& s) { s.walls = {{0.0, no_number}}; }), "the place or speed of a wall is not finite");
  EXPECT_EQ(found([](State& s) { s.scale = infinite; }), "the size of the disks is not finite");
  EXPECT_EQ(found([](State& s) { s.time = no_number; }), "the clock is not finite");
}

/// Two disks of radius 4 whose surfaces slide past each other faster than numbers go.
Simulation spinning_too_fast(const char* engine) {
  Scene scene =
      scene_of_placed(box_of(64.0, 64.0, Boundary::walls), {{{20.0, 32.0}, {1.0, 0.0}, 4.0}, {{32.0, 32.0}, {-1.0, 0.0}, 4.0}});
  scene.effects.collision.roughness = 0.5;
  scene.run.time = 8.0;
  State start = draw_start(scene).state;
  start.spins = Eigen::Vector2d(1e308, 1e308);
  return make_simulation(scene, start, engine);
}

TEST(FiniteState, AVelocityThatWouldNotBeEndsARunBeforeIt) {
  for (const char* engine : engines_with_effects) {
    Simulation simulation = spinning_too_fast(engine);
    std::uint64_t heard = 0, sampled = 0;
    RunHooks hooks;
    hooks.events = [&](std::span<const Event> events) { heard += events.size(); };
    hooks.grids.push_back({1.0, [&](std::uint64_t, const State& state, const Totals&) {
                             ++sampled;
                             EXPECT_TRUE(state.velocities.allFinite());
                           }});
    const RunResult result = run_schedule(simulation, hooks);
    EXPECT_EQ(result.stopped, StopReason::invalid_state) << engine;
    ASSERT_EQ(result.faults.size(), 1U) << engine;
    EXPECT_EQ(result.faults.front(), "disks 0 and 1: their velocities would not be finite after their collision");
    EXPECT_EQ(simulation.time(), 2.0) << "where they touch";
    EXPECT_EQ(simulation.state().velocities.col(0), Eigen::Vector2d(1.0, 0.0)) << "as before";
    EXPECT_EQ(heard, 0U) << "it is no event";
    EXPECT_EQ(sampled, 2U) << "at 0 and 1";
  }
}

TEST(FiniteState, AProgramThatRunsASimulationItselfIsTold) {
  for (const char* engine : engines_with_effects) {
    Simulation simulation = spinning_too_fast(engine);
    EXPECT_EQ(simulation.run_until(1.0), StopReason::time);
    EXPECT_EQ(simulation.run_until(8.0), StopReason::invalid_state) << engine;
    EXPECT_EQ(simulation.run_until(8.0), StopReason::invalid_state) << "for good";
    EXPECT_NE(simulation.check_invariants().front().find("would not be finite"), std::string::npos);
  }
}

TEST(FiniteState, ASpeedThatIsNoneInSinglePrecisionIsToldAtOnce) {
  const Scene scene = [] {
    Scene slow = scene_of_placed(box_of(16.0, 16.0, Boundary::walls), {{{5.0, 8.0}, {1.0, 0.0}}});
    slow.run.time = 1.0;
    return slow;
  }();
  State start = make_simulation(scene).state();
  start.velocities(0, 0) = 1e60;  // in a scene it would be refused
  Simulation simulation = make_simulation(scene, start, "textbook-float");
  EXPECT_EQ(run_schedule(simulation).stopped, StopReason::invalid_state);
}

TEST(FiniteState, SinglePrecisionIsNotForSpeedsWhoseSquaresItCannotHold) {
  for (const double speed : {1e-25, 1e-10, 1.0, 1e10, 1e25}) {
    const Scene scene = scene_of_placed(box_of(16.0, 16.0, Boundary::walls), {{{5.0, 8.0}, {speed, 0.0}}});
    const std::vector<std::string> covering = engines_covering(scene);
    EXPECT_EQ(std::ranges::find(covering, "textbook-float") != covering.end(), speed > 1e-20 && speed < 1e20) << speed;
  }
}

TEST(FiniteState, FixedStepsEndTooWhereANumberIsNone) {
  // Centre all but upon centre: the line between them has no direction that squares could tell.
  Scene scene =
      scene_of_placed(box_of(16.0, 16.0, Boundary::periodic), {{{0.0, 8.0}, {1.0, 0.0}}, {{0x1p-600, 8.0}, {-1.0, 0.0}}});
  scene.run.accept_overlap = true;
  scene.run.time = 1.0;
  for (const char* method : {"guarded", "grid"}) {
    Simulation simulation = make_simulation(scene, FixedStep{method, 0.125});
    const RunResult result = run_schedule(simulation);
    EXPECT_EQ(result.stopped, StopReason::invalid_state) << method;
    ASSERT_FALSE(result.faults.empty());
    EXPECT_EQ(simulation.run_until(2.0), StopReason::invalid_state);
  }
}

}  // namespace
}  // namespace carom::test
