// Runs whose invariants are checked on the way, and what a run says of its near misses.

#include "support/effect_scenes.hpp"
#include "support/engines.hpp"
#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace carom::test {
namespace {

Scene thousand_collisions() {
  Scene scene = gas_scene(36, 0.5, Boundary::periodic);
  scene.run.collisions = 1000;
  return scene;
}

TEST(Verify, ChecksEverySoManyEventsAndAtTheEnd) {
  Simulation simulation = make_simulation(thousand_collisions());
  RunHooks hooks;
  hooks.verify_every = 500;
  const RunResult result = run_schedule(simulation, hooks);
  const Totals& totals = simulation.totals();
  const std::uint64_t events = totals.pair + totals.other + totals.stale;
  EXPECT_EQ(result.stopped, StopReason::collisions);
  EXPECT_TRUE(result.faults.empty());
  // An epoch that begins is a step of the loop too, which may put a check off by one event.
  EXPECT_NEAR(static_cast<double>(result.verified), static_cast<double>(events / 500 + 1), 1.0);
}

TEST(Verify, ChecksLeaveNoTraceInTheBits) {
  Simulation plain = make_simulation(thousand_collisions()), verified = make_simulation(thousand_collisions());
  RunHooks hooks;
  hooks.verify_every = 7;
  run_schedule(plain);
  run_schedule(verified, hooks);
  EXPECT_TRUE(same_bits(plain.state(), verified.state()));
}

TEST(Verify, ARunWithoutEventsIsCheckedOnce) {
  Scene scene = thousand_collisions();
  scene.species.front().velocities = AtRest{};
  scene.run.collisions.reset();
  scene.run.time = 1.0;
  Simulation simulation = make_simulation(scene);
  RunHooks hooks;
  hooks.verify_every = 100;
  EXPECT_EQ(run_schedule(simulation, hooks).verified, 1U);
}

TEST(Verify, ABrokenInvariantEndsTheRunWithItsSentence) {
  // A disk beyond the wall: no engine gets there, but a state given by a program may.
  Scene scene = scene_of_placed(box_of(4.0, 4.0, Boundary::walls), {{{1.0, 2.0}, {1.0, 0.0}}, {{3.0, 2.0}, {-1.0, 0.0}}});
  scene.run.time = 10.0;
  State start = draw_start(scene).state;
  start.positions.col(1) = Eigen::Vector2d(2.25, 0.25);
  start.velocities.col(1) = Eigen::Vector2d::Zero();
  for (const char* engine : {"fast", "textbook"}) {
    Simulation simulation = make_simulation(scene, start, engine);
    RunHooks hooks;
    hooks.verify_every = 1;
    const RunResult result = run_schedule(simulation, hooks);
    EXPECT_EQ(result.stopped, StopReason::invalid_state) << engine;
    ASSERT_FALSE(result.faults.empty()) << engine;
    EXPECT_NE(result.faults.front().find("disk 1: 0.25 beyond a wall across axis 1"), std::string::npos) << result.faults.front();
    EXPECT_LT(simulation.time(), 10.0) << "the first check comes after the first event";
  }
}

TEST(Verify, ADiskUponAnObstacleIsAFault) {
  const Box box = box_of(8.0, 8.0, Boundary::periodic, Boundary::walls);
  const std::vector<Obstacle> obstacles = {DiskObstacle{{2.0, 6.0}, 0.5}, SegmentObstacle{{7.5, 4.0}, {7.5, 6.0}},
                                           ArcObstacle{{4.0, 4.0}, 2.0, 90.0, 180.0}};
  // Across the edge from the segment, before the fixed disk, in the hollow of the arc; and beside the end of the arc.
  const std::vector<std::pair<Eigen::Vector2d, std::string>> places = {{{-0.25 + 8.0, 5.0}, "overlaps obstacles.1 by 0.25"},
                                                                       {{2.75, 6.0}, "overlaps obstacles.0 by 0.25"},
                                                                       {{2.25, 4.0}, "overlaps obstacles.2 by 0.25"},
                                                                       {{4.25, 6.0}, "overlaps obstacles.2 by 0.25"}};
  Scene scene = scene_of_placed(box, {{{6.0, 2.0}, {0.0, 1.0}}, {{2.0, 2.0}, {0.0, 0.0}}});
  scene.effects.obstacles = obstacles;
  for (const auto& [place, fault] : places) {
    State start = draw_start(scene).state;
    start.positions.col(1) = place;
    for (const char* engine : {"general", "textbook", "textbook-quad"}) {
      const Simulation simulation = make_simulation(scene, start, engine);
      ASSERT_EQ(simulation.check_invariants().size(), 1U) << engine << ", " << place.transpose();
      EXPECT_EQ(simulation.check_invariants().front(), "disk 1: " + fault) << engine << ", " << place.transpose();
    }
  }
}

TEST(Verify, AnOverlapThatTheStartBroughtAlongIsNoFault) {
  Scene scene = scene_of_placed(box_of(4.0, 4.0, Boundary::periodic), {{{1.0, 1.0}, {1.0, 0.0}}, {{3.0, 1.0}, {-1.0, 0.0}}});
  scene.run.time = 1.0;
  State start = draw_start(scene).state;
  start.positions.col(1) = Eigen::Vector2d(1.5, 1.0);
  for (const char* engine : {"fast", "textbook"}) {
    Simulation simulation = make_simulation(scene, start, engine);
    RunHooks hooks;
    hooks.verify_every = 1;
    EXPECT_EQ(run_schedule(simulation, hooks).stopped, StopReason::time) << engine;
  }
}

/// Runs a scene in which a disk stays where decimal digits have put it, upon what it touches, until it is hit: no check of the
/// run takes that for a fault.
void expect_a_touch_is_no_fault(const Scene& scene, const std::vector<std::string>& engines) {
  for (const std::string& engine : engines) {
    Simulation simulation = make_simulation(scene, engine);
    RunHooks hooks;
    hooks.verify_every = 1;
    const RunResult result = run_schedule(simulation, hooks);
    EXPECT_EQ(result.stopped, StopReason::time) << engine;
    EXPECT_TRUE(result.faults.empty()) << engine << ": " << result.faults.front();
    EXPECT_FALSE(simulation.check_invariants().empty()) << engine << ": nothing has moved it";
  }
}

TEST(Verify, AStartThatTouchesAWallToRoundingIsNoFault) {
  // The first stays where decimal digits have put it, a tenth of a billionth beyond the wall, until it is hit.
  Scene scene =
      scene_of_placed(box_of(4.0, 4.0, Boundary::walls), {{{0.4999999999, 2.0}, {0.0, 0.0}}, {{2.5, 2.0}, {0.25, 1.0}}});
  scene.run.time = 5.0;
  expect_a_touch_is_no_fault(scene, {"fast", "general", "textbook"});
}

TEST(Verify, AStartThatTouchesAnObstacleToRoundingIsNoFault) {
  // The first stays where decimal digits have put it until it is hit.
  Scene scene =
      scene_of_placed(box_of(8.0, 8.0, Boundary::walls), {{{4.0, 2.5000000001}, {0.0, 0.0}}, {{2.0, 2.0}, {0.25, 1.0}}});
  scene.effects.obstacles = {SegmentObstacle{{1.0, 3.0}, {7.0, 3.0}}};
  scene.run.time = 3.0;
  expect_a_touch_is_no_fault(scene, {"general", "textbook"});
}

TEST(Verify, DisksThatWillHaveGrownIntoEachOtherAfterManyEpochsArePlannedThen) {
  // All at rest: a row, and two that are several cells away from it and from each other, of which none leaves its own.
  std::vector<Placed> disks;
  for (int k = 0; k < 30; ++k) disks.push_back({{1.0 + 1.03125 * k, 2.0}, {0.0, 0.0}});
  disks.push_back({{8.0, 16.0}, {0.0, 0.0}});
  disks.push_back({{24.0, 16.0}, {0.0, 0.0}});
  Scene scene = scene_of_placed(box_of(32.0, 32.0, Boundary::periodic), disks);
  scene.effects.growth.emplace().rate = 0x1p-10;
  scene.run.time = 1.0;
  const auto faults = make_simulation(scene, "textbook").check_invariants();
  EXPECT_TRUE(faults.empty()) << faults.front();
}

TEST(Verify, OverlapsAreFaultsWhereTheyAreDeeperThanTolerated) {
  const Scene scene =
      scene_of_placed(box_of(4.0, 4.0, Boundary::periodic), {{{1.0, 1.0}, {1.0, 0.0}}, {{3.0, 1.0}, {-1.0, 0.0}}});
  State start = draw_start(scene).state;
  start.positions.col(1) = Eigen::Vector2d(1.75, 1.0);
  for (const char* engine : {"fast", "general", "textbook"}) {
    const Simulation simulation = make_simulation(scene, start, engine);
    EXPECT_TRUE(simulation.check_invariants(0.25).empty()) << engine;
    ASSERT_FALSE(simulation.check_invariants(0.2499).empty()) << engine;
    EXPECT_EQ(simulation.check_invariants().front(), "disks 0 and 1 overlap by 0.25") << engine;
  }
}

// ------------------------------------------------------------------------------------------------------- near misses

Numerics numerics_of(const Scene& scene, const std::string& engine, double time) {
  return run(scene, engine, time).simulation.totals().numerics;
}

TEST(Numerics, ThreeRowsThatCollideAtOneInstantAreTies) {
  std::vector<Placed> disks;
  for (const double y : {2.0, 4.0, 6.0}) {
    disks.push_back({{2.0, y}, {1.0, 0.0}});
    disks.push_back({{6.0, y}, {-1.0, 0.0}});
  }
  const Scene scene = scene_of_placed(box_of(8.0, 8.0, Boundary::walls), disks);
  for (const char* engine : {"fast", "general", "textbook"})
    EXPECT_EQ(numerics_of(scene, engine, 2.0).simultaneous, 2U) << engine;
}

TEST(Numerics, APassAtExactlyOneDiameterGrazes) {
  const Scene scene = scene_of_placed(box_of(8.0, 8.0, Boundary::walls), {{{2.0, 2.0}, {1.0, 0.0}}, {{5.0, 3.0}, {-1.0, 0.0}}});
  const Scene closer =
      scene_of_placed(box_of(8.0, 8.0, Boundary::walls), {{{2.0, 2.0}, {1.0, 0.0}}, {{5.0, 2.875}, {-1.0, 0.0}}});
  for (const char* engine : {"fast", "general", "textbook"}) {
    EXPECT_EQ(numerics_of(scene, engine, 2.0).grazing, 1U) << engine;
    EXPECT_EQ(numerics_of(closer, engine, 2.0).grazing, 0U) << engine;
  }
}

TEST(Numerics, AStartThatOverlapsIsSeenAtItsFirstContact) {
  Scene scene = scene_of_placed(box_of(8.0, 8.0, Boundary::walls), {{{2.0, 2.0}, {1.0, 0.0}}, {{5.0, 2.0}, {-1.0, 0.0}}});
  State start = draw_start(scene).state;
  start.positions(0, 1) = 3.0 - 0x1p-30;
  for (const char* engine : {"fast", "general", "textbook"}) {
    Simulation simulation = make_simulation(scene, start, engine);
    simulation.run_until(1.0);
    EXPECT_EQ(simulation.totals().numerics.overlapping, 1U) << engine;
    // Squares of lengths near 1, each rounded by 2^-53 or less.
    EXPECT_NEAR(simulation.totals().numerics.deepest_overlap, 0x1p-30, 0x1p-52) << engine;
  }
}

TEST(Numerics, ADiskSuddenlyMuchFasterOutrunsItsEpoch) {
  // A light disk between two heavy ones that close in on it.
  const Scene scene = scene_of_placed(
      box_of(64.0, 4.0, Boundary::walls),
      {{{20.0, 2.0}, {1.0, 0.0}, 0.5, 1e8}, {{32.0, 2.0}, {5.0, 0.0}, 0.5, 1e-4}, {{44.0, 2.0}, {-1.0, 0.0}, 0.5, 1e8}});
  for (const char* engine : {"fast", "general", "textbook"})
    EXPECT_GT(numerics_of(scene, engine, 10.99).early_epochs, 0U) << engine;
}

TEST(Numerics, LongestListIsKnownFromTheStart) {
  EXPECT_GE(make_simulation(thousand_collisions(), "fast").totals().numerics.longest_neighbour_list, 6U);
  EXPECT_EQ(make_simulation(thousand_collisions(), "textbook").totals().numerics.longest_neighbour_list, 0U);
}

}  // namespace
}  // namespace carom::test
