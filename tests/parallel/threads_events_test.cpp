// Collisions and events that are told of a run on several cores, in the order of one.

#include "support/same_events.hpp"
#include "support/several_cores.hpp"

#include <carom/simulation.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom::test {
namespace {

/// The log is taken once, when windows have been void, right and void again.
TEST(Threads, LogTheEventsOfOneAfterWindowsThatWereVoid) {
  const Scene scene = plain_gas(4000, 0.5, Boundary::periodic);
  std::uint64_t redone = 0;
  const auto logged = [&](const Threads& threads) {
    Simulation simulation = make_simulation(scene);
    simulation.set_threads(threads);
    simulation.record_events(true);
    simulation.run_until(6.0);
    redone += simulation.thread_counts().windows_redone;
    return simulation.take_events();
  };
  const auto alone = logged({});
  for (const double halo : {4.0, 5.0, 6.0})
    EXPECT_TRUE(same_events(logged({.domains = 4, .halo = halo, .events_per_window = 0.3}), alone)) << halo;
  EXPECT_GT(redone, 4U);
}

/// Every collision, told as run_schedule() tells them: as records with their epochs, and as events.
struct Told {
  std::vector<std::array<double, 11>> records;
  std::vector<Event> events;
};

Told told(const Scene& scene, const Threads& threads, std::uint64_t& redone) {
  Simulation simulation = make_simulation(scene);
  simulation.set_threads(threads);
  Told told{told_records(simulation), told_events(scene, threads)};
  redone = simulation.thread_counts().windows_redone;
  if (threads.domains > 1) {
    EXPECT_GT(simulation.thread_counts().windows, 2U);
  }
  return told;
}

TEST(Threads, TellTheCollisionsOfOneInTheirOrder) {
  Scene scene = plain_gas(4000, 0.5, Boundary::walls);
  scene.run.time = 3.0;
  scene.run.sample_every = 0.5;
  std::uint64_t redone = 0;
  const Told alone = told(scene, {}, redone);
  EXPECT_GT(alone.records.size(), 20000U);
  const Told shared = told(scene, {.threads = 2, .domains = 4}, redone);
  EXPECT_EQ(shared.records, alone.records);
  EXPECT_TRUE(same_events(shared.events, alone.events));
  const Told narrow = told(scene, {.domains = 4, .halo = 5.0, .events_per_window = 2.0}, redone);
  EXPECT_GT(redone, 0U) << "collisions are to happen twice, and to be told once";
  EXPECT_EQ(narrow.records, alone.records);
  EXPECT_TRUE(same_events(narrow.events, alone.events));
}

/// Rough disks that lose all of their speed towards each other but for its rounding collide again at once, by the plan of the one
/// and then of the other, which may be at home in two domains, and with a third disk in between.
TEST(Threads, TellTheCollisionsOfOneInstantInTheirOrder) {
  Scene scene = mixture(300);
  scene.effects.collision.restitution = 0.0;
  scene.effects.collision.roughness = 1.0;
  scene.run.time = 6.0;
  const std::vector<Event> alone = told_events(scene, {});
  std::size_t at_once = 0;
  for (std::size_t k = 1; k < alone.size(); ++k) {
    const Event &event = alone[k], &before = alone[k - 1];
    at_once += event.time == before.time && event.disk == before.disk && event.partner == before.partner ? 1U : 0U;
  }
  EXPECT_GT(at_once, 20U);
  for (const std::size_t domains : {2U, 3U, 5U, 8U, 13U})
    EXPECT_TRUE(same_events(told_events(scene, {.domains = domains}), alone)) << domains;
}

/// Disks of a lattice that meet many others at the same time and lose all of their speed towards each other.
TEST(Threads, HandOnTheRecordsOfOneInstantInTheirOrder) {
  Scene scene = plain_gas(144, 0.1, Boundary::walls);
  scene.box = {{0.0, 0.0}, {12.0, 12.0}, {Boundary::walls, Boundary::walls}};
  ListedPositions positions;
  ListedVelocities velocities;
  std::uint64_t draw = 1;
  for (int k = 0; k < 144; ++k) {
    draw = 6364136223846793005U * draw + 1442695040888963407U;
    positions.values.emplace_back(0.5 + k / 12, 0.5 + k % 12);
    velocities.values.emplace_back((draw >> 40) % 2 == 0 ? 0.5 : -0.5, (draw >> 50) % 2 == 0 ? 0.5 : -0.5);
  }
  Species& species = scene.species.front();
  species.radius = 0.25;
  species.positions = positions;
  species.velocities = velocities;
  scene.effects.collision.restitution = 0.0;
  scene.run.time = 2.0;
  scene.run.sample_every = 0.25;
  std::uint64_t redone = 0;
  const Told alone = told(scene, {}, redone);
  for (const std::size_t domains : {2U, 3U, 5U}) {
    const Told shared = told(scene, {.domains = domains}, redone);
    EXPECT_EQ(shared.records, alone.records) << domains;
    EXPECT_TRUE(same_events(shared.events, alone.events)) << domains;
  }
}

}  // namespace
}  // namespace carom::test
