// Work and heat. Together they are the energy that the disks have gained, to rounding; and each part is what the momentum that a
// wall received says by itself.

#include "support/scenes.hpp"

#include <carom/observe.hpp>
#include <carom/simulation.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

namespace carom::test {
namespace {

struct Observed {
  std::map<std::string, double> numbers;
  std::vector<Table> tables;
  double gained = 0.0;  ///< kinetic energy
  Totals totals;
};

Observed observed(const std::string& effects, const std::string& boundary = "\"walls\"") {
  const Scene scene = parse_scene("[box]\nx = [0, 20]\ny = [0, 10]\nboundary = " + boundary +
                                  "\n[[disks]]\ncount = 30\nradius = 0.4\nmass = 2\npositions = \"random\"\n"
                                  "velocities = { temperature = 1 }\n[run]\ntime = 8\n[observe]\nwork = { every = 0.125 }\n" +
                                  effects);
  Simulation simulation = make_simulation(scene);
  const double before = simulation.state().velocities.squaredNorm();
  Observation observation(simulation);
  RunHooks hooks;
  observation.attach(hooks);
  (void)run_schedule(simulation, hooks);
  Observed found;
  for (const Measurement& one : observation.results()) {
    for (const Scalar& scalar : one.scalars) found.numbers[scalar.name] = scalar.value.value();
    found.tables = one.tables;
  }
  found.gained = simulation.state().velocities.squaredNorm() - before;  // m / 2 = 1
  found.totals = simulation.totals();
  return found;
}

const std::string specular = "[collision]\nrule = \"specular\"\n";

void expect_sum(const Observed& found) {
  EXPECT_NEAR(found.numbers.at("work") + found.numbers.at("heat"), found.gained, 1e-10 * (1.0 + std::abs(found.gained)));
}

TEST(Work, OfAMovingWallIsItsForceTimesItsWay) {
  const Observed found = observed(specular + "[walls]\nright = { velocity = -0.5 }\n");
  expect_sum(found);
  EXPECT_EQ(found.numbers.at("heat"), 0.0);
  EXPECT_EQ(found.numbers.at("work"), found.numbers.at("work_right"));
  EXPECT_NEAR(found.numbers.at("work"), 0.5 * found.totals.wall_impulse[1], 1e-10);
  EXPECT_GT(found.numbers.at("work"), 1.0);
}

TEST(Work, IsToldFromTheHeatOfAWallThatSlidesAndMoves) {
  const Observed found = observed(
      specular +
      "[walls]\nleft = { temperature = 2.0 }\nright = { temperature = 1.0, velocity = -0.25, tangential_velocity = 0.5 }\n");
  expect_sum(found);
  const double work = 0.25 * found.totals.wall_impulse[1] - 0.5 * found.totals.wall_shear[1];
  EXPECT_NEAR(found.numbers.at("work_right"), work, 1e-10);
  EXPECT_NEAR(found.numbers.at("heat_right"), -found.totals.wall_energy[1] - work, 1e-10);
  EXPECT_NEAR(found.numbers.at("heat_left"), -found.totals.wall_energy[0], 1e-10);
  EXPECT_EQ(found.numbers.count("work_left"), 0U);
}

TEST(Work, OfAFieldIsTheHeightThatDisksHaveLost) {
  expect_sum(observed(specular + "[gravity]\nacceleration = [0.0, -1.0]\n"));
  const Observed around = observed(specular + "[gravity]\nacceleration = [0.5, 0.0]\n[walls]\ntop = { temperature = 1.0 }\n",
                                   "{ x = \"periodic\", y = \"walls\" }");
  expect_sum(around);
  EXPECT_GT(around.numbers.at("work_field"), 0.0);
}

TEST(Work, OfOtherEffectsAddsUpToo) {
  expect_sum(
      observed("[collision]\nrule = \"specular\"\nrestitution = 0.9\n[walls]\nbottom = { vibration = 0.5 }\ntop = { restitution "
               "= 0.8 }\n"));
  expect_sum(observed(specular + "[thermostat]\ntemperature = 2\nrate = 0.5\n"));
  expect_sum(observed(specular + "[brownian]\ntemperature = 2\nrate = 0.5\n"));
  expect_sum(observed(specular + "[shear]\nrate = 0.2\n", "\"periodic\""));
}

TEST(Work, HasARowForEachInstant) {
  const Observed found = observed(specular + "[walls]\nright = { velocity = -0.5 }\n");
  ASSERT_EQ(found.tables.size(), 1U);
  const std::vector<Column>& columns = found.tables[0].columns;
  ASSERT_EQ(columns.size(), 4U);
  EXPECT_EQ(columns[0].name, "time");
  EXPECT_EQ(columns[3].name, "work_right");
  ASSERT_EQ(columns[0].values.size(), 65U);
  EXPECT_EQ(columns[0].values.back(), 8.0);
  EXPECT_EQ(columns[1].values.front(), 0.0);
  EXPECT_NEAR(columns[1].values.back(), found.numbers.at("work"), 1e-12);
}

}  // namespace
}  // namespace carom::test
