// Observables driven through a run: a program's own, what costs nothing, and what is refused.

#include "observe/observed_system.hpp"

#include "../../docs/impact_parameter.hpp"
#include "io/run_directory.hpp"
#include "observe/observables.hpp"
#include "scene/observables_known.hpp"
#include "support/refusal.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace carom::test {
namespace {

using ::testing::HasSubstr;

TEST(Observation, MayBeAttachedToTheHooksOfSeveralRuns) {
  Simulation simulation = make_simulation(parse_scene(small_fluid("pressure = { every = 0.5 }", "specular", "4.0")));
  Observation observation(simulation);
  RunHooks first, second;
  observation.attach(first);
  observation.attach(second);
  run_schedule(simulation, first);
  simulation.reset_clock();
  run_schedule(simulation, second);
  EXPECT_TRUE(observation.results().at(0).scalars.at(0).value.has_value());
}

TEST(Observation, RefusesWhatWouldNotBeMeasured) {
  Simulation simulation = make_simulation(parse_scene(small_fluid("", "specular", "40.0")));
  Observation attached(simulation), sampled(simulation);
  RunHooks hooks;
  attached.attach(hooks);
  sampled.sample(simulation);
  for (Observation* observation : {&attached, &sampled})
    EXPECT_THROW(observation->add(std::make_unique<ImpactParameter>()), std::logic_error);
}

TEST(Observation, RefusesNullPointersAndStepsThatAreNoTimes) {
  Simulation simulation = make_simulation(parse_scene(small_fluid("", "specular", "40.0")));
  Observation observation(simulation);
  EXPECT_THROW(observation.add(nullptr), std::invalid_argument);
  Record record;
  for (const double step : {-1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(observation.add(std::make_unique<Recorder>(step, record)), std::invalid_argument) << step;
  EXPECT_TRUE(observation.empty());
}

TEST(Observation, RunsAnObservableOfAProgramsOwn) {
  Simulation simulation = make_simulation(parse_scene(small_fluid("", "specular", "40.0")));
  Observation observation(simulation);
  EXPECT_TRUE(observation.empty());
  observation.add(std::make_unique<ImpactParameter>());
  RunHooks hooks;
  observation.attach(hooks);
  run_schedule(simulation, hooks);
  const std::vector<Measurement> measured = observation.results();
  ASSERT_EQ(measured.size(), 1U);
  ASSERT_EQ(measured[0].name, "impact_parameter");
  // Uniform in [0, 1]: mean 1 / 2, variance 1 / 12 over all collisions. Five standard errors.
  const double error = std::sqrt(1.0 / 12.0 / static_cast<double>(simulation.totals().pair));
  ASSERT_GT(simulation.totals().pair, 2000U);
  EXPECT_NEAR(measured[0].scalars[0].value.value(), 0.5, 5.0 * error);
  // The error that blocking tells is known to a few tens of per cent; a factor of two either way is far beyond.
  EXPECT_GT(measured[0].scalars[0].error.value(), 0.5 * error);
  EXPECT_LT(measured[0].scalars[0].error.value(), 2.0 * error);
}

TEST(Observation, LeavesTheBitsOfARunAsTheyAre) {
  const std::string all =
      "pressure = true\nfree_flight = true\nviscosity = true\nvelocity_autocorrelation = { every = 0.013 }\n"
      "radial_distribution = { range = 3.0 }";
  const auto end = [](const Scene& scene) {
    Simulation simulation = make_simulation(scene);
    Observation observation(simulation);
    RunHooks hooks;
    observation.attach(hooks);
    run_schedule(simulation, hooks);
    return simulation.state();
  };
  const State with = end(parse_scene(small_fluid(all))), without = end(parse_scene(small_fluid("")));
  EXPECT_EQ(with.positions, without.positions);
  EXPECT_EQ(with.velocities, without.velocities);
}

TEST(Observation, AsksForNothingWhereNothingIsObserved) {
  const Simulation simulation = make_simulation(parse_scene(small_fluid("")));
  Observation observation(simulation);
  RunHooks hooks;
  observation.attach(hooks);
  EXPECT_FALSE(hooks.start);
  EXPECT_FALSE(hooks.events);
  EXPECT_TRUE(hooks.grids.empty());
}

TEST(Observation, RecordsNoCollisionsWhereNoObservableFollowsThem) {
  const Simulation simulation = make_simulation(parse_scene(small_fluid("temperature = true\nspeeds = true\nhexatic = true")));
  Observation observation(simulation);
  RunHooks hooks;
  observation.attach(hooks);
  EXPECT_FALSE(hooks.events);
  EXPECT_EQ(hooks.grids.size(), 1U);
}

TEST(Observation, HooksThatWereThereAreCalledAfterIt) {
  Simulation simulation = make_simulation(parse_scene(small_fluid("free_flight = true")));
  Observation observation(simulation);
  int starts = 0;
  std::size_t events = 0;
  RunHooks hooks;
  hooks.start = [&](const State&) { ++starts; };
  hooks.events = [&](std::span<const Event> batch) { events += batch.size(); };
  observation.attach(hooks);
  run_schedule(simulation, hooks);
  EXPECT_EQ(starts, 1);
  EXPECT_EQ(events, simulation.totals().pair);
}

TEST(Observation, TellsTheStepsThatItTakes) {
  const auto steps = [](const std::string& observables) {
    const Simulation simulation = make_simulation(parse_scene(small_fluid(observables)));
    return Observation(simulation).steps();
  };
  const std::vector<double> chosen = steps("temperature = { every = 0.75 }\nfree_flight = true\nspeeds = true\nviscosity = true");
  ASSERT_EQ(chosen.size(), 4U);
  EXPECT_EQ(chosen[0], 0.75);
  EXPECT_EQ(chosen[1], 0.0);  // it follows collisions alone
  for (const std::size_t k : {2U, 3U}) {
    EXPECT_GT(chosen[k], 0.0);
    EXPECT_LE(chosen[k], 5.0 / 256.0);  // the run ends at 5
  }
  EXPECT_EQ(steps(fmt::format("speeds = {{ every = {} }}", chosen[2])), std::vector<double>({chosen[2]}));
}

TEST(Observation, HasNoResultsOfARunThatNeverBegan) {
  std::string scene = small_fluid("temperature = true");
  scene.replace(scene.find("time = 5.0"), 10, "time = 5.0\nequilibrate = { time = 1.0 }");
  Simulation simulation = make_simulation(parse_scene(scene));
  Observation observation(simulation);
  RunHooks hooks;
  observation.attach(hooks);
  EXPECT_TRUE(observation.results().empty());
}

TEST(Observation, RefusesToGoOnWhereAProgramHasChangedTheSimulation) {
  const Scene scene = parse_scene(small_fluid("temperature = true"));
  const auto refused = [&](const auto& change) {
    Simulation simulation = make_simulation(scene);
    Observation observation(simulation);
    observation.sample(simulation);
    change(simulation);
    EXPECT_THROW(observation.sample(simulation), std::logic_error);
    RunHooks hooks;
    observation.attach(hooks);
    EXPECT_THROW(run_schedule(simulation, hooks), std::logic_error);
    simulation.reset_clock();
    Observation(simulation).sample(simulation);  // another one
  };
  refused([](Simulation& simulation) {
    Effects effects = simulation.scene().effects;
    effects.square_well = SquareWell{1.5, 0.5};
    simulation.set_effects(effects);
  });
  refused([](Simulation& simulation) { simulation.set_velocities(-simulation.state().velocities); });
  refused([](Simulation& simulation) { simulation.set_collision_rule([](CollidingPair&) {}); });
}

TEST(Observation, RefusesToFollowCollisionsUnderAThermostat) {
  std::string scene = small_fluid("");
  scene += "[thermostat]\ntemperature = 1.0\nrate = 0.5\n";
  const Simulation simulation = make_simulation(parse_scene(scene));
  Observation observation(simulation);
  EXPECT_THAT(refusal<SceneError>([&] { observation.add(std::make_unique<ImpactParameter>()); }),
              HasSubstr("impact_parameter follows disks from collision to collision"));
}

/// Every word of the format makes an observable that calls itself by it, and every table has a file that --force knows.
TEST(Observation, CatalogueFormatAndFilesAgree) {
  std::string periodic, walled;
  for (const detail::KnownObservable& known : detail::known_observables)
    (known.name == "wall_fluxes" ? walled : periodic) += std::string(known.name) + " = true\n";
  const auto look = [&](const std::string& scene) {
    const Observed o = observe(parse_scene(scene), 1.0);
    for (const Measurement& measured : o.measurements) {
      EXPECT_TRUE(measured.name == "recorder" || detail::find_observable(measured.name) != nullptr) << measured.name;
      for (const Table& table : measured.tables) {
        EXPECT_NE(std::find(run_products.begin(), run_products.end(), "observe_" + table.name + ".csv"), run_products.end())
            << table.name;
        for (const Column& column : table.columns)
          EXPECT_EQ(column.values.size(), table.columns.front().values.size()) << table.name;
      }
    }
    return o.measurements.size() - 1;
  };
  std::string box = small_fluid(walled);
  box.replace(box.find("periodic"), 8, "walls");
  EXPECT_EQ(look(small_fluid(periodic)) + look(box), detail::known_observables.size());
}

/// Of no collisions the error is unknown, and not zero.
TEST(Observation, SaysThatNoDisksHaveCollided) {
  const std::string asked = "pressure = { every = 1e-7 }\ncollision_rate = { every = 1e-7 }";
  const Observed o = observe(parse_scene(small_fluid(asked, "specular", "2e-6")), 1e-6);
  EXPECT_EQ(o.totals.pair, 0U);
  for (const char* name : {"Z", "reduced", "Z_rate"}) {
    EXPECT_FALSE(o.scalar("pressure", name).value || o.scalar("pressure", name).error) << name;
    EXPECT_EQ(o.scalar("pressure", name).note, "no pair of disks has collided") << name;
  }
  EXPECT_EQ(o.value("collision_rate", "rate"), 0.0);
  EXPECT_FALSE(o.scalar("collision_rate", "rate").error);
  EXPECT_EQ(o.scalar("collision_rate", "rate").note, "no such pair of disks has collided");
  for (const Measurement& measured : o.measurements)
    EXPECT_EQ(measured.note, "no two disks have collided: another start may differ by more than the errors");
}

TEST(Observation, TellsWhyANumberIsMissing) {
  const Observed o =
      observe(parse_scene(small_fluid("pressure = true\ncollision_rate = true\nvelocity_moments = true", "reversal")), 1.0);
  for (const Measurement& measured : o.measurements)
    for (const Scalar& scalar : measured.scalars)
      EXPECT_TRUE(scalar.value || !scalar.note.empty()) << measured.name << "." << scalar.name;
  EXPECT_THAT(o.scalar("pressure", "Z_rate").note, HasSubstr("reversal"));
  EXPECT_THAT(o.scalar("pressure", "Z_walls").note, HasSubstr("no walls"));
}

TEST(Observation, HasNoTransportCoefficientsOfARunThatChanges) {
  const std::string scene =
      small_fluid("viscosity = { every = 0.02 }\nheat_conductivity = { every = 0.02 }\n", "specular", "40.0");
  const std::string change = "[[changes]]\ntime = 0.0\nscale_velocities = 2.0\n";
  const Observed steady = observe(parse_scene(scene), 1.0), heated = observe(parse_scene(scene + change), 1.0);
  for (const char* name : {"viscosity", "heat_conductivity"})
    for (const char* number : {"green_kubo", "einstein_helfand"}) {
      EXPECT_TRUE(steady.scalar(name, number).value) << name << "." << number;
      EXPECT_FALSE(heated.scalar(name, number).value) << name << "." << number << " with kT of the start";
      EXPECT_THAT(heated.scalar(name, number).note, HasSubstr("changes during the run"));
    }
  EXPECT_EQ(heated.of("viscosity").tables.at(0).columns.size(), 3U) << "lag and correlation of the flux, which need no kT";
}

TEST(Observation, SaysBesideTheNumbersThatErrorsAreOfOneStart) {
  for (const char* rule : {"reversal", "specular"}) {
    const Observed o = observe(parse_scene(small_fluid("pressure = true\nspeeds = true", rule)), 1.0);
    for (const char* name : {"pressure", "speeds"})
      EXPECT_EQ(o.of(name).note.find("another start may differ") != std::string::npos, rule == std::string("reversal")) << name;
  }
}

TEST(Observation, SaysBesideTheNumbersThatErrorsAreLowerBounds) {
  // A collision of masses 2 and 1/2 passes on 0.32 of the difference of their energies: 100 collisions of a disk are enough.
  for (const char* time : {"6.0", "60.0"}) {
    std::string scene = small_mixture("pressure = { every = 0.1 }\nspeeds = { every = 0.1 }");
    scene.replace(scene.find("6.0"), 3, time);
    const Observed o = observe(parse_scene(scene), 1.0);
    const bool is_short = 2.0 * static_cast<double>(o.totals.pair) / 32.0 < 100.0;
    EXPECT_EQ(is_short, time == std::string("6.0"));
    for (const char* name : {"pressure", "speeds"})
      EXPECT_EQ(o.of(name).note.find("errors of what depends on their speeds are lower bounds") != std::string::npos, is_short)
          << name;
  }
}

TEST(Observation, NamesOfSpeciesBecomeNamesThatFilesCanHave) {
  std::string scene = small_mixture("temperature = true");
  scene.replace(scene.find("\"big\""), 5, "\"a/b, c\"");
  EXPECT_NO_THROW((void)observe(parse_scene(scene), 1.0).scalar("temperature", "kT_a_b__c"));
  scene.replace(scene.find("\"small\""), 7, "\"a b; c\"");
  const Observed o = observe(parse_scene(scene), 1.0);
  EXPECT_NO_THROW((void)o.scalar("temperature", "kT_0"));
  EXPECT_NO_THROW((void)o.scalar("temperature", "kT_1"));
}

TEST(Observation, DefaultStepsAreFourMeanFreeTimesOrAShareOfTheRun) {
  // Enskog with Henderson's contact value at packing fraction 0.4, radius 1/2, m = 1.5, kT = 1: 1 / (2 sqrt pi rho g v_T).
  const double g = (1.0 - 7.0 * 0.4 / 16.0) / 0.36, rho = 4.0 * 0.4 / M_PI;
  const double free_time = std::sqrt(1.5) / (2.0 * std::sqrt(M_PI) * rho * g);
  const auto step = [](const std::string& time) {
    const Simulation simulation = make_simulation(parse_scene(small_fluid("temperature = true", "specular", time)));
    Observation observation(simulation);
    RunHooks hooks;
    observation.attach(hooks);
    return hooks.grids.at(0).step;
  };
  EXPECT_NEAR(step("1e6"), 4.0 * free_time, 1e-12);
  EXPECT_EQ(step("5.0"), 5.0 / 256.0);
}

}  // namespace
}  // namespace carom::test
