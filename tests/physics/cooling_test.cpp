// How inelastic and rough gases share out and lose their energy.

#include "observe/energy.hpp"
#include "observe/mechanics.hpp"
#include "support/block_means.hpp"
#include "support/effect_scenes.hpp"
#include "theory/kinetic.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace carom::test {
namespace {

/// Disks at equilibrium at kT = 1, which then begin to lose energy.
Simulation cooling(double packing_fraction, double restitution, std::uint64_t seed, int disks = 4900) {
  Scene scene = gas_scene(disks, packing_fraction, Boundary::periodic, seed);
  Simulation elastic = make_simulation(scene);
  elastic.run_until(1e9, {.collisions = static_cast<std::uint64_t>(disks) * 10});
  scene.effects.collision.restitution = restitution;
  return make_simulation(scene, elastic.state());
}

double temperature(const Simulation& simulation) {
  return kinetic_temperature(simulation.scene().box, simulation.disks(), simulation.state());
}

/// 1 / t_H over what theory::haff_rate expects, from 0 to `time`: the mean over so many starts, and its standard error.
BlockMeans haff_ratio(int disks, double e, int starts, double time) {
  constexpr double eta = 0.1;
  const double rate = theory::haff_rate(e, eta, disks);
  BlockMeans mean(1);
  for (int k = 1; k <= starts; ++k) {
    Simulation gas = cooling(eta, e, static_cast<std::uint64_t>(k), disks);
    const double start = temperature(gas);
    gas.run_until(time);
    mean.add((std::sqrt(start / temperature(gas)) - 1) / (time * std::sqrt(start) * rate));
  }
  return mean;
}

TEST(PhysicsCooling, OfFewDisksFollowsHaffsLaw) {
  for (const double time : {50.0, 250.0}) {
    const BlockMeans ratio = haff_ratio(256, 0.98, 150, time);
    RecordProperty((testing::Message() << "t_" << time).GetString(), testing::PrintToString(ratio.mean()));
    EXPECT_NEAR(ratio.mean(), 1.0, 5 * ratio.error() + theory::haff_slowing(0.98, 0.1, 256)) << "t = " << time;
    EXPECT_LT(ratio.error(), 0.005) << "an error so large that it would hide everything";
  }
}

TEST(PhysicsCooling, OfManyDisksLeavesHaffsLawAsShearWavesGrow) {
  const BlockMeans ratio = haff_ratio(4900, 0.95, 8, 1000.0);
  RecordProperty("ratio", testing::PrintToString(ratio.mean()));
  EXPECT_LT(ratio.mean(), 1.0 - 5 * ratio.error() - 0.003);
}

TEST(PhysicsCooling, LosesTheSameShareOfItsHeatWithEveryCollision) {
  // d ln T / d tau = -(1 - e^2) / 2, tau the collisions per disk, times 1 + a2 / 4, where a2 = 16 (1 - e) (1 - 2 e^2) /
  // (57 - 25 e + 30 (1 - e) e^2) = -0.019 tells how far velocities are from Maxwell's (van Noije & Ernst, Granular Matter 1, 57
  // (1998)). What a collision takes is as uncertain as it is large: 5 standard errors of 10 times 24500 collisions are 1 %. Ten
  // collisions per disk are too few for the disks to have found their way into streams, in which they collide less hard.
  constexpr double e = 0.95;
  constexpr double a2 = 16 * (1 - e) * (1 - 2 * e * e) / (57 - 25 * e + 30 * (1 - e) * e * e);
  double ratio = 0.0, collisions = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Simulation gas = cooling(0.1, e, seed);
    const double start = temperature(gas);
    gas.run_until(1e9, {.collisions = 4900 * 5});
    const auto pairs = static_cast<double>(gas.totals().pair);
    ratio += std::log(start / temperature(gas)) / (2 * pairs / 4900) / ((1 - e * e) / 2) / 10;
    collisions += pairs;
  }
  RecordProperty("ratio", testing::PrintToString(ratio));
  EXPECT_NEAR(ratio, 1 + a2 / 4, 5 / std::sqrt(collisions));
}

TEST(PhysicsRoughDisks, GiveSpinItsShare) {
  // kT of the spins, I <w^2>, and of translation agree within 5 standard errors of the samples; both are 2 E / (3 N - 2).
  Scene scene = gas_scene(256, 0.3, Boundary::periodic);
  scene.effects.collision.roughness = 1.0;
  Simulation gas = make_simulation(scene);
  gas.run_until(1e9, {.collisions = 256 * 50});
  gas.reset_clock();
  BlockMeans spin(50), translation(50);
  for (int k = 1; k <= 2000; ++k) {
    gas.run_until(k * 1.0);
    spin.add(spin_temperature(gas.disks(), gas.state()));
    translation.add(temperature(gas));
  }
  const double shared = 2 * 255.0 / (3 * 256 - 2);
  RecordProperty("spin", testing::PrintToString(spin.mean()));
  RecordProperty("translation", testing::PrintToString(translation.mean()));
  EXPECT_NEAR(spin.mean(), shared, 5 * spin.error());
  EXPECT_NEAR(translation.mean(), shared, 5 * translation.error());
  EXPECT_LT(spin.error(), 0.003 * shared) << "an error so large that it would hide everything";
}

TEST(PhysicsGranular, ADenseGasWithTheTcModelGoesOnWhereItWouldCollapse) {
  // About every second start collapses, by the last digits of its positions.
  Scene scene;
  StopReason without = StopReason::time;
  for (std::uint64_t seed = 1; seed <= 10 && without != StopReason::collapsed; ++seed) {
    scene = gas_scene(100, 0.7, Boundary::periodic, seed);
    scene.effects.collision.restitution = 0.3;
    without = make_simulation(scene).run_until(200.0);
  }
  ASSERT_EQ(without, StopReason::collapsed);
  scene.effects.collision.elastic_below = 1e-3;
  Simulation with = make_simulation(scene);
  EXPECT_EQ(with.run_until(200.0), StopReason::time);
  EXPECT_EQ(with.time(), 200.0);
  EXPECT_TRUE(with.check_invariants().empty());
}

}  // namespace
}  // namespace carom::test
