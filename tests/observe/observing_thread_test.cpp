// Observables on a thread of their own: the same numbers to the last bit, and errors that come out.

#include "observe/observed_system.hpp"
#include "support/same_measurements.hpp"

#include <gmock/gmock.h>

#include <cstdint>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace carom::test {
namespace {

const std::string everything =
    "temperature = { every = 0.1 }\npressure = { every = 0.3 }\nfree_flight = true\nviscosity = true\nheat_conductivity = true\n"
    "mean_square_displacement = { every = 0.05 }\nvelocity_autocorrelation = { every = 0.07 }\nradial_distribution = { every = "
    "0.5, "
    "range = 2.0 }\n";

TEST(ObservingThread, GivesTheSameNumbersToTheLastBit) {
  // More collisions than are handed over at once.
  const Scene scene = parse_scene(small_fluid(everything, "specular", "700.0"));
  const auto measured = [&](bool beside) {
    Simulation simulation = make_simulation(scene);
    Observation observation(simulation);
    RunHooks hooks;
    beside ? observation.attach_on_thread(hooks) : observation.attach(hooks);
    run_schedule(simulation, hooks);
    EXPECT_GT(simulation.totals().pair, 40'000U);
    return observation.results();
  };
  expect_same_measurements(measured(true), measured(false));
}

TEST(ObservingThread, SeveralSeeTheSameCollisions) {
  const Scene scene = parse_scene(small_fluid("free_flight = true\nviscosity = true\n", "specular", "700.0"));
  Simulation simulation = make_simulation(scene);
  Observation beside(simulation), also_beside(simulation), in_the_run(simulation);
  RunHooks hooks;
  beside.attach_on_thread(hooks);  // collisions are written where this one wants them
  also_beside.attach_on_thread(hooks);
  in_the_run.attach(hooks);
  run_schedule(simulation, hooks);
  const std::vector<Measurement> expected = in_the_run.results();
  expect_same_measurements(beside.results(), expected);
  expect_same_measurements(also_beside.results(), expected);
}

TEST(ObservingThread, IsSavedWithAllThatWasHandedOver) {
  const Scene scene = parse_scene(small_fluid(everything, "specular", "50.0"));
  const auto saved = [&](bool beside) {
    Simulation simulation = make_simulation(scene);
    Observation observation(simulation);
    std::string all;
    RunHooks hooks;
    beside ? observation.attach_on_thread(hooks) : observation.attach(hooks);
    hooks.checkpoint = [&](const SavingMoment& moment) {
      if (!moment.ended && (!all.empty() || moment.progress.totals.pair < 2000)) return;
      std::ostringstream out;
      observation.save(out);
      all += out.str();
    };
    run_schedule(simulation, hooks);
    return all;
  };
  const std::string expected = saved(false);
  EXPECT_GT(expected.size(), 10'000U);
  EXPECT_TRUE(saved(true) == expected);
}

/// Throws at the sample it is told.
class Failing final : public Observable {
 public:
  explicit Failing(std::uint64_t at) : at_(at) {}
  [[nodiscard]] std::string name() const override { return "failing"; }
  [[nodiscard]] double step() const override { return 0.1; }
  void sample(const State&, const Totals&) override {
    if (samples_++ == at_) throw std::runtime_error("no more");
  }
  [[nodiscard]] Measurement finish(double, const Totals&) override { return {.name = name()}; }

 private:
  std::uint64_t at_, samples_ = 0;
};

TEST(ObservingThread, WhatAnObservableThrowsComesOut) {
  for (const std::uint64_t at : {0U, 3U, 50U}) {  // the last sample is number 50: nothing is handed over after it
    Simulation simulation = make_simulation(parse_scene(small_fluid("")));
    Observation observation(simulation);
    observation.add(std::make_unique<Failing>(at));
    RunHooks hooks;
    observation.attach_on_thread(hooks);
    const auto run_and_tell = [&] {
      run_schedule(simulation, hooks);
      (void)observation.results();
    };
    EXPECT_THROW(run_and_tell(), std::runtime_error) << at;
  }
}

TEST(ObservingThread, WhatWasThrownComesOutAsOftenAsOneTries) {
  Simulation simulation = make_simulation(parse_scene(small_fluid("")));
  Observation observation(simulation);
  observation.add(std::make_unique<Failing>(0));
  RunHooks hooks;
  observation.attach_on_thread(hooks);
  for (int time = 0; time < 10; ++time) {
    simulation.reset_clock();
    EXPECT_THROW(run_schedule(simulation, hooks); (void)observation.results(), std::runtime_error) << time;
  }
}

TEST(ObservingThread, ARunThatEndsEarlyEndsItsObservingThread) {
  Simulation simulation = make_simulation(parse_scene(small_fluid(everything)));
  Observation observation(simulation);
  RunHooks hooks;
  observation.attach_on_thread(hooks);
  hooks.proceed = [](const Progress&) -> bool { throw std::runtime_error("stopped"); };
  hooks.block = [](const Progress&) { throw std::runtime_error("stopped"); };
  EXPECT_THROW(run_schedule(simulation, hooks), std::runtime_error);
}

}  // namespace
}  // namespace carom::test
