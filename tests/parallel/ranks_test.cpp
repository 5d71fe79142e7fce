// A run on several ranks has the bits of the run on one core: for any number of ranks and of threads of each. The ranks are
// threads here; tests/app/ranks_test.cpp has processes.

#include "support/memory_ranks.hpp"
#include "support/refusal.hpp"
#include "support/same_events.hpp"
#include "support/several_cores.hpp"

#include <carom/simulation.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace carom::test {
namespace {

void expect_same_runs_on(int ranks, const Scene& scene, const Threads& threads, double time, int stops,
                         const std::string& kind = "gas") {
  SCOPED_TRACE(kind);
  ServingRanks serving(ranks);
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads(threads, serving.first());
  for (int k = 1; k <= stops; ++k) {
    alone.run_until(time * k / stops);
    EXPECT_EQ(shared.run_until(time * k / stops), StopReason::time);
    EXPECT_EQ(shared.totals().virial, alone.totals().virial) << "before disks are asked for";
    expect_same(alone, shared, std::to_string(ranks) + " ranks, stop " + std::to_string(k));
  }
  EXPECT_TRUE(shared.check_invariants().empty());
  const ThreadCounts counts = shared.thread_counts();
  EXPECT_EQ(counts.ranks, static_cast<std::size_t>(ranks));
  if (counts.domains == 1) return;
  EXPECT_GT(counts.windows, 10U);
  EXPECT_LT(counts.windows_redone, counts.windows / 4);
}

TEST(Ranks, GiveTheBitsOfOneForAnyNumberOfThem) {
  for (const int ranks : {1, 2, 3, 4})
    for (const std::size_t threads : {1U, 2U, 3U})
      expect_same_runs_on(ranks, plain_gas(3000, 0.5, Boundary::periodic), {.threads = threads}, 4.0, 2);
}

TEST(Ranks, GiveTheBitsOfOneForScenesOfAllKinds) {
  expect_same_runs_on(3, plain_gas(4000, 0.72, Boundary::walls), {.domains = 5}, 2.0, 2, "dense");
  expect_same_runs_on(3, plain_gas(4000, 0.4, Boundary::periodic, CollisionRule::reversal), {}, 5.0, 2, "reversal");
  expect_same_runs_on(4, mixture(3000), {}, 8.0, 3, "mixture");
  Scene falling = plain_gas(3000, 0.4, Boundary::walls);
  falling.effects.gravity = Gravity{{0.0, -0.2}};
  falling.box.boundary[0] = Boundary::periodic;
  expect_same_runs_on(3, falling, {.threads = 2}, 20.0, 3, "falling");
  Scene cooling = plain_gas(3000, 0.4, Boundary::periodic);
  cooling.effects.collision.restitution = 0.9;
  expect_same_runs_on(3, cooling, {}, 20.0, 3, "cooling");
  Scene rough = cooling;
  rough.effects.collision.roughness = 0.3;
  expect_same_runs_on(2, rough, {}, 10.0, 2, "rough");
  Scene growing = plain_gas(3000, 0.3, Boundary::periodic);
  growing.effects.growth = Growth{.rate = 0.05};
  expect_same_runs_on(3, growing, {.threads = 2}, 6.0, 3, "growing");
  Scene wells = plain_gas(3000, 0.3, Boundary::periodic);
  wells.effects.square_well = SquareWell{.width = 1.6, .depth = 0.8};
  expect_same_runs_on(3, wells, {}, 8.0, 3, "wells");
  Scene stepped = plain_gas(3000, 0.3, Boundary::periodic);
  stepped.effects.stepped_potential = SteppedPotential{{{1.2, 0.4}, {1.7, -0.6}}};
  expect_same_runs_on(3, stepped, {}, 6.0, 3, "stepped");
  Scene tumbling = mixture(3000);
  tumbling.effects.tumbling = Tumbling{2.0};
  expect_same_runs_on(3, tumbling, {.threads = 2}, 6.0, 3, "tumbling");
  Scene thermal = rough;
  thermal.effects.growth = Growth{.rate = 0.01};
  thermal.effects.thermostat = Thermostat{2.0, 1.0};
  expect_same_runs_on(3, thermal, {}, 6.0, 3, "thermal");
  Scene brownian = plain_gas(3000, 0.3, Boundary::walls);
  brownian.effects.brownian = Brownian{1.0, 2.0};
  expect_same_runs_on(4, brownian, {}, 6.0, 3, "Brownian");
  Scene shaken = cooling;
  shaken.box.boundary = {Boundary::walls, Boundary::walls};
  shaken.effects.gravity = Gravity{{0.0, -0.5}};
  shaken.effects.walls[2].oscillation = Oscillation{WaveForm::sine, 0.4, 1.5};
  shaken.effects.walls[3].oscillation = Oscillation{WaveForm::sawtooth, 1.0, 0.5};
  expect_same_runs_on(3, shaken, {.threads = 2}, 10.0, 3, "shaken");
  Scene unlike = mixture(3000);
  unlike.effects.non_additivity = NonAdditivity{-0.2};
  expect_same_runs_on(3, unlike, {}, 8.0, 3, "non-additive");
}

/// Where domains are so small that one has more neighbours than it can tell apart, there are fewer of them.
TEST(Ranks, HaveFewerDomainsThanThreadsWhereThoseWouldBeTooSmall) {
  const Scene scene = plain_gas(1000, 0.5, Boundary::periodic);
  ServingRanks serving(3);
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads({.threads = 32}, serving.first());
  for (const double time : {3.0, 6.0}) {
    alone.run_until(time);
    shared.run_until(time);
    expect_same(alone, shared, "time " + std::to_string(time));
  }
  EXPECT_GE(shared.thread_counts().domains, 32U);
  EXPECT_LT(shared.thread_counts().domains, 96U);
  EXPECT_GT(shared.thread_counts().windows, 5U);
}

TEST(Ranks, FindEveryWindowThatTheirHalosAreTooNarrowFor) {
  std::uint64_t redone = 0;
  for (const double halo : {2.5, 4.0}) {
    const Scene scene = plain_gas(5000, 0.5, Boundary::periodic);
    ServingRanks serving(3);
    Simulation alone = make_simulation(scene), shared = make_simulation(scene);
    shared.set_threads({.domains = 4, .halo = halo, .events_per_window = 3.0}, serving.first());
    for (const double time : {3.0, 8.0}) {
      alone.run_until(time);
      shared.run_until(time);
      expect_same(alone, shared, "halo " + std::to_string(halo));
    }
    redone += shared.thread_counts().windows_redone;
  }
  EXPECT_GT(redone, 5U);
}

TEST(Ranks, StopAtExactNumbers) {
  const Scene scene = plain_gas(4000, 0.6, Boundary::periodic);
  ServingRanks serving(3);
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads({.threads = 2}, serving.first());
  for (const std::uint64_t collisions : {1U, 3000U, 20001U, 20002U, 50000U}) {
    EXPECT_EQ(alone.run_until(1e6, {.collisions = collisions}), StopReason::collisions);
    EXPECT_EQ(shared.run_until(1e6, {.collisions = collisions}), StopReason::collisions);
    expect_same(alone, shared, std::to_string(collisions) + " collisions");
  }
  EXPECT_EQ(alone.run_until(1e6, {.events = 60000}), StopReason::events);
  EXPECT_EQ(shared.run_until(1e6, {.events = 60000}), StopReason::events);
  expect_same(alone, shared, "events");
  EXPECT_GT(shared.thread_counts().windows, 10U);
}

TEST(Ranks, GoOnFromWhatOtherNumbersOfThemHaveSaved) {
  const Scene scene = plain_gas(4000, 0.5, Boundary::periodic);
  Simulation alone = make_simulation(scene);
  alone.run_until(6.0);
  std::stringstream saved;
  {
    ServingRanks four(4);
    Simulation shared = make_simulation(scene);
    shared.set_threads({}, four.first());
    shared.run_until(2.3);
    shared.save(saved);
    shared.run_until(2.4);  // and could go on
  }
  std::stringstream again;
  Simulation one = restore_simulation(scene, saved);
  one.run_until(4.1);
  one.save(again);
  ServingRanks three(3);
  Simulation shared = restore_simulation(scene, again);
  shared.set_threads({}, three.first());
  shared.run_until(6.0);
  expect_same(alone, shared, "resumed");
}

TEST(Ranks, GoOnAfterSingleStepsAndChanges) {
  const Scene scene = plain_gas(4000, 0.5, Boundary::periodic);
  ServingRanks serving(2);
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads({}, serving.first());
  for (Simulation* simulation : {&alone, &shared}) {
    simulation->run_until(1.0);
    simulation->step();
    simulation->run_until(2.0);
    simulation->set_velocities(-simulation->state().velocities);
    simulation->run_until(3.0);
    Effects effects = scene.effects;
    effects.collision.restitution = 0.9;
    simulation->set_effects(effects);
    simulation->run_until(4.0);
    simulation->reset_clock();
    simulation->run_until(1.0);
  }
  expect_same(alone, shared, "after changes");
  EXPECT_GT(shared.thread_counts().windows, 10U);
  shared.set_threads({});
  alone.run_until(2.0);
  shared.run_until(2.0);
  expect_same(alone, shared, "on one core again");
}

TEST(Ranks, TellTheCollisionsOfOneInTheirOrder) {
  Scene scene = plain_gas(3000, 0.5, Boundary::walls);
  scene.run.time = 3.0;
  scene.run.sample_every = 0.5;
  std::vector<Event> events[2];
  std::vector<std::array<double, 11>> records[2];
  for (const int ranks : {1, 3})
    for (const bool in_records : {false, true}) {
      ServingRanks serving(ranks);
      Simulation simulation = make_simulation(scene);
      // Narrow halos: collisions are to happen twice, and to be told once.
      simulation.set_threads({.halo = 5.0, .events_per_window = 2.0}, serving.first());
      if (in_records) {
        records[ranks / 3] = told_records(simulation);
      } else {
        events[ranks / 3] = told_events(simulation);
      }
      if (ranks > 1) {
        EXPECT_GT(simulation.thread_counts().windows, 1U);
      }
    }
  EXPECT_GT(events[0].size() + records[0].size(), 25000U);
  EXPECT_TRUE(same_events(events[1], events[0]));
  EXPECT_EQ(records[1], records[0]);
}

TEST(Ranks, ExchangeOnceInAWindow) {
  ServingRanks serving(3);
  Simulation shared = make_simulation(plain_gas(4000, 0.5, Boundary::periodic));
  shared.set_threads({.threads = 2}, serving.first());
  shared.run_until(4.0);
  const std::uint64_t windows = shared.thread_counts().windows;
  EXPECT_GT(windows, 20U);
  EXPECT_GE(serving.first().exchanges, windows);
  EXPECT_LE(serving.first().exchanges, windows + shared.totals().numerics.list_rebuilds);
}

/// Three rows of disks fill the height of a box, so that far more collisions seem to come than do, when only few are left.
TEST(Ranks, AreNotAskedAgainAndAgainWhereFarMoreCollisionsSeemedToCome) {
  const Scene scene = parse_scene(R"(
[box]
x = [0.0, 4.62]
y = [0.0, 2.0]
boundary = { x = "periodic", y = "walls" }
[[disks]]
radius = 0.3333333333333333
mass = 1.0
positions = [[0.55, 0.3333333333333333], [1.65, 0.3333333333333333], [3.05, 0.3333333333333333], [4.05, 0.3333333333333333],
             [0.6, 1.0], [1.96, 1.0], [2.9, 1.0], [3.93, 1.0],
             [0.4, 1.6666666666666665], [1.9, 1.6666666666666665], [3.02, 1.6666666666666665], [4.23, 1.6666666666666665]]
velocities = [[0.66, -0.34], [-0.51, -0.82], [0.48, -0.18], [0.1, -1.7], [0.07, 1.35], [0.55, 0.66],
              [-0.02, -0.91], [0.0, -0.57], [-0.3, 1.48], [0.6, 0.96], [-0.82, 0.01], [-1.13, -1.6]]
[collision]
rule = "specular"
[run]
time = 1.0
)");
  ServingRanks serving(2);
  std::uint64_t told = 0;
  serving.first().on_the_way = [&](int, const std::string& bytes) { return ++told, bytes; };
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads({.domains = 2, .halo = 4.4, .events_per_window = 0.6}, serving.first());
  for (const double time : {0.0, 0.01, 0.1, 100.0}) {
    alone.run_until(time, {.collisions = 110});
    shared.run_until(time, {.collisions = 110});
    expect_same(alone, shared, std::to_string(time));
  }
  // A rate halves in every part of a window in which nothing comes: a double that halves more often than 64 times is as good as
  // zero.
  EXPECT_LE(told, 64 * shared.thread_counts().windows);
}

TEST(Ranks, SayWhichOfThemCouldNotBegin) {
  ServingRanks serving(3);
  serving.first().on_the_way = [](int to, const std::string& bytes) {
    return to == 2 && bytes.size() > 1000 ? bytes.substr(0, bytes.size() - 100) : bytes;
  };
  Simulation simulation = make_simulation(plain_gas(1000, 0.3, Boundary::walls));
  EXPECT_THAT(refusal<std::runtime_error>([&] { simulation.set_threads({}, serving.first()); }),
              ::testing::StartsWith("process 2: "));
  serving.first().on_the_way = {};
  simulation.set_threads({}, serving.first());
  simulation.run_until(1.0);
  EXPECT_GT(simulation.thread_counts().windows, 0U);
}

TEST(Ranks, RefuseWhatTheyCannotDo) {
  ServingRanks serving(3);
  Simulation simulation = make_simulation(plain_gas(100, 0.3, Boundary::walls));
  EXPECT_THROW(simulation.set_threads({.threads = 33}, serving.first()), std::invalid_argument);
  EXPECT_THROW(simulation.set_threads({.domains = 1025}, serving.first()), std::invalid_argument);
  EXPECT_THROW(simulation.set_threads({.domains = 2}, serving.first()), std::invalid_argument) << "rank 2 would have none";
  Simulation textbook = make_simulation(plain_gas(100, 0.3, Boundary::walls), "textbook");
  EXPECT_THROW(textbook.set_threads({}, serving.first()), std::invalid_argument);
}

}  // namespace
}  // namespace carom::test
