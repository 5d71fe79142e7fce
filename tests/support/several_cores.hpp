#pragma once
// What a run on several cores or processes is held against: the same run on one.

#include "core/all_events.hpp"
#include "support/same_events.hpp"
#include "support/same_totals.hpp"
#include "support/systems.hpp"

#include <carom/simulation.hpp>

#include <gtest/gtest.h>

#include <array>
#include <span>
#include <sstream>
#include <string>
#include <vector>

namespace carom::test {

inline Scene plain_gas(std::int64_t disks, double packing_fraction, Boundary boundary,
                       CollisionRule rule = CollisionRule::specular) {
  Scene scene = gas_scene(disks, packing_fraction, boundary);
  scene.effects.collision.rule = rule;
  return scene;
}

/// Disks of two sizes in a gas, one of them as heavy as it is large.
inline Scene mixture(std::int64_t disks) {
  Scene scene = plain_gas(disks, 0.3, Boundary::walls);
  scene.box.upper *= 1.5;
  scene.species[0].positions = RandomPositions{};
  Species large = scene.species[0];
  large.name = "large";
  large.count = disks / 20;
  large.radius = 1.3;
  large.mass = 7.0;
  scene.species.insert(scene.species.begin(), large);
  return scene;
}

inline std::uint64_t all_events(const Simulation& simulation) { return detail::all_events(simulation.counts()); }

/// What must be the same: state, clock, and everything that has been counted.
inline void expect_same(const Simulation& alone, const Simulation& shared, const std::string& where) {
  EXPECT_EQ(state_hash(shared.state()), state_hash(alone.state())) << where;
  EXPECT_EQ(different_totals_of_cores(alone.totals(), shared.totals()), "") << where;
  EXPECT_EQ(shared.state().bonds, alone.state().bonds) << where;
  EXPECT_EQ(shared.counts().pair, alone.totals().pair) << where;
  EXPECT_EQ(shared.time(), alone.time()) << where;
}

inline void expect_same_runs(const Scene& scene, const Threads& threads, double time, int stops) {
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads(threads);
  for (int k = 1; k <= stops; ++k) {
    alone.run_until(time * k / stops);
    EXPECT_EQ(shared.run_until(time * k / stops), StopReason::time);
    expect_same(alone, shared, "stop " + std::to_string(k));
  }
  EXPECT_TRUE(shared.check_invariants().empty());
  EXPECT_GT(shared.thread_counts().windows, 10U);
  EXPECT_LT(shared.thread_counts().windows_redone, shared.thread_counts().windows / 4);
}

/// Compares a scene that is shared out with one core at these times. Returns what sharing it out took.
inline ThreadCounts expect_same_at(const std::vector<double>& times, const Scene& scene, const Threads& threads) {
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads(threads);
  for (const double time : times) {
    alone.run_until(time);
    shared.run_until(time);
    expect_same(alone, shared, "time " + std::to_string(time));
  }
  return shared.thread_counts();
}

/// The events of a whole run, as run_schedule() tells them.
inline std::vector<Event> told_events(Simulation& simulation) {
  std::vector<Event> told;
  RunHooks hooks;
  hooks.events = [&](std::span<const Event> events) { told.insert(told.end(), events.begin(), events.end()); };
  run_schedule(simulation, hooks);
  return told;
}

inline std::vector<Event> told_events(const Scene& scene, const Threads& threads) {
  Simulation simulation = make_simulation(scene);
  simulation.set_threads(threads);
  return told_events(simulation);
}

/// The collisions of a whole run, as run_schedule() tells them to those who follow disks: the time, the slots, and the
/// velocities.
inline std::vector<std::array<double, 11>> told_records(Simulation& simulation) {
  std::vector<std::array<double, 11>> told;
  RunHooks hooks;
  hooks.collisions = [&](const CollisionRecords& collisions) {
    for (const CollisionRecord& r : collisions.records)
      told.push_back({collisions.epoch + r.time, static_cast<double>(r.slot_i), static_cast<double>(r.slot_j), r.before_i[0],
                      r.before_i[1], r.before_j[0], r.before_j[1], r.after_i[0], r.after_i[1], r.after_j[0], r.after_j[1]});
  };
  run_schedule(simulation, hooks);
  return told;
}

/// Compares a run that four domains have until `first`, one core until `second`, and three domains until `end`, each from what
/// the one before has saved, with one that one core has all along.
inline void expect_same_after_saves(const Scene& scene, double first, double second, double end) {
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads({.domains = 4});
  alone.run_until(end);
  shared.run_until(first);
  std::stringstream saved;
  shared.save(saved);
  Simulation one = restore_simulation(scene, saved);
  one.run_until(second);
  std::stringstream again;
  one.save(again);
  Simulation three = restore_simulation(scene, again);
  three.set_threads({.domains = 3});
  three.run_until(end);
  expect_same(alone, three, "resumed");
}

}  // namespace carom::test
