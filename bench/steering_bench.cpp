// The cost of leading a simulation by small steps: of a call of run_until() without anything to do, which must not depend on the
// number of disks, and of reading the state into memory that is used again.

#include "support/systems.hpp"

#include <benchmark/benchmark.h>
#include <carom/simulation.hpp>

namespace {

using namespace carom;

Simulation gas(const benchmark::State& state) {
  Simulation simulation = make_simulation(test::gas_scene(state.range(0), 0.4, Boundary::periodic));
  simulation.run_until(1e-3);
  return simulation;
}

void enter_run_until(benchmark::State& state) {
  Simulation simulation = gas(state);
  const double now = simulation.time();
  for (auto _ : state) simulation.run_until(now);
}

void read_state(benchmark::State& state) {
  const Simulation simulation = gas(state);
  State seen;
  for (auto _ : state) simulation.state(seen);
}

BENCHMARK(enter_run_until)->Arg(1'000)->Arg(100'000);
BENCHMARK(read_state)->Arg(1'000)->Arg(100'000);

}  // namespace
