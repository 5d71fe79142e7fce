// A run on several cores has the bits of the run on one: for any number of domains and threads, any halo and window, and wherever
// one stops.

#include "support/several_cores.hpp"

#include <carom/simulation.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

namespace carom::test {
namespace {

TEST(Threads, GiveTheBitsOfOneForAnyNumberOfDomains) {
  for (const std::size_t domains : {2U, 3U, 8U, 16U})
    expect_same_runs(plain_gas(4000, 0.6, Boundary::periodic), {.threads = 1, .domains = domains}, 6.0, 3);
}

/// A run stops every now and then at a number of collisions, of which a lattice has few at first and then many.
TEST(Threads, KeepTheirWindowsAfterAStartFromALattice) {
  for (const Positions& lattice : {Positions{HexagonalLattice{}}, Positions{SquareLattice{}}})
    for (const double packing_fraction : {0.3, 0.45, 0.6, 0.7}) {
      Scene scene = gas_scene(4096, packing_fraction, Boundary::periodic);
      scene.species.front().positions = lattice;
      scene.run.time = 8.0;
      Simulation alone = make_simulation(scene), shared = make_simulation(scene);
      shared.set_threads({.threads = 1, .domains = 2});
      run_schedule(alone, {});
      run_schedule(shared, {});
      expect_same(alone, shared, std::to_string(packing_fraction));
      EXPECT_GT(shared.thread_counts().windows, 20U);
      EXPECT_LE(shared.thread_counts().windows_redone, 2U) << packing_fraction;
      // A void window costs one core what its epoch has had so far; a second one in the same epoch, all of it.
      const ThreadCounts counts = shared.thread_counts();
      const auto whole_epochs = static_cast<double>(shared.totals().numerics.epochs - 1);  // the last may be cut short
      EXPECT_LE(counts.share_alone(), std::min(static_cast<double>(counts.windows_redone) / whole_epochs, 0.3))
          << packing_fraction;
    }
}

TEST(Threads, GiveTheBitsOfOneForAnyNumberOfThreads) {
  for (const std::size_t threads : {2U, 3U, 4U})
    expect_same_runs(plain_gas(6000, 0.5, Boundary::walls), {.threads = threads}, 4.0, 2);
}

TEST(Threads, GiveTheBitsOfOneForEveryGas) {
  expect_same_runs(plain_gas(5000, 0.3, Boundary::walls), {.domains = 4}, 10.0, 3);
  expect_same_runs(plain_gas(5000, 0.72, Boundary::periodic), {.domains = 4}, 2.0, 3);
  expect_same_runs(plain_gas(5000, 0.4, Boundary::periodic, CollisionRule::reversal), {.domains = 4}, 6.0, 3);
  expect_same_runs(mixture(3000), {.domains = 4}, 8.0, 3);
  expect_same_runs(plain_gas(4000, 0.02, Boundary::periodic), {.domains = 4}, 200.0, 3);
}

TEST(Threads, GiveTheBitsOfOneForAGasInACorner) {
  Scene scene = plain_gas(3000, 0.5, Boundary::walls);
  scene.species[0].positions = ListedPositions{};
  scene.box.upper *= 4.0;
  const int columns = 60;
  for (int i = 0; i < 3000; ++i)
    std::get<ListedPositions>(scene.species[0].positions)
        .values.emplace_back(1.0 + 1.2 * (i % columns), 1.0 + 1.2 * (i / columns));
  expect_same_runs(scene, {.domains = 4}, 60.0, 3);
}

/// In the epoch that begins at time 8 the domain at the left gets more disks than it has room for, and all goes back to the
/// beginning of the epoch: what the domain could not read by then makes no plan stale.
TEST(Threads, GoBackToTheRightPlansWhereADomainHasNoRoom) {
  Scene scene = plain_gas(3000, 0.4, Boundary::walls);
  scene.effects.collision.restitution = 0.9;
  scene.effects.gravity = Gravity{{0.0, -0.5}};
  scene.effects.walls[2] = {.restitution = 0.95, .oscillation = Oscillation{WaveForm::sine, 0.4, 1.5}};
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads({.domains = 2, .halo = 10.0});
  alone.run_until(8.3);
  shared.run_until(8.3);
  expect_same(alone, shared, "no room");
  EXPECT_GT(shared.thread_counts().windows_redone, 0U);
}

/// A gas that cools down to a thousandth of its speed has windows a thousand times as long.
TEST(Threads, AdaptWindowsToDisksThatBecomeSlow) {
  Scene scene = plain_gas(4000, 0.4, Boundary::periodic);
  scene.effects.collision.restitution = 0.7;
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads({.domains = 4});
  alone.run_until(2000.0);
  shared.run_until(2000.0);
  expect_same(alone, shared, "cold");
  EXPECT_LT(shared.thread_counts().windows, 20 * alone.totals().pair / 4000);
}

/// Cold disks that a heavy one runs into leave it much faster than any disk was when the epoch began.
TEST(Threads, GiveTheBitsOfOneWhereADiskOutrunsItsEpoch) {
  Scene scene = plain_gas(4000, 0.2, Boundary::periodic);
  scene.species[0].velocities = MaxwellVelocities{1e-3};
  Species ball = scene.species[0];
  ball.name = "ball";
  ball.count = 1;
  ball.mass = 1e4;
  ball.positions = ListedPositions{{{1.0, 1.0}}};
  ball.velocities = ListedVelocities{{{5.0, 2.0}}};
  scene.species[0].positions = RandomPositions{};
  scene.species.insert(scene.species.begin(), ball);
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads({.domains = 4});
  for (const double time : {2.0, 10.0}) {
    alone.run_until(time);
    shared.run_until(time);
    expect_same(alone, shared, "time " + std::to_string(time));
  }
  EXPECT_GT(alone.totals().numerics.early_epochs, 0U);
  EXPECT_EQ(shared.totals().numerics.early_epochs, alone.totals().numerics.early_epochs);
  EXPECT_GT(shared.thread_counts().windows_redone, 0U);
}

/// A window that is void leaves the disks to one core up to the end of its epoch, but no longer where the clock begins anew.
TEST(Threads, ComputeAgainAfterTheClockBeganAnew) {
  Scene scene = plain_gas(4000, 0.2, Boundary::periodic);
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads({.domains = 4, .halo = 2.5, .events_per_window = 3.0});
  double time = 0.0;
  while (shared.thread_counts().windows_redone == 0) {
    ASSERT_LT(time, 100.0);
    shared.run_until(time += 0.01);
  }
  alone.run_until(time);
  expect_same(alone, shared, "where a window was void");
  alone.reset_clock();
  shared.reset_clock();
  const std::uint64_t windows = shared.thread_counts().windows;
  alone.run_until(0.5 * time);
  shared.run_until(0.5 * time);
  EXPECT_GT(shared.thread_counts().windows, windows);
  expect_same(alone, shared, "on the new clock");
}

TEST(Threads, FindEveryWindowThatTheirHalosAreTooNarrowFor) {
  std::uint64_t redone = 0;
  for (const double halo : {2.5, 3.0, 4.0, 6.0})
    for (const double events : {0.2, 1.0, 3.0}) {
      const Scene scene = plain_gas(6000, 0.5, Boundary::periodic);
      Simulation alone = make_simulation(scene), shared = make_simulation(scene);
      shared.set_threads({.domains = 4, .halo = halo, .events_per_window = events});
      alone.run_until(8.0);
      shared.run_until(8.0);
      expect_same(alone, shared, "halo " + std::to_string(halo));
      const ThreadCounts counts = shared.thread_counts();
      redone += counts.windows_redone;
      EXPECT_EQ(counts.events + counts.events_alone, all_events(shared)) << "each is counted once";
    }
  EXPECT_GT(redone, 10U);
}

TEST(Threads, GoOnFromWhatOtherNumbersOfThemHaveSaved) {
  expect_same_after_saves(plain_gas(4000, 0.5, Boundary::periodic), 2.3, 4.1, 6.0);
}

TEST(Threads, GoOnAfterSingleStepsAndChanges) {
  const Scene scene = plain_gas(4000, 0.5, Boundary::periodic);
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads({.domains = 4});
  for (Simulation* simulation : {&alone, &shared}) {
    simulation->run_until(1.0);
    simulation->step();
    simulation->run_until(2.0);
    simulation->set_velocities(-simulation->state().velocities);
    simulation->run_until(3.5);
    simulation->reset_clock();
    simulation->run_until(1.0);
  }
  expect_same(alone, shared, "after changes");
  shared.set_threads({});
  alone.run_until(2.0);
  shared.run_until(2.0);
  expect_same(alone, shared, "on one core again");
}

TEST(Threads, BeginWhereAChangeEndsWhatKeepsTheRunOnOneCore) {
  Scene scene = plain_gas(4000, 0.5, Boundary::periodic);
  scene.effects.drag = Drag{0.02};
  EXPECT_EQ(make_simulation(scene).why_not_threads(), "drag slows the clock");
  EXPECT_THROW(make_simulation(scene).set_threads({.domains = 3}), std::invalid_argument);
  scene.changes = {{0.5, SetKeys{{"drag.rate=0"}}}};
  EXPECT_THROW(make_simulation(scene, "textbook").set_threads({.domains = 3}), std::invalid_argument);
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  EXPECT_EQ(shared.why_not_threads(), "");
  shared.set_threads({.domains = 3});
  alone.run_until(2.0);
  shared.run_until(0.3);
  EXPECT_EQ(shared.thread_counts().windows, 0U);
  std::stringstream saved;
  shared.save(saved);
  Simulation resumed = restore_simulation(scene, saved);
  resumed.set_threads({.domains = 4});
  for (Simulation* simulation : {&shared, &resumed}) {
    simulation->run_until(2.0);
    EXPECT_GT(simulation->thread_counts().windows, 0U);
    expect_same(alone, *simulation, "after drag");
  }
}

TEST(Threads, RunASchedule) {
  Scene scene = plain_gas(4000, 0.5, Boundary::periodic);
  scene.run.equilibrate = Run::Equilibrate{.collisions_per_disk = 4.0};
  scene.run.time = 3.0;
  scene.run.sample_every = 0.1;
  std::vector<std::string> hashes[2];
  std::vector<double> blocks[2];
  for (const std::size_t domains : {1U, 4U}) {
    Simulation simulation = make_simulation(scene);
    simulation.set_threads({.domains = domains});
    const std::size_t n = domains > 1 ? 1 : 0;
    RunHooks hooks;
    hooks.sample = [&](std::uint64_t, const State& state) { hashes[n].push_back(state_hash(state)); };
    hooks.block = [&](const Progress& progress) {
      blocks[n].push_back(progress.time);
      blocks[n].push_back(progress.totals.virial);
    };
    run_schedule(simulation, hooks);
    if (domains > 1) {
      EXPECT_GT(simulation.thread_counts().windows, 20U);
    }
  }
  EXPECT_EQ(hashes[0].size(), 31U);
  EXPECT_EQ(hashes[1], hashes[0]);
  EXPECT_GT(blocks[0].size(), 4U);
  EXPECT_EQ(blocks[1], blocks[0]);
}

TEST(Threads, RefuseWhatTheyCannotDo) {
  Simulation simulation = make_simulation(plain_gas(100, 0.3, Boundary::walls));
  EXPECT_THROW(simulation.set_threads({.threads = 0}), std::invalid_argument);
  EXPECT_THROW(simulation.set_threads({.threads = 33}), std::invalid_argument);
  EXPECT_THROW(simulation.set_threads({.domains = 33}), std::invalid_argument);
  EXPECT_THROW(simulation.set_threads({.threads = 2, .halo = -1.0}), std::invalid_argument);
  EXPECT_THROW(simulation.set_threads({.threads = 2, .events_per_window = -1.0}), std::invalid_argument);
  Simulation textbook = make_simulation(plain_gas(100, 0.3, Boundary::walls), "textbook");
  EXPECT_FALSE(textbook.why_not_threads().empty());
  EXPECT_THROW(textbook.set_threads({.threads = 2}), std::invalid_argument);
  textbook.set_threads({});
}

}  // namespace
}  // namespace carom::test
