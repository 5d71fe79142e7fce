// Grids of samples beside the scene's own: every sample at its exact time, all collisions before it handed on, no trace in the
// bits.

#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <carom/simulation.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace carom::test {
namespace {

Scene gas_until(double time) {
  Scene scene = gas_scene(30, 0.3, Boundary::periodic);
  scene.run.time = time;
  scene.run.sample_every.reset();
  return scene;
}

TEST(SamplingGrids, EachHasItsOwnTimesBesideThoseOfTheScene) {
  Scene scene = gas_until(1.0);
  scene.run.sample_every = 0.25;
  Simulation simulation = make_simulation(scene);
  std::vector<std::pair<char, double>> samples;
  RunHooks hooks;
  hooks.sample = [&](std::uint64_t, const State& state) { samples.emplace_back('s', state.time); };
  hooks.grids.push_back({0.5, [&](std::uint64_t k, const State& state, const Totals&) {
                           EXPECT_EQ(state.time, 0.5 * static_cast<double>(k));
                           samples.emplace_back('a', state.time);
                         }});
  hooks.grids.push_back(
      {0.375, [&](std::uint64_t, const State& state, const Totals&) { samples.emplace_back('b', state.time); }});
  const RunResult result = run_schedule(simulation, hooks);
  const std::vector<std::pair<char, double>> expected = {{'s', 0.0},   {'a', 0.0}, {'b', 0.0}, {'s', 0.25},
                                                         {'b', 0.375}, {'s', 0.5}, {'a', 0.5}, {'s', 0.75},
                                                         {'b', 0.75},  {'s', 1.0}, {'a', 1.0}};
  EXPECT_EQ(samples, expected);
  EXPECT_EQ(result.samples, 5U) << "those of the scene alone";
}

TEST(SamplingGrids, EveryCollisionUpToASampleHasBeenHandedOn) {
  Simulation simulation = make_simulation(gas_until(5.0));
  std::uint64_t pairs = 0;
  RunHooks hooks;
  hooks.events = [&](std::span<const Event> events) { pairs += events.size(); };
  hooks.grids.push_back({0.3, [&](std::uint64_t, const State& state, const Totals& totals) {
                           EXPECT_EQ(pairs, totals.pair) << "at " << state.time;
                         }});
  run_schedule(simulation, hooks);
  EXPECT_GT(pairs, 50U);
}

TEST(SamplingGrids, MultiplesOfTheScenesStepAreItsOwnSamples) {
  Scene scene = gas_until(3.0);
  scene.run.sample_every = 0.1;
  Simulation simulation = make_simulation(scene);
  std::vector<State> own, third;
  RunHooks hooks;
  hooks.sample = [&](std::uint64_t, const State& state) { own.push_back(state); };
  hooks.grids.push_back({0.3, [&](std::uint64_t, const State& state, const Totals&) { third.push_back(state); }});
  run_schedule(simulation, hooks);
  ASSERT_EQ(third.size(), 11U);
  for (std::size_t k = 0; k < third.size(); ++k) EXPECT_TRUE(same_bits(third[k], own[3 * k])) << k;
}

/// On the fast engine, on one that is driven, and on one that knows no other way than to give the whole state.
TEST(SamplingGrids, MayLookAtVelocitiesAlone) {
  for (const char* engine : {"auto", "textbook"})
    for (const bool grows : {false, true}) {
      Scene scene = gas_until(3.0);
      if (grows) scene.effects.growth.emplace().rate = 0.01;
      Simulation simulation = make_simulation(scene, engine);
      std::vector<State> alone, whole;
      RunHooks hooks;
      hooks.grids.push_back({0.3, [&](std::uint64_t, const State& state, const Totals&) { alone.push_back(state); }, true});
      hooks.grids.push_back({0.1, [&](std::uint64_t, const State& state, const Totals&) { whole.push_back(state); }});
      hooks.grids.push_back({0.7, [&](std::uint64_t, const State& state, const Totals&) { alone.push_back(state); }, true});
      run_schedule(simulation, hooks);
      EXPECT_EQ(whole.size(), 31U);
      std::size_t without_positions = 0;
      for (const State& state : alone) {
        Simulation twin = make_simulation(scene, engine);
        twin.run_until(state.time);
        const State expected = twin.state();
        EXPECT_EQ(state.velocities, expected.velocities);
        EXPECT_EQ(state.scale, expected.scale);
        without_positions += static_cast<std::size_t>(state.positions.cols() == 0);
      }
      EXPECT_EQ(without_positions > 0, std::string(engine) == "auto");
    }
}

TEST(SamplingGrids, LogarithmicBlocksAreTheStatesAtTheirTimes) {
  Scene scene = gas_until(16.0);
  scene.run.sample_log = SampleLog{.base = 2.0, .per_block = 4, .block = 8.0};
  Simulation simulation = make_simulation(scene), twin = make_simulation(scene);
  std::vector<double> times, blocks;
  RunHooks hooks;
  hooks.sample = [&](std::uint64_t k, const State& state) {
    EXPECT_EQ(k, times.size());
    times.push_back(state.time);
    twin.run_until(state.time);
    EXPECT_TRUE(same_bits(state, twin.state())) << k;
  };
  hooks.grids.push_back({8.0, [&](std::uint64_t, const State& state, const Totals&) { blocks.push_back(state.time); }});
  const RunResult result = run_schedule(simulation, hooks);
  EXPECT_THAT(times, testing::ElementsAre(0.0, 1.0, 2.0, 4.0, 8.0, 9.0, 10.0, 12.0, 16.0));
  EXPECT_THAT(blocks, testing::ElementsAre(0.0, 8.0, 16.0));
  EXPECT_EQ(result.samples, last_sample(scene.run) + 1);
}

/// The states just after every so many collisions, as a run that ends there leaves them.
TEST(SamplingGrids, CountedInCollisionsTheyAreTheStatesJustAfter) {
  for (const std::uint64_t every : {1U, 7U, 100U}) {
    Scene scene = gas_until(0.0);
    scene.run.time.reset();
    scene.run.collisions = 200;
    scene.run.sample_every_collisions = every;
    Simulation simulation = make_simulation(scene), twin = make_simulation(scene);
    std::uint64_t next = 0;
    RunHooks hooks;
    hooks.sample = [&](std::uint64_t k, const State& state) {
      EXPECT_EQ(k, next++);
      EXPECT_EQ(simulation.totals().pair, k * every);
      if (k > 0) twin.run_until(1e9, {.collisions = k * every});
      EXPECT_TRUE(same_bits(state, twin.state())) << k;
      EXPECT_EQ(state.time, twin.time());
    };
    const RunResult result = run_schedule(simulation, hooks);
    EXPECT_EQ(next, 200 / every + 1);
    EXPECT_EQ(result.samples, last_sample(scene.run) + 1);
    EXPECT_EQ(result.stopped, StopReason::collisions);
  }
}

TEST(SamplingGrids, CountedInCollisionsTheyEndWithTheTimeToo) {
  Scene scene = gas_until(5.0);
  scene.run.sample_every_collisions = 10;
  Simulation simulation = make_simulation(scene);
  std::vector<std::pair<char, double>> samples;
  RunHooks hooks;
  hooks.sample = [&](std::uint64_t, const State& state) { samples.emplace_back('s', state.time); };
  hooks.grids.push_back({2.5, [&](std::uint64_t, const State& state, const Totals&) { samples.emplace_back('g', state.time); }});
  const RunResult result = run_schedule(simulation, hooks);
  EXPECT_EQ(result.stopped, StopReason::time);
  EXPECT_EQ(simulation.time(), 5.0);
  EXPECT_EQ(result.samples, simulation.totals().pair / 10 + 1);
  EXPECT_EQ(samples.size(), result.samples + 3);
  for (std::size_t i = 1; i < samples.size(); ++i) EXPECT_LE(samples[i - 1].second, samples[i].second);
}

TEST(SamplingGrids, AStepOfSeveralCollisionsGivesTheLastOfThem) {
  Scene scene = gas_until(5.0);
  scene.run.sample_every_collisions = 1;
  Simulation simulation = make_simulation(scene, FixedStep{"guarded", 0.1});
  std::uint64_t most = 0, samples = 0;
  RunHooks hooks;
  hooks.sample = [&](std::uint64_t k, const State&) {
    EXPECT_EQ(k, simulation.totals().pair);
    EXPECT_TRUE(k > most || k == 0);
    most = k;
    ++samples;
  };
  run_schedule(simulation, hooks);
  EXPECT_EQ(most, simulation.totals().pair);
  EXPECT_LT(samples, most) << "or no step had several";
}

TEST(SamplingGrids, LeaveNoTraceInTheBits) {
  const auto end = [](bool sampled) {
    Simulation simulation = make_simulation(gas_until(5.0));
    RunHooks hooks;
    if (sampled) hooks.grids.push_back({0.0137, [](std::uint64_t, const State&, const Totals&) {}});
    run_schedule(simulation, hooks);
    return simulation.state();
  };
  EXPECT_EQ(end(true).positions, end(false).positions);
  EXPECT_EQ(end(true).velocities, end(false).velocities);
}

TEST(SamplingGrids, StepsThatAreNoneAreRefused) {
  for (const double step : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    Simulation simulation = make_simulation(gas_until(1.0));
    RunHooks hooks;
    hooks.grids.push_back({step, {}});
    EXPECT_THROW(run_schedule(simulation, hooks), std::invalid_argument) << step;
  }
}

}  // namespace
}  // namespace carom::test
