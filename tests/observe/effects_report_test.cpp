// What the totals of a run say of its effects.

#include "observe/effects_report.hpp"

#include "io/hand_made_run.hpp"
#include "observe/run_report.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace carom::test {
namespace {

/// Walls at the bottom and the top, 4 long and 2.5 apart, and periodic edges along x.
class EffectsOfARun : public ::testing::Test {
 protected:
  EffectsOfARun() {
    end_.time = 5.0;
    totals_.wall_impulse = {0.0, 0.0, 40.0, 60.0};
    totals_.wall_energy = {0.0, 0.0, 3.0, -1.0};
    totals_.dissipated = 0.5;
    totals_.thermostat = 7;
    totals_.thermostat_energy = 10.0;
    totals_.growth_energy = 20.0;
    totals_.shear_energy = 30.0;
    totals_.virial_yx = -25.0;
    totals_.obstacle = 4;
    totals_.obstacle_impulse = {1.5, -2.0};
  }
  [[nodiscard]] EffectsReport report() const { return effects_report(scene_, test::hand_made_disks(scene_), totals_, end_); }

  Scene scene_ = scene_of(2, 2);
  Totals totals_;
  State end_ = state_at(0, scene_);
};

TEST_F(EffectsOfARun, WithoutEffectsThereAreOnlyTheWalls) {
  const EffectsReport r = report();
  ASSERT_EQ(r.walls.size(), 2u);
  EXPECT_EQ(r.walls[0].name, "bottom");
  EXPECT_EQ(r.walls[1].name, "top");
  EXPECT_EQ(r.walls[0].momentum, 40.0);
  EXPECT_EQ(r.walls[0].energy, 3.0);
  EXPECT_EQ(r.walls[0].force, 8.0);
  EXPECT_EQ(r.walls[0].pressure, 2.0);
  EXPECT_FALSE(r.walls[0].end);
  EXPECT_FALSE(r.packing_fraction_end || r.energies_end || r.dissipated || r.obstacles || r.thermostat || r.growth || r.shear ||
               r.bonds || r.energy_supplied);
}

TEST_F(EffectsOfARun, ThermalWallsTakeMomentumAlongThemselves) {
  scene_.effects.walls[3].temperature = 1.0;
  totals_.wall_shear = {0.0, 0.0, 0.0, -10.0};
  const EffectsReport r = report();
  EXPECT_EQ(r.walls[1].shear_momentum, -10.0);
  EXPECT_EQ(r.walls[1].shear_stress, -0.5);
  EXPECT_FALSE(r.walls[0].shear_momentum || r.walls[0].shear_stress);
}

TEST_F(EffectsOfARun, NoTimeGivesNoForce) {
  end_.time = 0.0;
  EXPECT_FALSE(report().walls[0].force || report().walls[0].pressure);
}

TEST_F(EffectsOfARun, APeriodicBoxHasNoWalls) {
  scene_.box.boundary[1] = Boundary::periodic;
  EXPECT_TRUE(report().walls.empty());
}

TEST_F(EffectsOfARun, AWallBetweenMovingWallsHasAForceAndNoPressure) {
  scene_.box.boundary[0] = Boundary::walls;
  scene_.effects.walls[3].velocity = 0.5;
  end_.walls = {{-1.0, 0.0}, {3.0, 0.0}, {10.0, 0.0}, {15.0, 0.5}};
  const EffectsReport r = report();
  ASSERT_EQ(r.walls.size(), 4u);
  EXPECT_TRUE(r.walls[0].force);
  EXPECT_FALSE(r.walls[0].pressure);
  EXPECT_EQ(r.walls[3].pressure, 3.0);
  ASSERT_TRUE(r.walls[3].end);
  EXPECT_EQ(r.walls[3].end->position, 15.0);
  EXPECT_FALSE(r.walls[2].end);
  ASSERT_TRUE(r.packing_fraction_end);
  EXPECT_DOUBLE_EQ(*r.packing_fraction_end, std::numbers::pi * 2.0 * (0.03 * 0.03 + 0.01 * 0.01) / 20.0);
}

TEST_F(EffectsOfARun, EachEffectTellsWhatItDid) {
  scene_.effects.collision.restitution = 0.9;
  scene_.effects.obstacles.emplace_back();
  scene_.effects.thermostat = Thermostat{.temperature = 1.0, .rate = 1.0};
  scene_.effects.growth = Growth{.rate = 0.1};
  scene_.effects.shear = Shear{.rate = 0.5};
  scene_.effects.square_well = SquareWell{.width = 1.5, .depth = 2.0};
  end_.scale = 1.5;
  end_.bonds = 3;
  const EffectsReport r = report();
  EXPECT_EQ(r.dissipated, 0.5);
  EXPECT_EQ(*r.obstacles, Eigen::Vector2d(1.5, -2.0));
  ASSERT_TRUE(r.thermostat && r.growth && r.shear && r.energies_end);
  EXPECT_EQ(r.thermostat->events, 7u);
  EXPECT_EQ(r.thermostat->energy, 10.0);
  EXPECT_EQ(r.growth->scale, 1.5);
  EXPECT_EQ(r.growth->energy, 20.0);
  EXPECT_DOUBLE_EQ(r.growth->packing_fraction, std::numbers::pi * 4.5 * (0.03 * 0.03 + 0.01 * 0.01) / 10.0);
  EXPECT_EQ(r.shear->strain, 2.5);
  EXPECT_EQ(r.shear->energy, 30.0);
  EXPECT_EQ(r.shear->pressure_xy_of_collisions, -0.5);  // over area 10 and time 5
  EXPECT_EQ(r.bonds, 3u);
  EXPECT_EQ(r.energies_end->potential, -6.0);
}

TEST_F(EffectsOfARun, EnergyGivenIsThatOfBathsLessWhatWasLost) {
  scene_.effects.collision.restitution = 0.9;
  EXPECT_EQ(report().energy_supplied, 10.0 + 20.0 + 30.0 - 0.5 - 3.0 + 1.0);
}

TEST_F(EffectsOfARun, WhatAPistonTakesStaysInTheTotal) {
  scene_.effects.walls[2].mass = 10.0;
  scene_.effects.walls[3].velocity = 0.5;
  EXPECT_EQ(report().energy_supplied, 10.0 + 20.0 + 30.0 - 0.5 + 1.0);
  scene_.effects.walls[2].restitution = 0.5;
  EXPECT_FALSE(report().energy_supplied) << "its loss and its work are one number";
  scene_.effects.walls[2].restitution = 1.0;
  EXPECT_EQ(report().energy_supplied, 10.0 + 20.0 + 30.0 - 0.5 + 1.0) << "it loses nothing";
}

TEST_F(EffectsOfARun, NeutralValuesTakeNothingFromTheReport) {
  scene_.box.boundary[0] = Boundary::walls;
  scene_.effects.growth = Growth{.rate = 0.1};
  const EffectsReport plain = report();
  ASSERT_TRUE(plain.energy_supplied && plain.walls[0].pressure);
  scene_.effects.collision.restitution = 1.0;
  scene_.effects.collision.roughness = -1.0;
  scene_.effects.walls[0].restitution = 1.0;
  scene_.effects.walls[3].velocity = 0.0;
  EXPECT_EQ(report().energy_supplied, plain.energy_supplied);
  scene_.effects.thermostat = Thermostat{1.0, 0.0};
  scene_.effects.brownian = Brownian{1.0, 0.0};
  EXPECT_EQ(report().energy_supplied, plain.energy_supplied);
  scene_.effects.brownian.reset();
  scene_.effects.thermostat = Thermostat{1.0, 1.0};
  EXPECT_FALSE(report().energy_supplied) << "it turns the disks, whose moment of inertia grows in flight";
  scene_.effects.thermostat.reset();
  EXPECT_TRUE(report().packing_fraction_end) << "a key is there where the scene names its effect";
  for (std::size_t side = 0; side < 4; ++side) EXPECT_EQ(report().walls[side].pressure, plain.walls[side].pressure) << side;
}

TEST_F(EffectsOfARun, AnEnergyChangeThatWasGivenIsExplained) {
  scene_.effects.thermostat = Thermostat{.temperature = 1.0, .rate = 1.0};
  RunReport r = hand_made_report(scene_);
  EXPECT_FALSE(r.unaccounted_energy_drift());
  r.of_effects.energy_supplied = 4.0;
  r.energy_initial = 16.0;
  r.energy_final = 20.0;
  EXPECT_EQ(r.relative_energy_drift(), 0.25);
  EXPECT_EQ(r.unaccounted_energy_drift(), 0.0);
  r.energy_final = 32.0;
  EXPECT_EQ(r.unaccounted_energy_drift(), 12.0 / 32.0);
}

TEST_F(EffectsOfARun, DriftIsRelativeToWhatMayCancel) {
  RunReport r = hand_made_report(scene_);
  r.energy_initial = 0.0;
  r.energy_final = 0.5;
  r.energy_scale = 8.0;  // such as 4 of kinetic energy and -4 in wells
  EXPECT_EQ(r.relative_energy_drift(), 0.0625);
}

}  // namespace
}  // namespace carom::test
