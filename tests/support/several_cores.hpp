#pragma once
// What a run on several cores or processes is held against: the same run on one.

#include "support/systems.hpp"

#include <carom/simulation.hpp>

#include <gtest/gtest.h>

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

/// What must be the same: state, clock, and everything that has been counted.
inline void expect_same(const Simulation& alone, const Simulation& shared, const std::string& where) {
  EXPECT_EQ(state_hash(shared.state()), state_hash(alone.state())) << where;
  const Totals a = alone.totals(), b = shared.totals();
  EXPECT_EQ(b.pair, a.pair) << where;
  EXPECT_EQ(b.wall, a.wall) << where;
  EXPECT_EQ(b.other, a.other) << where;
  EXPECT_EQ(b.stale, a.stale) << where;
  EXPECT_EQ(b.virial, a.virial) << where;
  EXPECT_EQ(b.obstacle, a.obstacle) << where;
  EXPECT_EQ(b.wall_impulse, a.wall_impulse) << where;
  EXPECT_EQ(b.wall_energy, a.wall_energy) << where;
  EXPECT_EQ(b.obstacle_impulse, a.obstacle_impulse) << where;
  EXPECT_EQ(b.dissipated, a.dissipated) << where;
  EXPECT_EQ(b.growth_energy, a.growth_energy) << where;
  EXPECT_EQ(b.thermostat, a.thermostat) << where;
  EXPECT_EQ(b.thermostat_energy, a.thermostat_energy) << where;
  EXPECT_EQ(b.well, a.well) << where;
  EXPECT_EQ(shared.state().bonds, alone.state().bonds) << where;
  EXPECT_EQ(b.numerics.epochs, a.numerics.epochs) << where;
  EXPECT_EQ(b.numerics.list_rebuilds, a.numerics.list_rebuilds) << where;
  EXPECT_EQ(b.numerics.longest_neighbour_list, a.numerics.longest_neighbour_list) << where;
  EXPECT_EQ(b.numerics.deepest_overlap, a.numerics.deepest_overlap) << where;
  EXPECT_EQ(shared.counts().pair, a.pair) << where;
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

/// The log of a run, with time, disk, partner and a number of velocities of each event.
inline std::vector<double> told_events(const Scene& scene, const Threads& threads) {
  std::vector<double> told;
  Simulation simulation = make_simulation(scene);
  simulation.set_threads(threads);
  RunHooks hooks;
  hooks.events = [&](std::span<const Event> events) {
    for (const Event& event : events) {
      told.push_back(event.time);
      told.push_back(event.disk);
      told.push_back(event.partner);
      told.push_back(event.velocity[0] - event.partner_velocity[1]);
    }
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
