// Stretches of a run with samples, and runs that their caller stops: the bits are those of the schedule and of a run in one
// piece.

#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <stdexcept>
#include <vector>

namespace carom::test {
namespace {

Scene crowd(double time, double sample_every) {
  Scene scene =
      scene_of(box_of(10.0, 10.0, Boundary::periodic), {species_of(40, 0.4, 1.0, RandomPositions{}, MaxwellVelocities{1.0})});
  scene.run.time = time;
  scene.run.sample_every = sample_every;
  return scene;
}

struct Sample {
  std::uint64_t k;
  std::uint64_t collisions;
  double virial;
  std::string hash;
  friend bool operator==(const Sample&, const Sample&) = default;
};

SamplingGrid grid_into(std::vector<Sample>& samples, double step) {
  return {.step = step, .sample = [&samples](std::uint64_t k, const State& state, const Totals& totals) {
            samples.push_back({k, totals.pair, totals.virial, state_hash(state)});
          }};
}

std::vector<std::uint64_t> numbers(const std::vector<Sample>& samples) {
  std::vector<std::uint64_t> all;
  for (const Sample& sample : samples) all.push_back(sample.k);
  return all;
}

/// 3 * 0.1 is later than 0.3 by its rounding, and 7 * 0.7 earlier than 4.9.
TEST(SampledStretch, HasNoSampleBeforeTheFirst) {
  Simulation simulation = make_simulation(crowd(1.0, 0.1));
  std::vector<Sample> samples;
  EXPECT_EQ(simulation.run_sampled(-1.0, grid_into(samples, 0.1)), StopReason::time);
  EXPECT_TRUE(samples.empty());
  EXPECT_EQ(simulation.time(), 0.0);
}

TEST(RunSampled, HasTheSamplesAndTheEndOfTheSchedule) {
  for (const auto& [time, step] : {std::pair{0.3, 0.1}, std::pair{4.9, 0.7}, std::pair{5.0, 0.001}, std::pair{2.05, 0.25}}) {
    const Scene scene = crowd(time, step);
    std::vector<Sample> scheduled, sampled;
    Simulation by_schedule = make_simulation(scene);
    RunHooks hooks;
    hooks.grids.push_back(grid_into(scheduled, step));
    run_schedule(by_schedule, hooks);

    Simulation simulation = make_simulation(scene);
    EXPECT_EQ(simulation.run_sampled(time, grid_into(sampled, step)), StopReason::time);
    EXPECT_EQ(sampled, scheduled) << time << " by " << step;
    EXPECT_EQ(simulation.time(), time);
    EXPECT_EQ(state_hash(simulation.state()), state_hash(by_schedule.state()));
  }
}

TEST(RunSampled, BeginsWhereTheSimulationStands) {
  Simulation simulation = make_simulation(crowd(5.0, 0.5));
  std::vector<Sample> samples;
  simulation.run_until(0.9);
  EXPECT_EQ(simulation.run_sampled(2.1, grid_into(samples, 0.3)), StopReason::time);  // 3 * 0.3 is 0.9 to rounding
  EXPECT_EQ(numbers(samples), (std::vector<std::uint64_t>{3, 4, 5, 6, 7}));
  samples.clear();
  simulation.run_sampled(3.0, grid_into(samples, 0.25));
  EXPECT_EQ(numbers(samples), (std::vector<std::uint64_t>{9, 10, 11, 12}));
}

TEST(RunSampled, TakesTheRangeThatItIsGiven) {
  Simulation simulation = make_simulation(crowd(5.0, 0.5));
  std::vector<Sample> samples;
  EXPECT_EQ(simulation.run_sampled(2.0, grid_into(samples, 0.1), {}, {.first = 4, .stride = 3, .most = 2}),
            StopReason::condition);
  EXPECT_EQ(numbers(samples), (std::vector<std::uint64_t>{6, 9}));
  EXPECT_DOUBLE_EQ(simulation.time(), 0.9);
  EXPECT_EQ(simulation.run_sampled(2.0, grid_into(samples, 0.1), {}, {.first = 10, .stride = 3}), StopReason::time);
  EXPECT_EQ(numbers(samples), (std::vector<std::uint64_t>{6, 9, 12, 15, 18}));
}

TEST(RunSampled, RefusesStepsAndStridesThatAreNone) {
  Simulation simulation = make_simulation(crowd(5.0, 0.5));
  EXPECT_THROW(simulation.run_sampled(1.0, {.step = 0.0, .sample = {}}), std::invalid_argument);
  EXPECT_THROW(simulation.run_sampled(1.0, {.step = -1.0, .sample = {}}), std::invalid_argument);
  EXPECT_THROW(simulation.run_sampled(std::numeric_limits<double>::infinity(), {.step = 1.0, .sample = {}}),
               std::invalid_argument);
  EXPECT_THROW(simulation.run_sampled(1.0, {.step = 0.1, .sample = {}}, {}, {.stride = 0}), std::invalid_argument);
  EXPECT_EQ(simulation.time(), 0.0);
}

/// The caller is asked by the clock: where it stops the run does not matter to the bits.
TEST(RunLimits, ProceedStopsARunThatThenGoesOnToTheSameBits) {
  for (const std::string& engine : engines_covering(crowd(5.0, 0.5))) {
    Simulation stopped = make_simulation(crowd(5.0, 0.5), engine);
    int asked = 0;
    EXPECT_EQ(stopped.run_until(1e9, {.proceed = [&] { return ++asked < 2; }}), StopReason::interrupted) << engine;
    EXPECT_EQ(asked, 2);
    const double end = stopped.time() + 1.0;
    stopped.run_until(end);
    Simulation whole = make_simulation(crowd(5.0, 0.5), engine);
    whole.run_until(end);
    EXPECT_EQ(state_hash(stopped.state()), state_hash(whole.state())) << engine;
  }
}

TEST(RunLimits, WhatProceedThrowsLeavesTheSimulationWhole) {
  struct Thrown {};
  Simulation simulation = make_simulation(crowd(5.0, 0.5));
  EXPECT_THROW(simulation.run_until(1e9, {.proceed = []() -> bool { throw Thrown{}; }}), Thrown);
  EXPECT_TRUE(simulation.check_invariants().empty());
  Simulation stepped = make_simulation(crowd(5.0, 0.5), FixedStep{"guarded", 0.01});
  EXPECT_EQ(stepped.run_until(1e9, {.proceed = [] { return false; }}), StopReason::interrupted);
}

}  // namespace
}  // namespace carom::test
