// Work and heat. Together they are the energy that the disks have gained, to rounding; and each part is what the momentum that a
// wall received says by itself.

#include "support/scenes.hpp"

#include <carom/observe.hpp>
#include <carom/simulation.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace carom::test {
namespace {

struct Observed {
  std::map<std::string, double> numbers;
  std::vector<Table> tables;
  double gained = 0.0;          ///< energy of motion, of spin, and of pairs in wells
  double lost_by_piston = 0.0;  ///< energy of motion and of its load, where the right wall is one
  Totals totals;
};

/// Returns the energy of disks of mass 2 and radius 0.4.
double energy_of_disks(const Simulation& simulation) {
  const State state = simulation.state();
  double energy = state.velocities.squaredNorm();
  energy += 0.25 * 2.0 * std::pow(0.4 * state.scale, 2) * state.spins.squaredNorm();
  if (const std::optional<SquareWell>& well = simulation.scene().effects.square_well)
    energy -= well->depth * static_cast<double>(state.bonds);
  const std::vector<PotentialStep> steps =
      simulation.scene().effects.stepped_potential ? simulation.scene().effects.potential_steps() : std::vector<PotentialStep>();
  for (std::size_t k = 0; k < steps.size(); ++k) energy += steps[k].energy * static_cast<double>(state.pairs_in_steps.at(k));
  return energy;
}

/// Returns the energy of motion and of the load of the right wall of a box 10 high; 0 where it is no piston.
double energy_of_piston(const Simulation& simulation) {
  const WallProperties& wall = simulation.scene().effects.walls[1];
  if (!wall.mass) return 0.0;
  const WallState piston = simulation.state().walls.at(1);
  return *wall.mass * piston.velocity * piston.velocity / 2 + wall.load.value() * 10.0 * piston.position;
}

Observed observed(const std::string& effects, const std::string& boundary = "\"walls\"", const std::string& run = "time = 8",
                  const std::string& every = "{ every = 0.125 }") {
  const Scene scene = parse_scene("[box]\nx = [0, 20]\ny = [0, 10]\nboundary = " + boundary +
                                  "\n[[disks]]\ncount = 30\nradius = 0.4\nmass = 2\npositions = \"random\"\n"
                                  "velocities = { temperature = 1 }\n[run]\n" +
                                  run + "\n[observe]\nwork = " + every + "\n" + effects);
  Simulation simulation = make_simulation(scene);
  const double before = energy_of_disks(simulation), of_piston = energy_of_piston(simulation);
  Observation observation(simulation);
  RunHooks hooks;
  observation.attach(hooks);
  (void)run_schedule(simulation, hooks);
  Observed found;
  for (const Measurement& one : observation.results()) {
    for (const Scalar& scalar : one.scalars) found.numbers[scalar.name] = scalar.value.value();
    found.tables = one.tables;
  }
  found.gained = energy_of_disks(simulation) - before;
  found.lost_by_piston = of_piston - energy_of_piston(simulation);
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
  expect_sum(observed(specular +
                      "[walls]\nbottom = { vibration = { form = \"sine\", amplitude = 0.1, frequency = 2.0 } }\n"
                      "top = { vibration = { form = \"sawtooth\", amplitude = 0.1, frequency = 2.0 }, restitution = 0.8 }\n"));
  expect_sum(observed(specular + "[thermostat]\ntemperature = 2\nrate = 0.5\n"));
  expect_sum(observed(specular + "[brownian]\ntemperature = 2\nrate = 0.5\n"));
  expect_sum(observed("[collision]\nrule = \"specular\"\nroughness = 0.5\n[growth]\nrate = 0.01\n"));
  expect_sum(observed(specular + "[walls]\nright = { mass = 20.0, load = 0.5 }\n"));
  expect_sum(observed(specular + "[shear]\nrate = 0.2\n", "\"periodic\""));
}

TEST(Work, OfGrowingDisksAtWallsIsWorkOfGrowth) {
  const std::string growing = specular + "[growth]\nrate = 0.05\n";
  const Observed plain = observed(growing);
  expect_sum(plain);
  double at_walls = 0.0;
  for (const double energy : plain.totals.wall_energy) at_walls -= energy;
  EXPECT_GT(at_walls, 0.1) << "surfaces that grow push themselves off";
  EXPECT_NEAR(plain.numbers.at("work_growth"), plain.totals.growth_energy + at_walls, 1e-10);
  EXPECT_EQ(plain.numbers.at("heat"), 0.0);
  EXPECT_EQ(plain.numbers.count("work_left"), 0U) << "no wall moves";

  expect_sum(observed(growing + "[walls]\nleft = { temperature = 2.0 }\ntop = { restitution = 0.9 }\n"));
  expect_sum(observed(growing + "[walls]\nleft = { restitution = 1.0 }\ntop = { vibration = 0.5 }\n"));
  expect_sum(observed(growing + "[walls]\nright = { temperature = 1.0, tangential_velocity = 0.5 }\n"));
  expect_sum(observed(growing + "[gravity]\nacceleration = [0.0, -1.0]\n"));
}

TEST(Work, OfAnInelasticPistonIsTheEnergyOfMotionThatContactsTakeFromIt) {
  const Observed found = observed(specular + "[walls]\nright = { mass = 20.0, load = 0.5, restitution = 0.7 }\n");
  expect_sum(found);
  // What the load has given to the piston, and the piston has not kept, it has given to the disks.
  EXPECT_NEAR(found.numbers.at("work_right"), found.lost_by_piston, 1e-10);
  EXPECT_LT(found.numbers.at("heat_right"), -1.0);
}

TEST(Work, OfAnInelasticSineIsToldFromItsHeat) {
  const Observed found = observed(
      specular + "[walls]\nbottom = { vibration = { form = \"sine\", amplitude = 0.3, frequency = 2.0 }, restitution = 0.7 }\n");
  expect_sum(found);
  EXPECT_EQ(found.numbers.at("work_bottom"), -found.totals.wall_work[2]);
  EXPECT_GT(found.numbers.at("work_bottom"), 1.0);
  EXPECT_LT(found.numbers.at("heat_bottom"), -1.0);
}

TEST(Work, IsThatOfTheEndWhereverTheRunEnds) {
  const std::string gravity = specular + "[gravity]\nacceleration = [0.0, -1.0]\n";
  const Observed between = observed(gravity, "\"walls\"", "time = 8", "{ every = 0.7 }");
  expect_sum(between);
  EXPECT_NEAR(between.numbers.at("work_field"), between.gained, 1e-10);
  expect_sum(observed(gravity, "\"walls\"", "collisions = 101", "true"));
  expect_sum(observed(gravity + "[walls]\nright = { temperature = 2.0, velocity = -0.25 }\n", "\"walls\"", "time = 7.3",
                      "{ every = 1.5 }"));
}

TEST(Work, OfARunThatIsResumedIsThatOfTheWholeRun) {
  const auto scene = [](const std::string& time) {
    return parse_scene(
        "[box]\nx = [0, 20]\ny = [0, 10]\nboundary = \"walls\"\n[[disks]]\ncount = 30\nradius = 0.4\nmass = 2\n"
        "positions = \"random\"\nvelocities = { temperature = 1 }\n[run]\ntime = " +
        time +
        "\n[observe]\nwork = { every = 0.7 }\n[collision]\nrule = \"specular\"\n[gravity]\nacceleration = [0, -1]\n"
        "[[changes]]\ntime = 1.0\nset = [\"gravity.acceleration=[0.5, -2]\"]\n");
  };
  const auto work_of = [](const std::vector<Measurement>& measured) { return measured.at(0).scalars.at(0).value.value(); };
  Simulation whole = make_simulation(scene("6"));
  Observation of_whole(whole);
  RunHooks hooks;
  of_whole.attach(hooks);
  (void)run_schedule(whole, hooks);

  Simulation first = make_simulation(scene("2"));
  std::stringstream of_simulation, of_schedule, of_observation;
  Observation of_first(first);
  RunHooks first_hooks;
  of_first.attach(first_hooks);
  first_hooks.checkpoint = [&](const SavingMoment& moment) {
    if (!moment.ended) return;
    first.save(of_simulation);
    moment.save(of_schedule);
    of_first.save(of_observation);
  };
  (void)run_schedule(first, first_hooks);
  Scene longer = first.scene();
  longer.run.time = 6.0;
  Simulation rest = restore_simulation(longer, of_simulation);
  Observation of_rest(rest, of_observation);
  RunHooks rest_hooks;
  of_rest.attach(rest_hooks);
  rest_hooks.resume = &of_schedule;
  (void)run_schedule(rest, rest_hooks);
  EXPECT_NEAR(work_of(of_rest.results()), work_of(of_whole.results()), 1e-10);
}

TEST(Work, OfAChangeIsTheEnergyThatItGives) {
  const Observed scaled = observed(specular + "[[changes]]\ntime = 3.3\nscale_velocities = 2.0\n");
  expect_sum(scaled);
  EXPECT_NEAR(scaled.numbers.at("work_changes"), scaled.gained, 1e-10);
  EXPECT_GT(scaled.gained, 10.0);
  const std::string well = specular + "[square_well]\nwidth = 1.5\ndepth = 0.5\n";
  const Observed deepened = observed(well + "[[changes]]\ntime = 3.3\nset = [\"square_well.depth=3\"]\n");
  expect_sum(deepened);
  EXPECT_LT(deepened.numbers.at("work_changes"), -0.5);
  const Observed stepped =
      observed(specular +
               "[stepped_potential]\nsteps = [{ width = 1.5, energy = -0.5 }]\n[[changes]]\ntime = 3.3\nset = "
               "[\"stepped_potential.steps=[{ width = 1.5, energy = -3 }]\"]\n");
  expect_sum(stepped);
  EXPECT_DOUBLE_EQ(stepped.numbers.at("work_changes"), deepened.numbers.at("work_changes")) << "the same well";
  expect_sum(observed(well + "[thermostat]\ntemperature = 2\nrate = 0.5\n"
                             "[[changes]]\ntime = 3.3\nset = [\"thermostat.temperature=0.5\"]\n"));
  expect_sum(observed("[collision]\nrule = \"specular\"\nroughness = 0.5\n[[changes]]\ntime = 3.3\nscale_velocities = 0.5\n"));
}

TEST(Work, OfAChangeThatCannotBeMadeIsNone) {
  const Observed blocked =
      observed(specular + "[[changes]]\ntime = 3.3\nadd_obstacle = { disk = { centre = [10, 5], radius = 4.9 } }\n");
  EXPECT_EQ(blocked.numbers.at("work_changes"), 0.0);
  expect_sum(blocked);
}

TEST(Work, OfChangedFieldsAndWallsIsThatOfEachStretch) {
  const Observed field = observed(specular +
                                  "[gravity]\nacceleration = [0.0, -1.0]\n[[changes]]\ntime = 3.3\nset = "
                                  "[\"gravity.acceleration=[0.5, 2]\"]\n");
  expect_sum(field);
  EXPECT_EQ(field.numbers.at("work_changes"), 0.0) << "a field that begins does work from then on";
  const Observed begun = observed(specular + "[[changes]]\ntime = 3.3\nset = [\"gravity.acceleration=[0, -1]\"]\n");
  expect_sum(begun);
  EXPECT_NEAR(begun.numbers.at("work_field"), begun.gained, 1e-10);
  const Observed faster =
      observed(specular +
                   "[walls]\nright = { temperature = 1.0, velocity = -0.25, tangential_velocity = 0.5 }\n"
                   "[[changes]]\ntime = 3.3\nset = [\"walls.right.velocity=-0.5\", \"walls.right.tangential_velocity=-1\"]\n",
               "\"walls\"", "time = 6", "{ every = 1.0 }");
  const Observed until =
      observed(specular + "[walls]\nright = { temperature = 1.0, velocity = -0.25, tangential_velocity = 0.5 }\n", "\"walls\"",
               "time = 3.3");
  expect_sum(faster);
  const auto impulse = faster.totals.wall_impulse[1] - until.totals.wall_impulse[1];
  const auto shear = faster.totals.wall_shear[1] - until.totals.wall_shear[1];
  EXPECT_NEAR(faster.numbers.at("work_right"), until.numbers.at("work_right") + 0.5 * impulse + shear, 1e-10);
}

TEST(Work, OfDragIsHeatThatDisksLose) {
  const Observed slowed = observed(specular + "[drag]\nrate = 0.5\n", "\"periodic\"");
  expect_sum(slowed);
  EXPECT_EQ(slowed.numbers.at("work"), 0.0);
  EXPECT_LT(slowed.gained, -10.0);
  EXPECT_NEAR(slowed.numbers.at("heat_drag"), slowed.gained, 1e-10);
  const Observed both = observed("[collision]\nrule = \"specular\"\nrestitution = 0.5\n[drag]\nrate = 0.1\n", "\"periodic\"");
  expect_sum(both);
  EXPECT_LT(both.numbers.at("heat_drag"), -1.0);
  EXPECT_EQ(both.numbers.at("heat_collisions"), -both.totals.dissipated);
  EXPECT_EQ(both.tables.at(0).columns.at(3).name, "heat_collisions");
  EXPECT_FALSE(std::signbit(both.tables[0].columns[3].values.front())) << "nothing has been lost at the start: 0, not -0";
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
  EXPECT_EQ(found.tables[0].average, Average::sum);
}

}  // namespace
}  // namespace carom::test
