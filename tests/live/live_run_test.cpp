// A run that is changed while it goes on. Without changes its twin is the run of the scene; with a change it is a simulation that
// begins in the state of that moment; and a list of changes gives the same bits however often one stops on the way.

#include "live/live_run.hpp"
#include "support/refusal.hpp"

#include <carom/simulation.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace carom::test {
namespace {

using testing::HasSubstr;

Scene walled_gas(const std::string& more = "", int disks = 24) {
  return parse_scene(
      "box = { x = [0, 10], y = [0, 10], boundary = \"walls\" }\ncollision = { rule = \"specular\" }\n"
      "run = { time = 4, seed = 3 }\n[[disks]]\nname = \"gas\"\ncount = " +
      std::to_string(disks) +
      "\nradius = 0.4\nmass = 1\npositions = \"random\"\n"
      "velocities = { temperature = 1 }\n" +
      more);
}

State state_of(const LiveRun& run) {
  State state;
  run.state(state);
  return state;
}

/// One of each kind, at times of which every sum and difference is exact.
std::vector<Change> some_changes() {
  return {{0.5, SetKeys{{"gravity.acceleration=[0, -1]"}}},
          {0.75, SetKeys{{"walls.left={ temperature = 2 }", "walls.right={ temperature = 1 }"}}},
          {1.0, RemoveDisk{5}},
          {1.25, ScaleVelocities{-1.0}},
          {1.5, SetKeys{{"disks.0.radius=0.3"}}},
          {1.5, SetKeys{{"walls.left={ restitution = 1 }"}}},
          {2.0, AddObstacle{DiskObstacle{{0.02, 0.02}, 0.001}}},
          {2.5, RemoveObstacle{0}}};
}

TEST(LiveRun, WithoutChangesEndsAsTheSceneRuns) {
  const Scene scene = walled_gas();
  Simulation twin = make_simulation(scene);
  run_schedule(twin);
  LiveRun run(scene);
  for (const double time : {0.1, 0.7, 2.0, 3.9, 4.0}) run.run_until(time);
  EXPECT_EQ(run.hash(), state_hash(twin.state()));
  EXPECT_EQ(run.pairs(), twin.counts().pair);
}

TEST(LiveRun, EquilibratesAsTheScheduleDoes) {
  const Scene scene = walled_gas("[thermostat]\ntemperature = 1\nrate = 0.1\n");
  Scene equilibrating = scene;
  equilibrating.run.equilibrate = Run::Equilibrate{.collisions_per_disk = 5.0};
  Simulation twin = make_simulation(equilibrating);
  run_schedule(twin);
  LiveRun run(equilibrating);
  EXPECT_EQ(run.time(), 0.0);
  run.run_until(4.0);
  EXPECT_EQ(run.hash(), state_hash(twin.state()));
}

TEST(LiveRun, GivesTheSameBitsHoweverOftenItStops) {
  LiveRun once(walled_gas());
  for (const Change& change : some_changes()) once.apply(change);
  once.run_until(4.0);

  LiveRun often(walled_gas());
  for (const Change& change : some_changes()) {
    while (often.run_until(change.time, 7) == StopReason::events) (void)often.hash();
    often.apply(change);
  }
  while (often.run_until(4.0, 1) == StopReason::events) {
  }
  EXPECT_EQ(often.time(), 4.0);
  EXPECT_EQ(often.hash(), once.hash());
  EXPECT_EQ(often.pairs(), once.pairs());
  EXPECT_EQ(often.changes().size(), some_changes().size());
}

TEST(LiveRun, SetsWhatTheSceneWouldHaveSaid) {
  LiveRun run(walled_gas());
  run.run_until(1.0);
  const State before = state_of(run);
  run.apply({1.0, SetKeys{{"gravity.acceleration=[0, -2]", "collision.restitution=0.5"}}});
  run.apply({1.0, SetKeys{{"gravity.acceleration=[0, -1]"}}});
  EXPECT_EQ(run.simulation().scene().effects.gravity->acceleration.y(), -1.0);
  EXPECT_EQ(run.simulation().scene().effects.collision.restitution, 0.5);
  Scene said = walled_gas("[gravity]\nacceleration = [0, -1]\n");
  said.effects.collision.restitution = 0.5;
  Simulation twin = make_simulation(said, before);
  twin.run_until(2.0);
  run.run_until(3.0);
  EXPECT_EQ(twin.state().positions, state_of(run).positions);
}

TEST(LiveRun, LetsAWallMoveThatWouldMeetTheOtherByTheEndOfTheRun) {
  Scene scene = walled_gas("", 2);
  scene.overrides = {"run.time=1000"};
  LiveRun run(scene);
  run.apply({1.0, SetKeys{{"walls.right={ velocity = -1 }"}}});
  run.apply({2.0, SetKeys{{"walls.right={ velocity = 0 }"}}});
  EXPECT_EQ(box_of(run.simulation().scene().box, state_of(run)).upper.x(), 9.0);
}

TEST(LiveRun, ChangesWhatIsSheared) {
  LiveRun run(parse_scene(
      "box = { x = [0, 10], y = [0, 10], boundary = \"periodic\" }\ncollision = { rule = \"specular\" }\nshear = { rate = 0.3 }\n"
      "run = { time = 4 }\n[[disks]]\ncount = 60\nradius = 0.4\nmass = 1\npositions = \"random\"\n"
      "velocities = { temperature = 1 }\n"));
  for (int k = 1; k <= 8; ++k) {
    run.apply({0.25 * k, SetKeys{{"shear.rate=0." + std::to_string(k)}}});
    run.apply({0.25 * k, RemoveDisk{k}});
  }
  const State state = state_of(run);
  EXPECT_GT(state.shear_displacement, 0.0);
  EXPECT_THROW(run.apply({2.0, AddDisk{0, state.positions.col(7)}}), SceneError);
  EXPECT_EQ(run.changes().size(), 16U);
}

TEST(LiveRun, LetsDisksComeAndGo) {
  LiveRun run(walled_gas("", 3));
  run.run_until(0.5);
  const State before = state_of(run);
  run.apply({0.5, RemoveDisk{1}});
  const State without = state_of(run);
  ASSERT_EQ(without.positions.cols(), 2);
  EXPECT_EQ(without.positions.col(0), before.positions.col(0));
  EXPECT_EQ(without.positions.col(1), before.positions.col(2));
  EXPECT_EQ(without.velocities.col(1), before.velocities.col(2));
  EXPECT_EQ(without.time, 0.5);
  run.apply({0.5, MoveDisk{0, {1.0, 1.0}, {0.0, 2.0}}});
  run.apply({0.5, AddDisk{0, {9.0, 9.0}, {-1.0, 0.0}}});
  const State with = state_of(run);
  ASSERT_EQ(with.positions.cols(), 3);
  EXPECT_EQ(with.positions.col(0), Eigen::Vector2d(1.0, 1.0));
  EXPECT_EQ(with.positions.col(2), Eigen::Vector2d(9.0, 9.0));
  EXPECT_EQ(with.velocities.col(2), Eigen::Vector2d(-1.0, 0.0));
  run.run_until(1.0);
  EXPECT_EQ(run.time(), 1.0);
}

TEST(LiveRun, ReversedAtOnceGoesBackToItsStart) {
  LiveRun run(walled_gas("", 8));
  const State start = state_of(run);
  run.apply({1.0, ScaleVelocities{-1.0}});
  run.run_until(2.0);
  EXPECT_LT((state_of(run).positions - start.positions).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(LiveRun, GoesBackToAMoment) {
  LiveRun run(walled_gas());
  run.apply({0.5, SetKeys{{"gravity.acceleration=[0, -1]"}}});
  run.apply({0.5, RemoveDisk{2}});
  run.run_until(1.0);
  const LiveRun::Moment moment = run.moment();
  run.run_until(2.0);
  const std::string there = run.hash();
  run.apply({2.0, RemoveDisk{0}});
  run.run_until(3.0);
  run.back_to(moment);
  EXPECT_EQ(run.time(), 1.0);
  EXPECT_EQ(run.changes().size(), 2u);
  run.run_until(2.0);
  EXPECT_EQ(run.hash(), there);
}

TEST(LiveRun, RefusesWhatCannotBeAndGoesOn) {
  LiveRun run(walled_gas());
  run.run_until(0.5);
  const State state = state_of(run);
  const auto said = [&](const Change& change) { return refusal<SceneError>([&] { run.apply(change); }); };
  const Eigen::Vector2d middle = state.positions.col(0);
  EXPECT_THAT(said({0.5, AddObstacle{SegmentObstacle{middle, middle + Eigen::Vector2d(0.1, 0.0)}}}), HasSubstr("obstacle"));
  EXPECT_THAT(said({0.5, AddDisk{0, middle, {0.0, 0.0}}}), HasSubstr("overlap"));
  EXPECT_THAT(said({0.5, AddDisk{4, {1.0, 1.0}, {0.0, 0.0}}}), HasSubstr("there is no species 4"));
  EXPECT_THAT(said({0.5, RemoveDisk{24}}), HasSubstr("there is no disk 24; ids go from 0 to 23"));
  EXPECT_THAT(said({0.5, RemoveObstacle{0}}), HasSubstr("there is no obstacle 0"));
  EXPECT_THAT(said({0.5, SetKeys{{"box.x=[0, 20]"}}}), HasSubstr("box.x belongs to the start of a run"));
  EXPECT_THAT(said({0.5, SetKeys{{"disks.0.count=3"}}}), HasSubstr("disks.0.count belongs to the start of a run"));
  EXPECT_THAT(said({0.5, SetKeys{{"gravity.acceleration=down"}}}), HasSubstr("gravity.acceleration"));
  EXPECT_THAT(said({0.25, ScaleVelocities{2.0}}), HasSubstr("comes too late"));
  EXPECT_TRUE(run.changes().empty());

  LiveRun twin(walled_gas());
  run.run_until(4.0);
  twin.run_until(4.0);
  EXPECT_EQ(run.hash(), twin.hash());
}

}  // namespace
}  // namespace carom::test
