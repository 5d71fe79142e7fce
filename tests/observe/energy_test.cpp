// Energy beyond that of flight, by its definitions.

#include "observe/energy.hpp"

#include "observe/unequal_pair.hpp"

#include <gtest/gtest.h>

namespace carom::test {
namespace {

TEST(Energy, SmoothDisksHaveKineticEnergyAloneToTheLastBit) {
  const Energies energies = energies_of(unequal_pair.box, Effects{}, unequal_pair.disks, unequal_pair.state);
  EXPECT_EQ(energies.total(), energies.kinetic);
  EXPECT_EQ(energies.kinetic, 23.5);
  EXPECT_FALSE(has_more_than_kinetic_energy(Effects{}));
}

TEST(Energy, EffectsAtTheirNeutralValuesAddNothing) {
  Effects neutral;
  neutral.collision.roughness = -1.0;
  neutral.gravity = Gravity{};
  neutral.square_well = SquareWell{.width = 1.5, .depth = 0.0};
  State state = unequal_pair.state;
  state.bonds = 7;
  EXPECT_EQ(total_energy(unequal_pair.box, neutral, unequal_pair.disks, state), 23.5);
}

TEST(Energy, ASpinningDiskIsUniform) {
  State state = unequal_pair.state;
  state.spins.resize(2);
  state.spins << 4.0, -2.0;
  // I = m r^2 / 2 is 1/4 and 1/2: 2 + 1
  EXPECT_EQ(spin_energy(unequal_pair.disks, state), 3.0);
  state.scale = 2.0;
  EXPECT_EQ(spin_energy(unequal_pair.disks, state), 12.0);
}

TEST(Energy, HeightsAreAboveTheSideToWhichGravityPoints) {
  Effects effects;
  effects.gravity = Gravity{.acceleration = {0.0, -3.0}};
  EXPECT_EQ(potential_energy(unequal_pair.box, effects, unequal_pair.disks, unequal_pair.state), 3.0 * (2.0 * 1.0 + 4.0 * 7.0));
  effects.gravity->acceleration = {2.0, 0.0};
  EXPECT_EQ(potential_energy(unequal_pair.box, effects, unequal_pair.disks, unequal_pair.state), 2.0 * (2.0 * 9.0 + 4.0 * 5.0));
}

TEST(Energy, FallingDisksKeepTheirTotal) {
  Effects effects;
  effects.gravity = Gravity{.acceleration = {0.5, -0.25}};
  State later = unequal_pair.state;
  const double t = 0.5;
  for (Eigen::Index i = 0; i < 2; ++i) {
    later.positions.col(i) += unequal_pair.state.velocities.col(i) * t + 0.5 * t * t * effects.gravity->acceleration;
    later.velocities.col(i) += t * effects.gravity->acceleration;
  }
  EXPECT_EQ(total_energy(unequal_pair.box, effects, unequal_pair.disks, later),
            total_energy(unequal_pair.box, effects, unequal_pair.disks, unequal_pair.state));
}

TEST(Energy, EveryBondIsWorthTheDepthOfTheWell) {
  Effects effects;
  effects.square_well = SquareWell{.width = 1.5, .depth = 2.0};
  State state = unequal_pair.state;
  state.bonds = 3;
  EXPECT_EQ(potential_energy(unequal_pair.box, effects, unequal_pair.disks, state), -6.0);
  effects.square_well->depth = -1.0;  // a shoulder
  EXPECT_EQ(potential_energy(unequal_pair.box, effects, unequal_pair.disks, state), 3.0);
}

TEST(Energy, ALoadHoldsTheWorkThatThePistonDidAgainstIt) {
  Effects effects;
  effects.walls[1].mass = 8.0;   // right
  effects.walls[1].load = 0.25;  // force 2.5 over the length 10
  effects.walls[2].mass = 2.0;   // bottom, without load
  State state = unequal_pair.state;
  EXPECT_EQ(potential_energy(unequal_pair.box, effects, unequal_pair.disks, state), 0.0);
  EXPECT_EQ(piston_energy(effects, state), 0.0);
  state.walls = {{0.0, 0.0}, {10.5, 0.5}, {-1.0, 3.0}, {10.0, 0.0}};
  EXPECT_EQ(potential_energy(unequal_pair.box, effects, unequal_pair.disks, state), 1.25);
  EXPECT_EQ(piston_energy(effects, state), 1.0 + 9.0);
  effects.walls[2].load = 0.5;
  EXPECT_EQ(potential_energy(unequal_pair.box, effects, unequal_pair.disks, state), 1.25 + 5.0)
      << "outward is down at the bottom";
}

TEST(Energy, AWallOfGivenVelocityHoldsNone) {
  Effects effects;
  effects.walls[0].velocity = 1.0;
  State state = unequal_pair.state;
  state.walls = {{1.0, 1.0}, {10.0, 0.0}, {0.0, 0.0}, {10.0, 0.0}};
  EXPECT_EQ(total_energy(unequal_pair.box, effects, unequal_pair.disks, state), 23.5);
  EXPECT_FALSE(has_more_than_kinetic_energy(effects));
}

}  // namespace
}  // namespace carom::test
