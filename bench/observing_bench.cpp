// What observing costs: seconds per pair collision of a gas of 10,000 disks (or as many as it says), with nothing observed, with
// each observable that follows collisions, with all of them, and with those that look at states, each at its default step; in the
// thread of the run, and beside it. The same stretch of one trajectory runs with and without them in turns, from a simulation
// made anew each time: stretches that follow each other differ by some per cent, since an engine tries other neighbourhoods from
// time to time. What counts is the median of the ratios. The time is that of a clock on the wall; beside it stands the ratio of
// the processor time of the run's thread alone, which other programs disturb less. Before a time is taken one run is looked at:
// energy is kept, and the rate that was observed is that of the totals.

#include "core/seconds.hpp"
#include "observe/mechanics.hpp"
#include "support/systems.hpp"

#include <benchmark/benchmark.h>
#include <carom/carom.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace {

using namespace carom;

constexpr std::uint64_t collisions = 2'000'000;
constexpr int turns = 11;

Scene scene_with(const std::vector<std::string>& observables, double packing_fraction, std::int64_t disks) {
  Scene scene = test::gas_scene(disks, packing_fraction, Boundary::periodic);
  scene.run.time.reset();
  scene.run.collisions = collisions;
  for (const std::string& name : observables) {
    scene.observe.emplace_back().name = name;
    if (name == "radial_distribution") scene.observe.back().range = 5.0;
  }
  return scene;
}

std::vector<Measurement> observe(Simulation& simulation, bool beside) {
  Observation observation(simulation);
  RunHooks hooks;
  beside ? observation.attach_on_thread(hooks) : observation.attach(hooks);
  run_schedule(simulation, hooks);
  return observation.results();
}

std::string fault(Simulation simulation) {
  const double before = kinetic_energy(simulation.disks(), simulation.state());
  for (const Measurement& measured : observe(simulation, false)) {
    if (measured.name != "collision_rate") continue;
    const double rate =
        2.0 * static_cast<double>(collisions) / (static_cast<double>(simulation.disks().count()) * simulation.time());
    if (!(std::abs(measured.scalars[0].value.value_or(0.0) / rate - 1.0) < 0.05)) return "the rate is not that of the totals";
  }
  // A rounding for each collision, were they all in one direction.
  const double drift = kinetic_energy(simulation.disks(), simulation.state()) / before - 1.0;
  return std::abs(drift) < 1e-16 * static_cast<double>(collisions) ? "" : "the energy has changed";
}

void observing(benchmark::State& state, const std::vector<std::string>& observables, bool beside = false) {
  const Scene scene = scene_with(observables, 0.01 * static_cast<double>(state.range(0)), state.range(1));
  const auto begun = [&] {
    Simulation simulation = make_simulation(scene);
    simulation.run_until(1e6, {.collisions = collisions / 4});
    simulation.reset_clock();
    return simulation;
  };
  if (const std::string what = fault(begun()); !what.empty()) {
    state.SkipWithError(what.c_str());
    return;
  }
  std::vector<double> ratios, thread_ratios, plain, observed, plain_thread, observed_thread;
  const auto time = [&](auto&& go, std::vector<double>& times, std::vector<double>& thread_times) {
    Simulation simulation = begun();
    const auto began = std::chrono::steady_clock::now();
    const double thread_began = thread_seconds();
    go(simulation);
    thread_times.push_back((thread_seconds() - thread_began) / collisions);
    times.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count() / collisions);
  };
  const auto without = [&] { time([](Simulation& simulation) { run_schedule(simulation); }, plain, plain_thread); };
  const auto with = [&] {
    time([&](Simulation& simulation) { benchmark::DoNotOptimize(observe(simulation, beside)); }, observed, observed_thread);
  };
  for (auto _ : state) {
    const bool first = plain.size() % 2 == 0;  // they take turns in coming first
    first ? without() : with();
    first ? with() : without();
    ratios.push_back(observed.back() / plain.back());
    thread_ratios.push_back(observed_thread.back() / plain_thread.back());
    state.SetIterationTime(observed.back() * collisions);
  }
  const auto middle = [](std::vector<double>& values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
  };
  state.counters["s/collision"] = middle(observed);
  state.counters["unobserved"] = middle(plain);
  state.counters["ratio"] = middle(ratios);
  state.counters["ratio of thread"] = middle(thread_ratios);
  state.counters["ratio of fastest"] =
      *std::min_element(observed.begin(), observed.end()) / *std::min_element(plain.begin(), plain.end());
}

void beside(benchmark::State& state, const std::vector<std::string>& observables) { observing(state, observables, true); }

using Names = std::vector<std::string>;
const Names collisions_alone = {"pressure", "collision_rate", "free_flight", "viscosity", "heat_conductivity"};
const Names velocities = {"temperature", "speeds", "velocity_moments"};
const Names displacements = {"mean_square_displacement", "velocity_autocorrelation"};
BENCHMARK_CAPTURE(observing, nothing, Names{})->Args({60, 10'000})->Iterations(turns)->UseManualTime();
BENCHMARK_CAPTURE(observing, collision_rate, Names{"collision_rate"})->Args({60, 10'000})->Iterations(turns)->UseManualTime();
BENCHMARK_CAPTURE(observing, free_flight, Names{"free_flight"})->Args({60, 10'000})->Iterations(turns)->UseManualTime();
BENCHMARK_CAPTURE(observing, pressure, Names{"pressure"})->Args({60, 10'000})->Iterations(turns)->UseManualTime();
BENCHMARK_CAPTURE(observing, viscosity, Names{"viscosity"})->Args({60, 10'000})->Iterations(turns)->UseManualTime();
BENCHMARK_CAPTURE(observing, heat_conductivity, Names{"heat_conductivity"})
    ->Args({60, 10'000})
    ->Iterations(turns)
    ->UseManualTime();
BENCHMARK_CAPTURE(observing, all_of_these, collisions_alone)
    ->Args({60, 1'000})
    ->Args({60, 10'000})
    ->Args({60, 100'000})
    ->Iterations(turns)
    ->UseManualTime();
BENCHMARK_CAPTURE(observing, velocities, velocities)->Args({60, 10'000})->Iterations(turns)->UseManualTime();
BENCHMARK_CAPTURE(observing, displacements, displacements)->Args({60, 10'000})->Iterations(turns)->UseManualTime();
BENCHMARK_CAPTURE(observing, radial_distribution, Names{"radial_distribution"})
    ->Args({60, 10'000})
    ->Iterations(turns)
    ->UseManualTime();
BENCHMARK_CAPTURE(beside, all_of_these, collisions_alone)
    ->Args({60, 1'000})
    ->Args({60, 10'000})
    ->Args({60, 100'000})
    ->Iterations(turns)
    ->UseManualTime();
BENCHMARK_CAPTURE(beside, velocities, velocities)->Args({60, 10'000})->Iterations(turns)->UseManualTime();
BENCHMARK_CAPTURE(beside, displacements, displacements)->Args({60, 10'000})->Iterations(turns)->UseManualTime();
BENCHMARK_CAPTURE(beside, radial_distribution, Names{"radial_distribution"})
    ->Args({60, 10'000})
    ->Iterations(turns)
    ->UseManualTime();

}  // namespace
