// Velocities that are redrawn, on several cores.

#include "support/same_events.hpp"
#include "support/several_cores.hpp"

#include <carom/simulation.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace carom::test {
namespace {

/// The redraws of velocities that a scene may have.
enum class Redrawing { thermostat, tumbling, brownian };
constexpr Redrawing all_redrawing[] = {Redrawing::thermostat, Redrawing::tumbling, Redrawing::brownian};

void redraw(Scene& scene, Redrawing how, double rate, double temperature = 1.0) {
  if (how == Redrawing::thermostat) scene.effects.thermostat = Thermostat{temperature, rate};
  if (how == Redrawing::tumbling) scene.effects.tumbling = Tumbling{rate};
  if (how == Redrawing::brownian) scene.effects.brownian = Brownian{temperature, rate};
}

TEST(Threads, GiveTheBitsOfOneWhereVelocitiesAreRedrawn) {
  for (const Redrawing how : all_redrawing)
    for (const double rate : {0.1, 4.0}) {  // a disk collides some five times in a unit of time
      Scene scene = plain_gas(4000, 0.5, Boundary::periodic);
      redraw(scene, how, rate);
      for (const std::size_t domains : {2U, 3U, 16U}) expect_same_runs(scene, {.domains = domains}, 3.0, 3);
      scene.box.boundary = {Boundary::walls, Boundary::walls};
      expect_same_runs(scene, {.threads = 3, .domains = 4}, 3.0, 2);
    }
}

TEST(Threads, GiveTheBitsOfOneWhereVelocitiesAreRedrawnBesideOtherEffects) {
  for (const Redrawing how : all_redrawing) {
    Scene scene = mixture(3000);
    redraw(scene, how, 1.0);
    expect_same_runs(scene, {.domains = 4}, 8.0, 3);
    scene = plain_gas(3000, 0.3, Boundary::walls);
    scene.effects.gravity = Gravity{{0.0, -0.1}};
    redraw(scene, how, 1.0);
    expect_same_runs(scene, {.domains = 4}, 8.0, 3);
    scene = plain_gas(3000, 0.3, Boundary::periodic);
    scene.effects.square_well = SquareWell{.width = 1.6, .depth = 0.8};
    redraw(scene, how, 1.0);
    expect_same_runs(scene, {.domains = 3}, 6.0, 3);
    scene = plain_gas(3000, 0.3, Boundary::periodic);
    scene.effects.collision.restitution = 0.9;
    scene.effects.collision.roughness = 0.3;
    redraw(scene, how, 1.0);
    expect_same_runs(scene, {.threads = 2, .domains = 4}, 6.0, 3);
    scene.effects.growth = Growth{.rate = 0.01};  // spins are redrawn for the moment of inertia of that time
    expect_same_runs(scene, {.domains = 3}, 6.0, 3);
  }
}

/// Redraws at the time of every sample: a step that is a sum of powers of two is not rounded.
TEST(Threads, GiveTheBitsOfOneWhereRedrawsAndStopsComeAtOneTime) {
  Scene scene = plain_gas(4000, 0.5, Boundary::periodic);
  redraw(scene, Redrawing::brownian, 4.0);
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads({.domains = 4});
  for (int k = 1; k <= 12; ++k) {
    alone.run_until(0.25 * k);
    shared.run_until(0.25 * k);
    expect_same(alone, shared, "stop " + std::to_string(k));
    EXPECT_EQ(shared.counts().thermostat, 4000U * static_cast<unsigned>(k));
  }
  EXPECT_LT(shared.thread_counts().shared_out, 6U) << "not once for each stop";
}

/// Disks from the bath are far faster than any was when the epoch began: halos must know, and epochs end early.
TEST(Threads, GiveTheBitsOfOneInABathThatIsMuchHotter) {
  for (const Redrawing how : {Redrawing::thermostat, Redrawing::brownian})
    for (const double temperature : {1e2, 1e8}) {
      Scene scene = plain_gas(4000, 0.4, Boundary::walls);
      redraw(scene, how, temperature > 1e4 ? 0.02 : 1.0, temperature);
      SCOPED_TRACE("kT " + std::to_string(temperature));
      expect_same_at({0.5, 1.0}, scene, {.domains = 4});
    }
}

TEST(Threads, BeginAtRestWhereABathMovesDisks) {
  for (const Redrawing how : {Redrawing::thermostat, Redrawing::brownian}) {
    Scene scene = plain_gas(2000, 0.4, Boundary::periodic);
    scene.species[0].velocities = MaxwellVelocities{0.0};
    redraw(scene, how, 1.0);
    EXPECT_GT(expect_same_at({2.0, 6.0, 12.0}, scene, {.domains = 4}).windows, 10U);
  }
}

/// A window that is void takes back the redraws in it, and their energy.
TEST(Threads, MakeRedrawsOfVoidWindowsOnce) {
  for (const Redrawing how : all_redrawing) {
    Scene scene = plain_gas(6000, 0.5, Boundary::periodic);
    redraw(scene, how, 2.0);
    const ThreadCounts counts = expect_same_at({0.7, 4.0}, scene, {.domains = 4, .halo = 3.0, .events_per_window = 1.0});
    EXPECT_GT(counts.windows_redone, 0U);
  }
}

/// Redraws are far more than collisions here, and use up the limit of a stretch while a void window is made up for.
TEST(Threads, RunToANumberOfCollisionsWhereMostEventsAreRedraws) {
  for (const Redrawing how : all_redrawing) {
    Scene scene = plain_gas(2000, 0.02, Boundary::periodic);
    redraw(scene, how, 3.0);
    scene.run.time.reset();
    scene.run.collisions = 2000;
    Simulation alone = make_simulation(scene);
    ASSERT_EQ(run_schedule(alone).stopped, StopReason::collisions);
    std::uint64_t redone = 0;
    for (const Threads& threads : {Threads{.domains = 2}, Threads{.domains = 3, .halo = 3.0, .events_per_window = 4.0}}) {
      Simulation shared = make_simulation(scene);
      shared.set_threads(threads);
      double last = 0.0;
      RunHooks hooks;
      hooks.proceed = [&](const Progress& progress) {
        EXPECT_LE(last, progress.time) << "a run never goes back";
        last = progress.time;
        return true;
      };
      EXPECT_EQ(run_schedule(shared, hooks).stopped, StopReason::collisions);
      expect_same(alone, shared, std::to_string(threads.domains) + " domains");
      redone += shared.thread_counts().windows_redone;
    }
    EXPECT_GT(redone, 0U);
  }
}

TEST(Threads, StopAtExactNumbersBetweenRedraws) {
  for (const Redrawing how : all_redrawing) {
    Scene scene = plain_gas(4000, 0.5, Boundary::walls);
    redraw(scene, how, 2.0);
    Simulation alone = make_simulation(scene), shared = make_simulation(scene);
    shared.set_threads({.threads = 2, .domains = 4});
    for (const std::uint64_t collisions : {1U, 3000U, 20001U, 20002U}) {
      EXPECT_EQ(alone.run_until(1e6, {.collisions = collisions}), StopReason::collisions);
      EXPECT_EQ(shared.run_until(1e6, {.collisions = collisions}), StopReason::collisions);
      expect_same(alone, shared, std::to_string(collisions) + " collisions");
    }
    const std::uint64_t events = alone.counts().events() + 10'000;
    EXPECT_EQ(alone.run_until(1e6, {.events = events}), StopReason::events);
    EXPECT_EQ(shared.run_until(1e6, {.events = events}), StopReason::events);
    expect_same(alone, shared, "events");
    for (int step = 0; step < 20; ++step) {
      const auto a = alone.step(), b = shared.step();
      ASSERT_TRUE(a && b);
      EXPECT_EQ(a->disk, b->disk);
      EXPECT_EQ(a->partner, b->partner);
    }
    expect_same(alone, shared, "steps");
  }
}

TEST(Threads, GoOnWithRedrawsFromWhatOtherNumbersOfThemHaveSaved) {
  for (const Redrawing how : all_redrawing) {
    Scene scene = plain_gas(4000, 0.5, Boundary::periodic);
    redraw(scene, how, 1.0);
    expect_same_after_saves(scene, 1.9, 3.1, 5.0);
  }
}

/// Most disks of a lattice meet in pairs at the time at which all velocities are redrawn, and some of them meet again at once.
TEST(Threads, TellCollisionsAndRedrawsOfOneInstantInTheirOrder) {
  Scene scene = plain_gas(400, 0.2, Boundary::walls);
  scene.box = {{0.0, 0.0}, {40.0, 40.0}, {Boundary::walls, Boundary::walls}};
  ListedPositions positions;
  ListedVelocities velocities;
  for (int x = 0; x < 20; ++x)
    for (int y = 0; y < 20; ++y) {
      positions.values.emplace_back(1.0 + 2.0 * x, 1.0 + 2.0 * y);
      velocities.values.push_back(y % 3 == 0 ? Eigen::Vector2d(0.0, 0.5) : Eigen::Vector2d(x % 2 == 0 ? 1.0 : -1.0, 0.0));
    }
  scene.species.front().positions = positions;
  scene.species.front().velocities = velocities;
  redraw(scene, Redrawing::brownian, 2.0);
  scene.run.time = 2.0;
  scene.run.sample_every = 0.5;
  const std::vector<Event> alone = told_events(scene, {});
  EXPECT_GT(std::ranges::count(alone, 0.5, &Event::time), 140) << "130 pairs meet, and some of them again";
  for (const std::size_t domains : {2U, 3U, 8U})
    EXPECT_TRUE(same_events(told_events(scene, {.domains = domains}), alone)) << domains;
}

}  // namespace
}  // namespace carom::test
