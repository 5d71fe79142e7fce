// Energy, momentum and temperature by their definitions.

#include "observe/mechanics.hpp"
#include "observe/unequal_pair.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace carom::test {
namespace {

TEST(Mechanics, EnergyAndMomentumAreTheirSums) {
  EXPECT_EQ(kinetic_energy(unequal_pair.disks, unequal_pair.state), 5.0 + 18.5);
  EXPECT_EQ(total_momentum(unequal_pair.disks, unequal_pair.state), Eigen::Vector2d(-10.0, 6.0));
}

TEST(Mechanics, TemperatureLeavesOutTheMotionThatPeriodicAxesKeep) {
  Box box = square_box(10.0, Boundary::walls);
  EXPECT_EQ(kinetic_temperature(box, unequal_pair.disks, unequal_pair.state), 23.5 / 2.0);  // K / N
  // P^2 / 2M = 100/12 along x, 36/12 along y.
  box.boundary = {Boundary::periodic, Boundary::walls};
  EXPECT_DOUBLE_EQ(kinetic_temperature(box, unequal_pair.disks, unequal_pair.state), 2.0 * (23.5 - 100.0 / 12.0) / 3.0);
  box.boundary = {Boundary::walls, Boundary::periodic};
  EXPECT_DOUBLE_EQ(kinetic_temperature(box, unequal_pair.disks, unequal_pair.state), 2.0 * (23.5 - 3.0) / 3.0);
  box.boundary = {Boundary::periodic, Boundary::periodic};
  EXPECT_DOUBLE_EQ(kinetic_temperature(box, unequal_pair.disks, unequal_pair.state), 23.5 - 136.0 / 12.0);  // K' / (N - 1)
}

TEST(Mechanics, TemperatureDoesNotKnowTheFrameOfAPeriodicBox) {
  const Box box = square_box(10.0, Boundary::periodic);
  State moving = unequal_pair.state;
  moving.velocities.colwise() += Eigen::Vector2d(16.0, -8.0);
  EXPECT_NEAR(kinetic_temperature(box, unequal_pair.disks, moving),
              kinetic_temperature(box, unequal_pair.disks, unequal_pair.state), 1e-12);
}

TEST(Mechanics, WithoutEffectsTheTemperatureIsTheSameToTheLastBit) {
  for (const Boundary boundary : {Boundary::walls, Boundary::periodic}) {
    const Box box = square_box(10.0, boundary);
    EXPECT_EQ(kinetic_temperature(box, Effects{}, unequal_pair.disks, unequal_pair.state),
              kinetic_temperature(box, unequal_pair.disks, unequal_pair.state));
  }
}

TEST(Mechanics, CommonMotionIsHeatWhereMoreThanDisksPushesDisks) {
  const Box box = square_box(10.0, Boundary::periodic);
  Effects effects;
  effects.thermostat = Thermostat{.temperature = 1.0, .rate = 0.0};
  EXPECT_EQ(kinetic_temperature(box, effects, unequal_pair.disks, unequal_pair.state),
            kinetic_temperature(box, unequal_pair.disks, unequal_pair.state));
  effects.thermostat->rate = 0.1;
  EXPECT_EQ(kinetic_temperature(box, effects, unequal_pair.disks, unequal_pair.state), 23.5 / 2.0);
  Effects pushed;
  pushed.obstacles.emplace_back();
  EXPECT_EQ(kinetic_temperature(box, pushed, unequal_pair.disks, unequal_pair.state), 23.5 / 2.0);
  Box channel = box;
  channel.boundary[1] = Boundary::walls;
  Effects warm;
  warm.walls[3].temperature = 1.0;
  EXPECT_EQ(kinetic_temperature(channel, warm, unequal_pair.disks, unequal_pair.state), 23.5 / 2.0);
}

TEST(Mechanics, TheFlowOfShearIsNoHeat) {
  const Box box = square_box(10.0, Boundary::periodic);
  System flowing = unequal_pair;
  Effects effects;
  effects.shear = Shear{.rate = 0.25};
  const double at_rest = kinetic_temperature(box, flowing.disks, flowing.state);
  flowing.state.velocities.row(0) += 0.25 * flowing.state.positions.row(1);
  EXPECT_NEAR(kinetic_temperature(box, effects, flowing.disks, flowing.state), at_rest, 1e-13);
}

TEST(Mechanics, MomentumFlowIsTakenInTheFrameOfTheFlow) {
  const Box box = square_box(10.0, Boundary::periodic);
  Effects effects;
  effects.shear = Shear{.rate = 0.5};
  System flowing = system_of(box, {{{1, 2}, {1.0, 2.0}, 0.5, 3.0}, {{5, 6}, {-1.0, -2.0}, 0.5, 3.0}});
  flowing.state.velocities.row(0) += 0.5 * flowing.state.positions.row(1);
  EXPECT_NEAR(momentum_flow_xy(box, effects, flowing.disks, flowing.state), 12.0, 1e-13);
}

TEST(Mechanics, CommonMotionRelativeToTheFlowIsHeatWhereAThermostatPushes) {
  const Box box{{0.0, 0.0}, {10.0, 10.0}, {Boundary::periodic, Boundary::periodic}};
  Effects effects;
  effects.shear = Shear{.rate = 0.5};
  System drifting = system_of(box, {{{1, 2}, {1.0, 2.0}, 0.5, 3.0}, {{5, 6}, {1.0, 2.0}, 0.5, 3.0}});
  drifting.state.velocities.row(0).array() += 0.5 * (drifting.state.positions.row(1).array() - 5.0);
  EXPECT_NEAR(kinetic_temperature(box, effects, drifting.disks, drifting.state), 0.0, 1e-13);
  effects.thermostat = Thermostat{.temperature = 1.0, .rate = 0.1};
  // 2 disks of 3 (1 + 4) / 2 each, for 4 degrees of freedom.
  EXPECT_NEAR(kinetic_temperature(box, effects, drifting.disks, drifting.state), 7.5, 1e-13);
  EXPECT_NEAR(momentum_flow_xy(box, effects, drifting.disks, drifting.state), 12.0, 1e-13);
}

TEST(Mechanics, SpinsHaveATemperatureOfTheirOwn) {
  State state = unequal_pair.state;
  EXPECT_EQ(spin_temperature(unequal_pair.disks, state), 0.0);
  state.spins.resize(2);
  state.spins << 4.0, -2.0;
  EXPECT_EQ(spin_temperature(unequal_pair.disks, state), 3.0);  // 2 (2 + 1) / 2
  EXPECT_EQ(spin_temperature(Disks{}, State{}), 0.0);
}

TEST(Mechanics, NothingHasNoTemperature) {
  for (const Boundary boundary : {Boundary::walls, Boundary::periodic}) {
    const System none = system_of(square_box(1.0, boundary), {});
    EXPECT_EQ(kinetic_energy(none.disks, none.state), 0.0);
    EXPECT_EQ(total_momentum(none.disks, none.state), Eigen::Vector2d(0.0, 0.0));
    EXPECT_EQ(kinetic_temperature(none.box, none.disks, none.state), 0.0);
  }
  const System one = system_of(square_box(1.0, Boundary::periodic), {{{0.5, 0.5}, {3.0, 0.1}, 0.1, 7.0}});
  EXPECT_EQ(kinetic_temperature(one.box, one.disks, one.state), 0.0);
}

TEST(Mechanics, SumsOverManyDisksKeepTheirLastDigits) {
  // 1e6 energies of 5e-9 after one of 5e7, whose ulp is 7e-9 in double precision: each would be rounded to that, 2.5e-3
  // in all. In extended precision the ulp is 4e-12, and half of it 1e6 times is 2e-6.
  const std::size_t n = 1'000'000;
  System system = system_of(square_box(1.0, Boundary::walls), {});
  system.disks.mass.assign(n + 1, 1.0);
  system.disks.radius.assign(n + 1, 1e-9);
  system.disks.species.assign(n + 1, 0);
  system.state.velocities = Eigen::Matrix2Xd::Zero(2, static_cast<Eigen::Index>(n + 1));
  system.state.velocities.row(1).setConstant(1e-4);
  system.state.velocities.col(0) << 1e4, 0.0;
  EXPECT_NEAR(kinetic_energy(system.disks, system.state), 5e7 + 5e-3, 2e-6);
}

}  // namespace
}  // namespace carom::test
