// Where a run on several cores stops, and what it counts: as one does, whatever has been done twice on the way.

#include "support/engines.hpp"
#include "support/several_cores.hpp"

#include <carom/simulation.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

namespace carom::test {
namespace {

/// 1/3 and its multiples are at the end of an epoch to the last bit, and behind it by less than that.
TEST(Threads, GiveTheBitsOfOneWhereAStopIsTheEndOfAnEpochToRounding) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Scene scene = load_scene(CAROM_SOURCE_DIR "/docs/scenes/gas.toml");
    scene.run.seed = seed;
    Simulation alone = make_simulation(scene), shared = make_simulation(scene);
    shared.set_threads({.domains = 2});
    for (int k = 1; k <= 9; ++k) {
      for (Simulation* simulation : {&alone, &shared}) {
        simulation->run_until(k / 3.0);
        if (k == 3) simulation->set_velocities(0.9 * simulation->state().velocities);
      }
      expect_same(alone, shared, "seed " + std::to_string(seed) + ", stop " + std::to_string(k));
    }
  }
}

/// A window that is void takes back what happened since the whole engine was last up to date, which is more than a caller may ask
/// for at a time. Such a caller would see a run that goes nowhere.
TEST(Threads, NeverGoBackBehindWhatTheyHaveTold) {
  const Scene scene = plain_gas(6000, 0.5, Boundary::periodic);
  const auto engine = make_engine("fast", scene);
  engine->set_threads({.domains = 4, .halo = 3.5, .events_per_window = 0.1});
  std::uint64_t pairs = 0;
  Instant time{};
  while (pairs < 200'000) {
    ASSERT_FALSE(engine->run_about(Instant{1e6, 0.0}, 1'000'000, 500));
    ASSERT_GT(engine->counts().pair, pairs);
    ASSERT_TRUE(time < engine->now());
    pairs = engine->counts().pair;
    time = engine->now();
  }
  EXPECT_GT(engine->thread_counts().windows_redone, 2U);
}

/// Disks at rest far apart between walls: a lattice of 8 x 8.
Scene disks_at_rest(Effects effects) {
  Scene scene = gas_scene(64, 0.1, Boundary::walls);
  scene.box = {{0.0, 0.0}, {40.0, 34.0}, {Boundary::walls, Boundary::walls}};
  Species& gas = scene.species.front();
  ListedPositions positions;
  for (int i = 0; i < 64; ++i) positions.values.emplace_back(8.0 + 4.0 * (i % 8), 3.0 + 4.0 * (i / 8));
  gas.positions = positions;
  gas.velocities = MaxwellVelocities{0.0};
  scene.effects = std::move(effects);
  return scene;
}

/// A caller looks at the time and at signals when run_about() returns. Where borders move again and again, epochs go by without
/// an event, or redraws move nothing, it must return all the same.
TEST(Threads, ReturnAfterAboutAsManyEventsAsAreAskedFor) {
  Effects oscillating, tumbling;
  oscillating.walls[0].oscillation = Oscillation{.amplitude = 0.5, .frequency = 1.0};
  tumbling.tumbling = Tumbling{.rate = 1e4};
  Scene one_moves = disks_at_rest({});
  one_moves.box.upper = {640.0, 10.0};
  ListedPositions row;
  ListedVelocities velocities;
  for (int i = 0; i < 64; ++i) {
    row.values.emplace_back(5.0 + 10.0 * i, 5.0);
    velocities.values.emplace_back(0.0, i == 0 ? 1000.0 : 0.01);
  }
  one_moves.species.front().positions = row;
  one_moves.species.front().velocities = velocities;
  for (const Scene& scene : {one_moves, disks_at_rest(oscillating), disks_at_rest(tumbling)}) {
    const auto engine = make_engine(scene.effects.acting().empty() ? "fast" : "general", scene);
    engine->set_threads({.domains = 2});
    constexpr std::uint64_t asked = 1000;
    ASSERT_FALSE(engine->run_about(Instant{1e12, 0.0}, RunLimits::none, asked));
    EXPECT_GE(detail::events_and_epochs(engine->counts()), asked / 2);
    EXPECT_LE(detail::events_and_epochs(engine->counts()), 2 * asked);
  }
}

TEST(Threads, StopAtAnExactNumberOfCollisions) {
  const Scene scene = plain_gas(6000, 0.6, Boundary::periodic);
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads({.threads = 2, .domains = 4});
  for (const std::uint64_t collisions : {1U, 3000U, 20001U, 20002U, 50000U}) {
    EXPECT_EQ(alone.run_until(1e6, {.collisions = collisions}), StopReason::collisions);
    EXPECT_EQ(shared.run_until(1e6, {.collisions = collisions}), StopReason::collisions);
    expect_same(alone, shared, std::to_string(collisions) + " collisions");
  }
}

/// Two disks meet at time 1 while a third comes to a wall, in another domain: one core stops between the two events, or behind
/// both. Disks at rest make neighbourhoods narrow.
TEST(Threads, StopAtACollisionThatIsNotAloneAtItsTime) {
  struct Third {
    Eigen::Vector2d position, velocity;
  };
  std::uint64_t walls = 0;
  for (const double sign : {1.0, -1.0})
    for (const Third& third :
         {Third{{18.5, 4.0}, {1.0, 0.0}}, Third{{10.0, 1.5}, {0.0, -1.0}}, Third{{10.0, 22.5}, {0.0, 1.0}}}) {
      Scene scene = gas_scene(203, 0.1, Boundary::walls);
      scene.box = {{-20.0, 0.0}, {20.0, 24.0}, {Boundary::walls, Boundary::walls}};
      std::vector<Eigen::Vector2d> positions = {{-10.0, 4.0}, {-7.0, 4.0}, third.position};
      std::vector<Eigen::Vector2d> velocities = {{1.0, 0.0}, {-1.0, 0.0}, third.velocity};
      for (int i = 0; i < 200; ++i) {
        positions.emplace_back(-18.0 + 1.5 * (i % 25), 7.0 + 1.5 * (i / 25));
        velocities.emplace_back(0.0, 0.0);
      }
      for (Eigen::Vector2d& position : positions) position.x() *= sign;
      for (Eigen::Vector2d& velocity : velocities) velocity.x() *= sign;
      scene.species.front().positions = ListedPositions{positions};
      scene.species.front().velocities = ListedVelocities{velocities};
      Simulation alone = make_simulation(scene), shared = make_simulation(scene);
      shared.set_threads({.domains = 2});
      for (Simulation* simulation : {&alone, &shared})
        EXPECT_EQ(simulation->run_until(10.0, {.collisions = 1}), StopReason::collisions);
      EXPECT_EQ(alone.time(), 1.0);
      walls += alone.counts().wall;
      expect_same(alone, shared, "third at " + std::to_string(sign * third.position.x()));
    }
  EXPECT_GT(walls, 0U) << "the wall comes first in some";
  EXPECT_LT(walls, 6U) << "and second in others";
}

TEST(Threads, StopAtAnExactNumberOfEvents) {
  const Scene scene = plain_gas(4000, 0.5, Boundary::walls);
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads({.domains = 3});
  for (const std::uint64_t events : {10U, 30000U}) {
    EXPECT_EQ(alone.run_until(1e6, {.events = events}), StopReason::events);
    EXPECT_EQ(shared.run_until(1e6, {.events = events}), StopReason::events);
    expect_same(alone, shared, std::to_string(events) + " events");
  }
}

TEST(Threads, CountWhatTheyTookThroughChanges) {
  Scene scene = plain_gas(4000, 0.5, Boundary::walls);
  Simulation shared = make_simulation(scene);
  shared.set_threads({.threads = 2, .domains = 4});
  shared.run_until(1.0);
  const ThreadCounts before = shared.thread_counts();
  EXPECT_GT(before.windows, 2U);
  scene.effects.collision.restitution = 0.9;
  shared.set_effects(scene.effects);
  EXPECT_EQ(shared.thread_counts().windows, before.windows);
  shared.run_until(2.0);
  const ThreadCounts after = shared.thread_counts();
  EXPECT_GT(after.windows, before.windows + 2U);
  EXPECT_EQ(after.shared_out, before.shared_out + 1U);
  EXPECT_EQ(after.threads, 2U);
  EXPECT_EQ(after.domains, 4U);
  scene.effects.drag = Drag{.rate = 0.01};  // one core computes from now on
  scene.effects.collision.restitution.reset();
  shared.set_effects(scene.effects);
  const std::uint64_t events = all_events(shared);
  shared.run_until(2.5);
  EXPECT_EQ(shared.thread_counts().windows, after.windows);
  EXPECT_EQ(shared.thread_counts().events_alone, after.events_alone + all_events(shared) - events);
  scene.effects.drag.reset();
  shared.set_effects(scene.effects);
  EXPECT_EQ(shared.thread_counts().events_alone, after.events_alone + all_events(shared) - events);
  EXPECT_EQ(shared.thread_counts().domains, 4U);
  shared.set_threads({});
  EXPECT_EQ(shared.thread_counts().domains, 1U) << "they are those since set_threads()";
}

/// While shear acts one core computes all: what is left of the equilibration, and the run until it stops.
TEST(Threads, CountWhatOneCoreComputesInARunThatGoesOnWhileItEquilibrates) {
  Scene scene = plain_gas(4000, 0.5, Boundary::periodic);
  scene.effects.shear = Shear{.rate = 0.01};
  scene.changes = {{0.5, SetKeys{{"shear.rate=0"}}}};
  scene.run.equilibrate = Run::Equilibrate{.collisions_per_disk = 8.0};
  scene.run.time = 1.0;
  Simulation stopped = make_simulation(scene), equilibrated = make_simulation(scene);
  equilibrated.run_until(1e6, {.collisions = 16'000});
  std::stringstream of_simulation, of_schedule;
  std::uint64_t saved_at = 0;
  RunHooks hooks;
  hooks.checkpoint = [&](const SavingMoment& moment) {
    if (all_events(stopped) == 0) return;
    ASSERT_TRUE(moment.progress.equilibrating);
    stopped.save(of_simulation);
    moment.save(of_schedule);
    saved_at = all_events(stopped);
    throw 0;
  };
  EXPECT_THROW(run_schedule(stopped, hooks), int);
  ASSERT_GT(saved_at, 0U);
  Simulation resumed = restore_simulation(scene, of_simulation);
  resumed.set_threads({.domains = 4});
  hooks = {};
  hooks.resume = &of_schedule;
  int left = 1000;
  hooks.stop_when = [&](const Event&) { return --left == 0; };
  EXPECT_EQ(run_schedule(resumed, hooks).stopped, StopReason::condition);
  const ThreadCounts counts = resumed.thread_counts();
  EXPECT_EQ(counts.events, 0U);
  EXPECT_EQ(counts.events_alone, all_events(equilibrated) - saved_at + all_events(resumed));
}

}  // namespace
}  // namespace carom::test
