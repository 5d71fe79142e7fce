// What a whole run reports, on small gases.

#include "observe/run_measurements.hpp"
#include "observe/mechanics.hpp"
#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace carom::test {
namespace {

struct Measured {
  RunReport report;
  double virial_of_events = 0.0;
};

/// Runs a scene as the program does, and adds up the virial from the event log on the side.
Measured measure(const Scene& scene) {
  Measured measured;
  Simulation simulation = make_simulation(scene);
  Eigen::Matrix2Xd velocities;
  RunMeasurements measurements(simulation);
  RunHooks hooks;
  hooks.start = [&](const State& state) {
    measurements.start(state);
    velocities = state.velocities;
  };
  hooks.sample = [&](std::uint64_t, const State& state) { measurements.sample(state); };
  hooks.block = [&](const Progress& progress) { measurements.block(progress); };
  hooks.change = [&](bool made) { measurements.change(made); };
  hooks.events = [&](std::span<const Event> events) {
    for (const Event& event : events) {
      if (event.partner >= 0) {
        // Smooth disks push each other along the line of centres: sigma |dp|.
        const auto disk = static_cast<std::size_t>(event.disk);
        const auto partner = static_cast<std::size_t>(event.partner);
        const double impulse = simulation.disks().mass[disk] * (event.velocity - velocities.col(event.disk)).norm();
        measured.virial_of_events += (simulation.disks().radius[disk] + simulation.disks().radius[partner]) * impulse;
        velocities.col(event.partner) = event.partner_velocity;
      }
      velocities.col(event.disk) = event.velocity;
    }
  };
  const RunResult result = run_schedule(simulation, hooks);
  measured.report = measurements.report(result, 1.5);
  return measured;
}

TEST(RunMeasurements, ReportsAGasFromStartToEnd) {
  Scene scene = mixture_scene(36, 0.4, Boundary::periodic);
  scene.source = "gas.toml";
  scene.title = "A gas";
  scene.effects.collision.rule = CollisionRule::specular;
  scene.run.time = 30.0;
  scene.run.sample_every = 0.5;
  scene.run.equilibrate = {.collisions_per_disk = 2.0, .time = {}};
  const auto [report, virial] = measure(scene);
  EXPECT_EQ(report.scene, "gas.toml");
  EXPECT_EQ(report.title, "A gas");
  EXPECT_EQ(report.engine, engine_names().front());
  EXPECT_THAT(report.effects, testing::ElementsAre("specular"));
  EXPECT_EQ(report.disks, 36);
  EXPECT_EQ(report.packing_fraction, scene.packing_fraction());
  EXPECT_EQ(report.time, 30.0);
  EXPECT_EQ(report.state_hash.size(), 16U);
  EXPECT_EQ(report.samples, 61U);
  EXPECT_EQ(report.overlap_checked, 63U);  // start, samples, end
  EXPECT_LT(report.max_relative_overlap, 1e-13);
  EXPECT_EQ(report.wall_seconds, 1.5);
  EXPECT_GT(report.loop_seconds, 0.0);
  EXPECT_EQ(report.stopped, StopReason::time);
  EXPECT_NEAR(report.energy_initial, 35.0, 1e-12);  // kT = K / (N - 1) = 1
  EXPECT_LT(std::abs(report.relative_energy_drift()), 1e-12);
  EXPECT_LT(report.momentum_final.norm(), 1e-12);
  EXPECT_NEAR(report.temperature_mean, 1.0, 1e-12);

  // The virial of the log, and Z from it by its definition.
  EXPECT_NEAR(report.totals.virial, virial, 1e-11 * virial);
  ASSERT_TRUE(report.Z && report.Z_error && report.reduced_pressure);
  EXPECT_NEAR(*report.Z, 1.0 + virial / (2.0 * 30.0 * 36.0), 1e-11);
  EXPECT_NEAR(*report.reduced_pressure, 4.0 * report.packing_fraction / std::numbers::pi * *report.Z, 1e-12);
  // Z - 1 is known to about 1/sqrt(collisions) (docs/validation.md); its estimate from at least 32 blocks scatters by a quarter.
  const double expected_error = (*report.Z - 1.0) / std::sqrt(static_cast<double>(report.totals.pair));
  EXPECT_GT(*report.Z_error, expected_error / 3.0);
  EXPECT_LT(*report.Z_error, expected_error * 3.0);
}

TEST(RunMeasurements, WallsAreAnEffectAndTakeNoMomentumFromTheTemperature) {
  Scene scene = gas_scene(16, 0.3, Boundary::walls);
  scene.effects.collision.rule = CollisionRule::reversal;
  scene.run.time = 2.0;
  scene.run.sample_every = 1.0;
  const RunReport report = measure(scene).report;
  EXPECT_THAT(report.effects, testing::ElementsAre("reversal", "walls"));
  EXPECT_NEAR(report.energy_initial, 16.0, 1e-12);
  EXPECT_NEAR(report.temperature_mean, 1.0, 1e-12);
}

TEST(RunMeasurements, WithoutCollisionsThereIsNoPressure) {
  Scene scene = gas_scene(16, 0.3, Boundary::periodic);
  scene.run.time = 0.0;
  const RunReport still = measure(scene).report;
  EXPECT_FALSE(still.Z || still.Z_error || still.reduced_pressure);
  EXPECT_NEAR(still.temperature_mean, 1.0, 1e-12);
  const RunReport empty = measure([] {
                            Scene none = scene_of(box_of(1.0, 1.0, Boundary::periodic), {});
                            none.run.time = 1.0;
                            return none;
                          }())
                              .report;
  EXPECT_FALSE(empty.Z);
  EXPECT_EQ(empty.relative_energy_drift(), 0.0);
  EXPECT_EQ(empty.collisions_per_second(), 0.0);
}

TEST(RunMeasurements, FewCollisionsGiveZWithoutAnError) {
  Scene scene = gas_scene(16, 0.3, Boundary::periodic);
  scene.run.collisions = 20;
  const RunReport report = measure(scene).report;
  EXPECT_TRUE(report.Z);
  EXPECT_FALSE(report.Z_error);
  EXPECT_EQ(report.stopped, StopReason::collisions);
}

TEST(RunMeasurements, SaysWhereZOfTheHalvesDiffersByMoreThanChance) {
  const auto note = [](double rate_of_first) {
    Scene scene = gas_scene(16, 0.3, Boundary::periodic);
    scene.run.time = 10.0;
    Simulation simulation = make_simulation(scene);
    RunMeasurements measurements(simulation);
    const RunResult result = run_schedule(simulation, {});
    Progress made_up;
    for (int block = 1; block <= 50; ++block) {
      made_up.time = 0.2 * block;
      made_up.totals.virial += 0.2 * ((block <= 18 ? rate_of_first : 32.0) + (block % 2 == 0 ? 1.0 : -1.0));
      measurements.block(made_up);
    }
    return measurements.report(result, 1.0).Z_note;
  };
  EXPECT_THAT(note(64.0), testing::StartsWith("not yet at equilibrium: 3 in the first 36 % of the samples and 2 in the rest, "))
      << "Z is 1 + the rate over 2 N kT";
  EXPECT_EQ(note(32.0), "");
}

TEST(RunMeasurements, BesideAHeatBathTheErrorOfZIsThatOfARatio) {
  // kT of sixteen disks in a bath fluctuates by a quarter, and the virial with it, so that the error of the virial alone is some
  // three times that of Z. What the observable tells is known to be right. Both are known to sqrt(2 / 31) = 0.25 and about as
  // much of one run, in their squares, and the ratio of ten runs' to 0.11. Four standard errors.
  Scene scene = gas_scene(16, 0.1, Boundary::periodic);
  scene.effects.collision.rule = CollisionRule::specular;
  scene.effects.thermostat = Thermostat{.temperature = 1.0, .rate = 0.5};
  scene.run.time = 500.0;
  scene.run.sample_every = 0.5;
  scene.observe.emplace_back().name = "pressure";
  double summary = 0.0, observable = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    scene.run.seed = seed;
    Simulation simulation = make_simulation(scene);
    RunMeasurements measurements(simulation);
    Observation observation(simulation);
    RunHooks hooks;
    hooks.start = [&](const State& state) { measurements.start(state); };
    hooks.sample = [&](std::uint64_t, const State& state) { measurements.sample(state); };
    hooks.block = [&](const Progress& progress) { measurements.block(progress); };
    observation.attach(hooks);
    const RunResult result = run_schedule(simulation, hooks);
    const RunReport report = measurements.report(result, 0.0);
    const Scalar Z = observation.results().front().scalars.front();
    summary += std::pow(report.Z_error.value(), 2);
    observable += std::pow(Z.error.value(), 2);
    // Temperatures are taken at other times: half of the observable's step or less apart.
    EXPECT_NEAR(*report.Z, *Z.value, *Z.error);
  }
  EXPECT_NEAR(summary / observable, 1.0, 4.0 * 0.11);
}

TEST(RunMeasurements, WhatHoldsOfOneRateOfShearIsNotSaidOfTwo) {
  Scene scene = gas_scene(16, 0.3, Boundary::periodic);
  scene.effects.shear = Shear{.rate = 0.1};
  scene.effects.thermostat = Thermostat{.temperature = 1.0, .rate = 1.0};
  scene.run.time = 2.0;
  scene.run.sample_every = 0.5;
  const RunReport one = measure(scene).report;
  EXPECT_NEAR(one.of_effects.shear->strain.value(), 0.2, 1e-15);
  EXPECT_TRUE(one.of_effects.shear->viscosity);
  scene.changes = {{1.0, SetKeys{{"shear.rate=-0.1"}}}};
  const RunReport two = measure(scene).report;
  EXPECT_FALSE(two.of_effects.shear->strain);
  EXPECT_FALSE(two.of_effects.shear->viscosity);
}

TEST(RunMeasurements, AChangeThatCannotBeMadeGivesNoEnergy) {
  Scene scene = gas_scene(16, 0.3, Boundary::walls);
  scene.run.time = 2.0;
  const Eigen::Vector2d centre = (scene.box.lower + scene.box.upper) / 2.0;
  const DiskObstacle nearly_everything{.centre = centre, .radius = 0.49 * scene.box.lengths().minCoeff()};
  scene.changes = {{0.5, ScaleVelocities{2.0}}, {1.0, AddObstacle{nearly_everything}}};
  const RunReport report = measure(scene).report;
  EXPECT_EQ(report.stopped, StopReason::blocked);
  EXPECT_EQ(report.of_effects.changes->made, 1U);
  EXPECT_NEAR(report.of_effects.changes->energy, 3.0 * report.energy_initial, 1e-12 * report.energy_initial);
  EXPECT_NEAR(report.energy_final, 4.0 * report.energy_initial, 1e-12 * report.energy_initial);
}

TEST(RunMeasurements, AFloorThatAChangeStopsLeavesTheZeroOfHeightsWhereItWas) {
  Scene scene = gas_scene(16, 0.1, Boundary::walls);
  scene.effects.gravity = Gravity{.acceleration = {0.0, -1.0}};
  scene.effects.walls[2].velocity = -0.5;
  scene.run.time = 3.0;
  scene.changes = {{2.0, SetKeys{{"walls.bottom.velocity=0"}}}};
  const RunReport report = measure(scene).report;
  EXPECT_EQ(report.of_effects.changes->made, 1U);
  EXPECT_EQ(report.of_effects.changes->energy, 0.0);  // disks are where they were, and as fast
  const double gained = report.energy_final - report.energy_initial;
  EXPECT_NEAR(gained, report.of_effects.energy_supplied.value(), 1e-12 * report.energy_scale.value());
  EXPECT_DOUBLE_EQ(report.of_effects.energies_end->total(), report.energy_final);
  EXPECT_DOUBLE_EQ(report.of_effects.walls[2].end->position, scene.box.lower.y() - 1.0);
  EXPECT_EQ(report.of_effects.walls[2].end->velocity, 0.0);
  const double larger = scene.box.area() + scene.box.lengths().x();
  EXPECT_NEAR(report.of_effects.packing_fraction_end.value(), scene.packing_fraction() * scene.box.area() / larger, 1e-15);
}

TEST(RunMeasurements, LoadsActOnTheLengthOfNowWhereAChangeStopsAWall) {
  // Along x disks fall; the left wall stops at time 1, and from then on nothing brings or takes energy.
  Scene scene = gas_scene(16, 0.1, Boundary::walls);
  scene.effects.gravity = Gravity{.acceleration = {-0.5, 0.0}};
  scene.effects.walls[0].velocity = -1.0;
  scene.effects.walls[3].mass = 5.0;
  scene.effects.walls[3].load = 0.5;
  scene.changes = {{1.0, SetKeys{{"walls.left.velocity=0"}}}};
  const auto energy_at = [&](double time) {
    scene.run.time = time;
    return measure(scene).report.energy_final;
  };
  const double first = energy_at(1.5);
  EXPECT_NEAR(energy_at(6.0), first, 1e-10 * std::abs(first));
}

TEST(RunMeasurements, RedrawsAreCountedByTheirEffect) {
  Scene scene = gas_scene(16, 0.1, Boundary::periodic);
  scene.run.time = 2.0;
  scene.effects.thermostat = Thermostat{.temperature = 1.0, .rate = 0.0};
  scene.changes = {{0.5, SetKeys{{"thermostat.rate=2"}}},
                   {1.0, SetKeys{{"thermostat.rate=0", "tumbling.rate=3"}}},
                   {1.5, SetKeys{{"tumbling.rate=0", "brownian.temperature=1", "brownian.rate=10"}}}};
  const RunReport report = measure(scene).report;
  const EffectsReport& effects = report.of_effects;
  EXPECT_NEAR(static_cast<double>(effects.thermostat->events), 16.0, 5.0 * 4.0);  // 16 disks, rate 2, for 0.5
  EXPECT_GT(effects.thermostat->events, 0U);
  EXPECT_NEAR(static_cast<double>(effects.tumbling->events), 24.0, 5.0 * 4.9);
  EXPECT_GT(effects.tumbling->events, 0U);
  EXPECT_EQ(effects.brownian->events % 16, 0U);  // all disks at once, at equal steps of 0.1
  EXPECT_NEAR(static_cast<double>(effects.brownian->events), 5.0 * 16.0, 16.0);
  EXPECT_EQ(effects.thermostat->events + effects.tumbling->events + effects.brownian->events, report.totals.thermostat);
  EXPECT_NEAR(effects.thermostat->energy + effects.brownian->energy, report.energy_final - report.energy_initial,
              1e-12 * report.energy_initial);
}

TEST(RunMeasurements, ADeeplyOverlappingStateIsReported) {
  Scene scene = gas_scene(16, 0.3, Boundary::periodic);
  scene.run.time = 0.0;
  Simulation simulation = make_simulation(scene);
  RunMeasurements measurements(simulation);
  State state = simulation.state();
  measurements.start(state);
  state.positions.col(3) = state.positions.col(9) + Eigen::Vector2d(0.25, 0.0);
  measurements.sample(state);
  EXPECT_NEAR(measurements.report({}, 0.0).max_relative_overlap, 0.75, 1e-14);
}

TEST(RunMeasurements, SaysWhatTheErrorOfZIsWorth) {
  const auto note = [](Scene scene) {
    scene.run.time = 1.0;
    return measure(scene).report.note_on_errors;
  };
  Scene mixture = mixture_scene(36, 0.4, Boundary::periodic);
  EXPECT_EQ(note(gas_scene(36, 0.4, Boundary::periodic)), "");
  mixture.species.front().mass = 1000.0 * mixture.species.back().mass;
  EXPECT_THAT(note(mixture), testing::HasSubstr("light and heavy disks exchange energy too slowly"));
  EXPECT_THAT(note(gas_scene(36, 0.73, Boundary::periodic)), testing::HasSubstr("the error of Z is up to 3 times too large"));
  EXPECT_THAT(note(gas_scene(36, 0.71, Boundary::periodic)), testing::Not(testing::HasSubstr("too large")));
  Scene falling = gas_scene(36, 0.3, Boundary::walls);
  falling.effects.gravity = Gravity{.acceleration = {0.0, -0.5}};
  EXPECT_THAT(note(falling), testing::HasSubstr("kT of another start may differ by more than the errors"));
  falling.effects.thermostat = Thermostat{.temperature = 1.0, .rate = 0.5};
  EXPECT_EQ(note(falling), "");
}

}  // namespace
}  // namespace carom::test
