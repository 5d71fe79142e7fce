// The fixed-step methods: disk-steps per second over N, packing fraction and time step, so that the exact
// engines are not compared with slow ones. Before a time is taken the energy is checked, and up to 2,000 disks the grid's
// trajectory is held against the search of all pairs, bit for bit.

#include "effects/specular.hpp"
#include "observe/mechanics.hpp"
#include "stepper/backtrack.hpp"
#include "stepper/grid.hpp"
#include "stepper/guarded.hpp"
#include "stepper/naive.hpp"
#include "stepper/stepper.hpp"
#include "stepper/swept.hpp"
#include "support/systems.hpp"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <string>

namespace {

using namespace carom;

using Naive = NaiveStep<Specular, WallMeets::edge>;
using Guarded = GuardedStep<Specular, AllPairs>;
using Grid = GuardedStep<Specular, ClosePairs>;
using Backtrack = BacktrackStep<Specular>;
using Swept = SweptStep<Specular>;

/// Empty where the grid does what the search of all pairs does, and energy stays.
template <class Step>
std::string fault(const test::System& s, double dt) {
  constexpr int steps = 200;
  Stepper<Step> stepper(s.box, s.disks, s.state, dt);
  stepper.run_until({steps * dt, 0.0}, test::no_limit, test::no_limit);
  const State state = stepper.state();
  // A rounding for each of the collisions of a step, were they all in one direction.
  const double rounding = 1e-15 * (1.0 + static_cast<double>(stepper.totals().pair));
  if (!(std::abs(kinetic_energy(s.disks, state) / kinetic_energy(s.disks, s.state) - 1.0) < rounding))
    return "the energy has changed";
  if (s.disks.count() > 2'000) return "";
  Stepper<Guarded> twin(s.box, s.disks, s.state, dt);
  twin.run_until({steps * dt, 0.0}, test::no_limit, test::no_limit);
  const bool same = twin.state().positions == state.positions && twin.state().velocities == state.velocities;
  return same || !std::is_same_v<Step, Grid> ? "" : "the grid misses a contact";
}

/// Arguments: disks, packing fraction in per cent, dt in millionths of sigma / v_T.
template <class Step>
void steps(benchmark::State& state) {
  const auto disks = static_cast<std::int64_t>(state.range(0));
  const double dt = 1e-6 * static_cast<double>(state.range(2));
  const test::System s = test::system_of(test::gas_scene(disks, 0.01 * static_cast<double>(state.range(1)), Boundary::periodic));
  if (const std::string what = fault<Step>(s, dt); !what.empty()) {
    state.SkipWithError(what.c_str());
    return;
  }
  // From a fluid, not from the lattice of the start, in which no disk is near another.
  Stepper<Grid> run_up(s.box, s.disks, s.state, 0.003);
  run_up.run_until({1.0, 0.0}, test::no_limit, test::no_limit);
  Stepper<Step> stepper(s.box, s.disks, run_up.state(), dt);
  std::uint64_t step = 0;
  for (auto _ : state) stepper.run_until(Instant::product(++step, dt), test::no_limit, test::no_limit);
  state.counters["disk-steps/s"] =
      benchmark::Counter(static_cast<double>(step) * static_cast<double>(disks), benchmark::Counter::kIsRate);
}

BENCHMARK_TEMPLATE(steps, Naive)->Args({100, 60, 1000})->Args({1000, 60, 1000});
BENCHMARK_TEMPLATE(steps, Guarded)->Args({100, 60, 1000})->Args({1000, 60, 1000});
BENCHMARK_TEMPLATE(steps, Backtrack)->ArgsProduct({{1000, 100'000}, {10, 60}, {1000, 10'000}});
BENCHMARK_TEMPLATE(steps, Swept)->ArgsProduct({{1000, 100'000}, {10, 60}, {1000, 10'000}});
BENCHMARK_TEMPLATE(steps, Grid)->ArgsProduct({{100, 1000, 10'000, 100'000}, {10, 30, 60}, {100, 1000, 10'000}});

}  // namespace
