// Observables in a loop of a program's own find the numbers that they find in a schedule, to the last bit where samples are taken
// at the same times.

#include "support/same_measurements.hpp"
#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <carom/observe.hpp>
#include <carom/simulation.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

namespace carom::test {
namespace {

/// Steps of powers of two: k steps are doubles, and a schedule takes its samples at the very times.
Scene observed_scene() {
  Scene scene = gas_scene(40, 0.4, Boundary::periodic);
  scene.run.time = 16.0;
  scene.observe = {{.name = "temperature", .every = 0.25},
                   {.name = "pressure", .every = 0.5},
                   {.name = "collision_rate", .every = 0.25},
                   {.name = "free_flight"},
                   {.name = "viscosity", .every = 0.125}};
  return scene;
}

std::vector<Measurement> by_schedule(const Scene& scene) {
  Simulation simulation = make_simulation(scene);
  Observation observation(simulation);
  RunHooks hooks;
  observation.attach(hooks);
  run_schedule(simulation, hooks);
  return observation.results();
}

TEST(OwnLoop, FindsWhatAScheduleFinds) {
  enum class Kind { plain, rough, changed };
  for (const Kind kind : {Kind::plain, Kind::rough, Kind::changed}) {
    Scene scene = observed_scene();
    if (kind == Kind::rough) {
      scene.effects.collision.roughness = 0.5;
      scene.observe.pop_back();  // there is no viscosity of rough disks
    }
    if (kind == Kind::changed) scene.changes = {{3.0, ScaleVelocities{2.0}}, {7.25, ScaleVelocities{0.5}}};
    Simulation simulation = make_simulation(scene);
    Observation observation(simulation);
    EXPECT_EQ(observation.next_sample(), 0.0);
    while (observation.next_sample() <= 16.0) {
      simulation.run_until(observation.next_sample());
      observation.sample(simulation);
      if (simulation.time() == 8.0) {
        simulation.run_until(8.0625);
        observation.sample(simulation);  // between two steps: nothing but collisions
      }
    }
    EXPECT_EQ(simulation.time(), 16.0);
    expect_same_measurements(observation.results(), by_schedule(scene));
  }
}

TEST(OwnLoop, TakesRangesThatAProgramLeavesOpen) {
  Scene scene = gas_scene(40, 0.4, Boundary::periodic);
  scene.observe = {{.name = "radial_distribution", .every = 1.0}};
  Simulation simulation = make_simulation(scene);
  Observation observation(simulation);
  observation.sample(simulation);
  const std::vector<Measurement> measured = observation.results();
  const double half_box = 0.5 * scene.box.lengths().minCoeff();
  EXPECT_LE(measured.at(0).tables.at(0).columns.at(0).values.back(), half_box)
      << "a distance beyond that would be one of an image";
}

TEST(OwnLoop, BeginsAtTimeZero) {
  Simulation simulation = make_simulation(observed_scene());
  simulation.run_until(1.0);
  Observation observation(simulation);
  EXPECT_THROW(observation.sample(simulation), std::logic_error);
  simulation.reset_clock();
  observation.sample(simulation);
  EXPECT_EQ(observation.next_sample(), 0.25);
}

/// Elastic disks lose no energy, which a change that was counted twice would show.
TEST(OwnLoop, BegunAfterAChangeDoesNotMakeItAgain) {
  Scene scene = observed_scene();
  scene.effects.collision.restitution = 1.0;
  scene.changes = {{1.0, ScaleVelocities{2.0}}, {2.0, ScaleVelocities{0.5}}};
  scene.observe = {{.name = "fields", .every = 0.25, .cells = std::array<std::int64_t, 2>{2, 2}}};
  Simulation simulation = make_simulation(scene);
  simulation.run_until(1.5);
  simulation.reset_clock();
  Observation observation(simulation);
  for (; observation.next_sample() <= 4.0; observation.sample(simulation)) simulation.run_until(observation.next_sample());
  ASSERT_GT(simulation.totals().pair, 100U);
  const Table in_time = observation.results().at(0).tables.at(1);
  const auto lost = std::ranges::find(in_time.columns, "energy_lost", &Column::name);
  ASSERT_NE(lost, in_time.columns.end());
  EXPECT_GT(lost->values.size(), 10U);
  for (const double one : lost->values) EXPECT_NEAR(one, 0.0, 1e-12);
}

TEST(OwnLoop, RefusesAStepThatWasPassedOver) {
  Simulation simulation = make_simulation(observed_scene()), other = make_simulation(observed_scene());
  Observation observation(simulation);
  observation.sample(simulation);
  EXPECT_THROW(observation.sample(other), std::logic_error);
  simulation.run_until(0.3);
  EXPECT_THROW(observation.sample(simulation), std::logic_error);
}

TEST(OwnLoop, WithoutStepsIsNeverDue) {
  Scene scene = observed_scene();
  scene.observe = {{.name = "free_flight"}};
  Simulation simulation = make_simulation(scene);
  Observation observation(simulation);
  observation.sample(simulation);
  simulation.run_until(16.0);
  EXPECT_EQ(observation.next_sample(), std::numeric_limits<double>::infinity());
  observation.sample(simulation);
  EXPECT_EQ(observation.results().size(), 1U);
}

}  // namespace
}  // namespace carom::test
