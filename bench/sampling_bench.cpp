// What Python's calls are held against (bench/python.py): the same work in C++.

#include "scene/presets.hpp"

#include <carom/simulation.hpp>

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace {

using carom::Simulation;

carom::Scene gas_of(std::int64_t disks) {
  return carom::parse_scene(carom::preset("gas"), "gas.toml", {"disks.0.count=" + std::to_string(disks)});
}

/// Samples of positions and velocities, 5,001 of 64 disks and 201 of 10,000, into new memory as a caller of sample() gets it.
void sampled(benchmark::State& state) {
  const bool small = state.range(0) == 64;
  const carom::Scene scene = small ? carom::parse_scene(carom::preset("box")) : gas_of(state.range(0));
  const double step = small ? 0.001 : 0.005, until = small ? 5.0 : 1.0;
  const auto frames = static_cast<std::size_t>(std::llround(until / step)) + 1;
  const std::size_t frame = 2 * static_cast<std::size_t>(scene.disk_count());
  for (auto _ : state) {
    state.PauseTiming();
    Simulation simulation = carom::make_simulation(scene);
    state.ResumeTiming();
    const auto positions = std::make_unique_for_overwrite<double[]>(frames * frame);
    const auto velocities = std::make_unique_for_overwrite<double[]>(frames * frame);
    std::size_t taken = 0;
    simulation.run_sampled(until, {.step = step, .sample = [&](std::uint64_t, const carom::State& now, const carom::Totals&) {
                                     std::copy_n(now.positions.data(), frame, positions.get() + taken * frame);
                                     std::copy_n(now.velocities.data(), frame, velocities.get() + taken * frame);
                                     ++taken;
                                   }});
    if (taken != frames) state.SkipWithError("not every sample was taken");
  }
}
BENCHMARK(sampled)->Arg(64)->Arg(10'000)->Unit(benchmark::kMillisecond);

/// One call of run_until(), which nothing can stop.
void in_one_call(benchmark::State& state) {
  const carom::Scene scene = gas_of(state.range(0));
  for (auto _ : state) {
    state.PauseTiming();
    Simulation simulation = carom::make_simulation(scene);
    state.ResumeTiming();
    simulation.run_until(2e5 / static_cast<double>(state.range(0)));
    benchmark::DoNotOptimize(simulation.time());
  }
}
BENCHMARK(in_one_call)->Arg(1'000)->Unit(benchmark::kMillisecond);

}  // namespace
