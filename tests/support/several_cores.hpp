#pragma once
// What a run on several cores or processes is held against: the same run on one.

#include "support/systems.hpp"

#include <carom/simulation.hpp>

#include <gtest/gtest.h>

#include <string>

namespace carom::test {

inline Scene lean_gas(std::int64_t disks, double packing_fraction, Boundary boundary,
                      CollisionRule rule = CollisionRule::specular) {
  Scene scene = gas_scene(disks, packing_fraction, boundary);
  scene.effects.collision.rule = rule;
  return scene;
}

/// Disks of two sizes in a gas, one of them as heavy as it is large.
inline Scene mixture(std::int64_t disks) {
  Scene scene = lean_gas(disks, 0.3, Boundary::walls);
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

}  // namespace carom::test
