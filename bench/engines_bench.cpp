// Whole scenes on the textbook engine: smooth equal disks in a periodic box, after equilibration. Before any time is
// taken the energy is checked, the plan is held against an exhaustive search, and in the fluid the pressure against
// Kolafa & Rottner.

#include "effects/specular.hpp"
#include "engine/textbook.hpp"
#include "observe/mechanics.hpp"
#include "observe/pressure.hpp"
#include "support/systems.hpp"
#include "theory/equation_of_state.hpp"

#include <benchmark/benchmark.h>

#include <cmath>

namespace {

using namespace carom;

template <class Real>
void textbook(benchmark::State& state) {
  const auto disks = state.range(0);
  const double packing_fraction = static_cast<double>(state.range(1)) / 100.0;
  const test::System system = test::system_of(test::gas_scene(disks, packing_fraction, Boundary::periodic));
  TextbookEngine<Real, Specular> engine(system.box, system.disks, system.state);
  const auto n = static_cast<std::uint64_t>(disks);
  engine.run_until(forever, 10 * n, test::no_limit);  // 20 collisions per disk
  engine.reset_clock();

  const std::uint64_t checked = std::max<std::uint64_t>(20'000, 2 * n);
  engine.run_until(forever, checked, test::no_limit);
  const double kT = kinetic_temperature(system.box, system.disks, engine.state());
  const double Z = compressibility(engine.totals().virial / engine.now().high, static_cast<double>(disks), kT);
  const double expected = theory::kolafa_rottner(packing_fraction);
  // Ten standard errors of (Z - 1) / sqrt(collisions). At 0.7 the crystal that it starts from takes long to melt.
  const double allowed = 10.0 * (expected - 1.0) / std::sqrt(static_cast<double>(checked));
  const bool fluid = packing_fraction < 0.65;
  const double energy = kinetic_energy(system.disks, system.state);
  const double drift = std::abs(kinetic_energy(system.disks, engine.state()) / energy - 1.0);
  const bool kept = drift < 5000.0 * static_cast<double>(epsilon<Real>);  // 1e-12 in double precision
  if ((fluid && std::abs(Z - expected) > allowed) || !kept || !engine.check_invariants().empty()) {
    state.SkipWithError("the pressure, the energy or the plan is wrong");
    return;
  }

  const Totals before = engine.totals();
  for (auto _ : state) engine.run_until(forever, engine.totals().pair + 10'000, test::no_limit);
  const Totals after = engine.totals();
  const double pairs = static_cast<double>(after.pair - before.pair);
  state.counters["collisions/s"] = benchmark::Counter(pairs, benchmark::Counter::kIsRate);
  state.counters["stale/collision"] = static_cast<double>(after.stale - before.stale) / pairs;
  state.counters["crossings/collision"] = static_cast<double>(after.other - before.other) / pairs;
  state.counters["Z"] = Z;
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  for (const long disks : {1'000, 10'000, 100'000})
    for (const long percent : {30, 60, 70}) benchmark->Args({disks, percent});
  benchmark->ArgNames({"disks", "percent"})->Unit(benchmark::kMillisecond);
}

void precisions(benchmark::internal::Benchmark* benchmark) {
  benchmark->Args({1'000, 60})->ArgNames({"disks", "percent"})->Unit(benchmark::kMillisecond);
}

BENCHMARK(textbook<double>)->Apply(sizes);
BENCHMARK(textbook<double>)->Args({1'000'000, 60})->ArgNames({"disks", "percent"})->Unit(benchmark::kMillisecond);
BENCHMARK(textbook<float>)->Apply(precisions);
BENCHMARK(textbook<long double>)->Apply(precisions);
BENCHMARK(textbook<Quad>)->Apply(precisions);

}  // namespace
