// Whole scenes on both engines, after a run-up. Before any time is taken the energy is checked, the plan is held against
// an exhaustive search (against the lists where that would take too long), and in the fluid the pressure against Kolafa &
// Rottner.

#include "core/real.hpp"
#include "observe/mechanics.hpp"
#include "observe/pressure.hpp"
#include "support/engines.hpp"
#include "support/systems.hpp"
#include "theory/equation_of_state.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

namespace {

using namespace carom;

/// The rounding of the numbers that an engine computes with.
double rounding_of(const std::string& engine) {
  if (engine == "textbook-float") return epsilon<float>;
  return engine == "textbook-quad" ? static_cast<double>(epsilon<Quad>) : epsilon<double>;
}

constexpr double unknown = 0.0;  ///< a pressure without a reference

struct Run {
  Run(const std::string& name, const test::System& start)
      : system(start), engine(test::make_engine(name, start)), rounding(rounding_of(name)) {}
  test::System system;
  std::unique_ptr<test::AnyEngine> engine;
  double rounding;
  double Z = 0.0;
  std::string fault;
};

/// Lets the engine run for so many collisions, then as many as determine the pressure where there is a reference, and checks the
/// result.
void run_up_and_check(Run& run, std::uint64_t collisions, double expected_Z) {
  const auto& [box, disks, start] = run.system;
  test::AnyEngine& engine = *run.engine;
  engine.run_until(forever, collisions, test::no_limit);
  engine.reset_clock();
  const std::uint64_t checked = expected_Z == unknown ? disks.count() : std::max<std::uint64_t>(20'000, 2 * disks.count());
  engine.run_until(forever, checked, test::no_limit);

  const State state = engine.state();
  const double drift = std::abs(kinetic_energy(disks, state) / kinetic_energy(disks, start) - 1.0);
  if (!(drift < 5000.0 * run.rounding)) run.fault = "the energy has changed";  // 1e-12 in double precision
  const std::vector<std::string> broken = engine.check_invariants();
  if (!broken.empty()) run.fault = broken.front();
  const double kT = kinetic_temperature(box, disks, state);
  run.Z = compressibility(engine.totals().virial / engine.now().high, static_cast<double>(disks.count()), kT);
  if (expected_Z == unknown) return;
  // Ten standard errors of (Z - 1) / sqrt(collisions).
  const double allowed = 10.0 * (expected_Z - 1.0) / std::sqrt(static_cast<double>(checked));
  if (!(std::abs(run.Z - expected_Z) <= allowed)) run.fault = "the pressure is wrong";
}

/// A benchmark is called several times with more and more iterations: one run then goes on from call to call. Only the last
/// one is kept.
struct Kept {
  std::string name;
  std::unique_ptr<Run> run;
};
Kept& kept() {
  static Kept last;
  return last;
}

template <class MakeSystem>
Run& running(const std::string& engine, const std::string& name, MakeSystem&& make_system, std::uint64_t run_up,
             double expected_Z) {
  Kept& last = kept();
  const std::string full_name = engine + " " + name;
  if (last.name != full_name) {
    last = {};
    last.run = std::make_unique<Run>(engine, make_system());
    run_up_and_check(*last.run, run_up, expected_Z);
    last.name = full_name;
  }
  return *last.run;
}

void time_events(benchmark::State& state, Run& run) {
  if (!run.fault.empty()) {
    state.SkipWithError(run.fault.c_str());
    return;
  }
  test::AnyEngine& engine = *run.engine;
  const Totals before = engine.totals();
  for (auto _ : state) engine.run_until(forever, engine.totals().pair + 10'000, test::no_limit);
  const Totals after = engine.totals();
  const auto pairs = static_cast<double>(after.pair - before.pair);
  state.counters["collisions/s"] = benchmark::Counter(pairs, benchmark::Counter::kIsRate);
  state.counters["stale/collision"] = static_cast<double>(after.stale - before.stale) / pairs;
  state.counters["other/collision"] = static_cast<double>(after.other - before.other) / pairs;
  state.counters["bytes/disk"] = static_cast<double>(engine.bytes()) / static_cast<double>(run.system.disks.count());
  state.counters["Z"] = run.Z;
}

double packing_fraction_of(const benchmark::State& state) { return static_cast<double>(state.range(1)) / 100.0; }

/// Twenty collisions of every disk; of few disks more, so that the neighbourhoods have found their width.
std::uint64_t usual_run_up(std::int64_t disks) {
  return std::max<std::uint64_t>(10 * static_cast<std::uint64_t>(disks), 400'000);
}

// ------------------------------------------------------------------------------------------------------ the scenes

/// Equal disks in a periodic box. At 0.7 the crystal of the start takes long to melt: no pressure is asked for.
void gas(benchmark::State& state, const std::string& engine) {
  const double packing_fraction = packing_fraction_of(state);
  const auto make = [&] { return test::system_of(test::gas_scene(state.range(0), packing_fraction, Boundary::periodic)); };
  const auto Z = packing_fraction < 0.63 ? theory::kolafa_rottner_finite(packing_fraction, state.range(0)) : unknown;
  time_events(state,
              running(engine, fmt::format("gas {} {}", state.range(0), state.range(1)), make, usual_run_up(state.range(0)), Z));
}

/// The same disks but for the last digit of one radius: the price of a radius and a mass for each disk.
void gas_of_any_size(benchmark::State& state, const std::string& engine) {
  const double packing_fraction = packing_fraction_of(state);
  const auto make = [&] {
    test::System system = test::system_of(test::gas_scene(state.range(0), packing_fraction, Boundary::periodic));
    system.disks.radius.front() = std::nextafter(system.disks.radius.front(), 0.0);
    return system;
  };
  time_events(state, running(engine, fmt::format("any size {} {}", state.range(0), state.range(1)), make,
                             usual_run_up(state.range(0)), theory::kolafa_rottner_finite(packing_fraction, state.range(0))));
}

/// Three quarters of the box empty. The disks fly apart, so the run-up is short: two collisions of every disk.
void quarter(benchmark::State& state, const std::string& engine) {
  const auto make = [&] {
    return test::system_of(test::quarter_scene(state.range(0), packing_fraction_of(state), Boundary::periodic));
  };
  time_events(state, running(engine, fmt::format("quarter {} {}", state.range(0), state.range(1)), make,
                             static_cast<std::uint64_t>(state.range(0)), unknown));
}

void two_sizes(benchmark::State& state, const std::string& engine) {
  const auto make = [&] {
    return test::system_of(test::two_sizes_scene(state.range(0), packing_fraction_of(state), Boundary::periodic));
  };
  time_events(state, running(engine, fmt::format("two sizes {} {}", state.range(0), state.range(1)), make,
                             usual_run_up(state.range(0)), unknown));
}

/// The textbook engine's cells are as wide as the large disk, so its run-up is short too.
void one_large(benchmark::State& state, const std::string& engine) {
  const auto make = [&] { return test::one_large_system(state.range(0), packing_fraction_of(state), Boundary::periodic); };
  time_events(state, running(engine, fmt::format("one large {} {}", state.range(0), state.range(1)), make,
                             static_cast<std::uint64_t>(state.range(0)), unknown));
}

template <long... sizes>
void gases(benchmark::internal::Benchmark* benchmark) {
  for (const long disks : {sizes...})
    for (const long percent : {30, 60, 70}) benchmark->Args({disks, percent});
  benchmark->ArgNames({"disks", "percent"})->Unit(benchmark::kMillisecond);
}

template <long percent, long... sizes>
void at(benchmark::internal::Benchmark* benchmark) {
  for (const long disks : {sizes...}) benchmark->Args({disks, percent});
  benchmark->ArgNames({"disks", "percent"})->Unit(benchmark::kMillisecond);
}

#define ENGINE_BENCHMARK(scene, engine) BENCHMARK_CAPTURE(scene, engine, #engine)
ENGINE_BENCHMARK(gas, fast)->Apply(gases<1'000, 10'000, 100'000, 1'000'000>);
ENGINE_BENCHMARK(gas, textbook)->Apply(gases<1'000, 10'000, 100'000, 1'000'000>);
ENGINE_BENCHMARK(gas_of_any_size, fast)->Apply(at<60, 1'000, 100'000>);
ENGINE_BENCHMARK(quarter, fast)->Apply(at<60, 10'000, 100'000>);
ENGINE_BENCHMARK(quarter, textbook)->Apply(at<60, 10'000, 100'000>);
ENGINE_BENCHMARK(two_sizes, fast)->Apply(at<40, 10'000, 100'000>);
ENGINE_BENCHMARK(two_sizes, textbook)->Apply(at<40, 10'000, 100'000>);
ENGINE_BENCHMARK(one_large, fast)->Apply(at<40, 1'000, 10'000, 100'000>);
ENGINE_BENCHMARK(one_large, textbook)->Apply(at<40, 1'000>);  // 10'000 take it half a minute per 10'000 collisions
BENCHMARK_CAPTURE(gas, float, "textbook-float")->Apply(at<60, 1'000>);
BENCHMARK_CAPTURE(gas, long_double, "textbook-long-double")->Apply(at<60, 1'000>);
BENCHMARK_CAPTURE(gas, quad, "textbook-quad")->Apply(at<60, 1'000>);

}  // namespace
