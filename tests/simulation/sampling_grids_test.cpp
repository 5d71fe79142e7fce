// Grids of samples beside the scene's own: every sample at its exact time, all collisions before it handed on, no trace in the
// bits.

#include "support/systems.hpp"

#include <carom/simulation.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <stdexcept>
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
