// Whole scenes on both engines, after a run-up. Before any time is taken the energy is checked, the plan is held against
// an exhaustive search (against the lists where that would take too long), and in the fluid the pressure against Kolafa &
// Rottner.

#include "effects/specular.hpp"
#include "engine/engine.hpp"
#include "engine/textbook.hpp"
#include "observe/mechanics.hpp"
#include "observe/pressure.hpp"
#include "support/systems.hpp"
#include "theory/equation_of_state.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <typeinfo>

namespace {

using namespace carom;

using Fast = Engine<Elastic<Specular>, EqualDisks, PlainWorld>;
using FastOfAnySize = Engine<Elastic<Specular>, AnyDisks, PlainWorld>;
using Textbook = TextbookEngine<double>;

template <class Engine>
constexpr double rounding = epsilon<double>;
template <class Real>
constexpr double rounding<TextbookEngine<Real>> = static_cast<double>(epsilon<Real>);

constexpr double unknown = 0.0;  ///< a pressure that nothing is known of

template <class Engine>
struct Run {
  explicit Run(const test::System& start) : system(start), engine(start.box, start.disks, start.state) {}
  test::System system;
  Engine engine;
  double Z = 0.0;
  std::string fault;
};

/// Lets the engine run for so many collisions, then as many as tell the pressure where it is known, and looks at what has
/// come out.
template <class Engine>
void run_up_and_check(Run<Engine>& run, std::uint64_t collisions, double expected_Z) {
  const auto& [box, disks, start] = run.system;
  Engine& engine = run.engine;
  engine.run_until(forever, collisions, test::no_limit);
  engine.reset_clock();
  const std::uint64_t checked = expected_Z == unknown ? disks.count() : std::max<std::uint64_t>(20'000, 2 * disks.count());
  engine.run_until(forever, checked, test::no_limit);

  const State state = engine.state();
  const double drift = std::abs(kinetic_energy(disks, state) / kinetic_energy(disks, start) - 1.0);
  if (!(drift < 5000.0 * rounding<Engine>)) run.fault = "the energy has changed";  // 1e-12 in double precision
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
  std::shared_ptr<void> run;
};
Kept& kept() {
  static Kept last;
  return last;
}

template <class Engine, class MakeSystem>
Run<Engine>& running(const std::string& name, MakeSystem&& make_system, std::uint64_t run_up, double expected_Z) {
  Kept& last = kept();
  const std::string full_name = name + typeid(Engine).name();
  if (last.name != full_name) {
    last = {};
    const auto run = std::make_shared<Run<Engine>>(make_system());
    run_up_and_check(*run, run_up, expected_Z);
    last = {full_name, run};
  }
  return *std::static_pointer_cast<Run<Engine>>(last.run);
}

template <class Engine>
void time_events(benchmark::State& state, Run<Engine>& run) {
  if (!run.fault.empty()) {
    state.SkipWithError(run.fault.c_str());
    return;
  }
  Engine& engine = run.engine;
  const Totals before = engine.totals();
  for (auto _ : state) engine.run_until(forever, engine.totals().pair + 10'000, test::no_limit);
  const Totals after = engine.totals();
  const auto pairs = static_cast<double>(after.pair - before.pair);
  state.counters["collisions/s"] = benchmark::Counter(pairs, benchmark::Counter::kIsRate);
  state.counters["stale/collision"] = static_cast<double>(after.stale - before.stale) / pairs;
  state.counters["other/collision"] = static_cast<double>(after.other - before.other) / pairs;
  if constexpr (requires { engine.bytes(); })
    state.counters["bytes/disk"] = static_cast<double>(engine.bytes()) / static_cast<double>(run.system.disks.count());
  state.counters["Z"] = run.Z;
}

double packing_fraction_of(const benchmark::State& state) { return static_cast<double>(state.range(1)) / 100.0; }

/// Twenty collisions of every disk; of few disks more, so that the cages have found their width.
std::uint64_t usual_run_up(std::int64_t disks) {
  return std::max<std::uint64_t>(10 * static_cast<std::uint64_t>(disks), 400'000);
}

// ------------------------------------------------------------------------------------------------------ the scenes

/// Equal disks in a periodic box. At 0.7 the crystal of the start takes long to melt: no pressure is asked for.
template <class Engine>
void gas(benchmark::State& state) {
  const double packing_fraction = packing_fraction_of(state);
  const auto make = [&] { return test::system_of(test::gas_scene(state.range(0), packing_fraction, Boundary::periodic)); };
  const auto Z = packing_fraction < 0.63 ? theory::kolafa_rottner_finite(packing_fraction, state.range(0)) : unknown;
  time_events(state,
              running<Engine>(fmt::format("gas {} {}", state.range(0), state.range(1)), make, usual_run_up(state.range(0)), Z));
}

/// Three quarters of the box empty. The disks fly apart, so the run-up is short: two collisions of every disk.
template <class Engine>
void quarter(benchmark::State& state) {
  const auto make = [&] {
    return test::system_of(test::quarter_scene(state.range(0), packing_fraction_of(state), Boundary::periodic));
  };
  time_events(state, running<Engine>(fmt::format("quarter {} {}", state.range(0), state.range(1)), make,
                                     static_cast<std::uint64_t>(state.range(0)), unknown));
}

template <class Engine>
void two_sizes(benchmark::State& state) {
  const auto make = [&] {
    return test::system_of(test::two_sizes_scene(state.range(0), packing_fraction_of(state), Boundary::periodic));
  };
  time_events(state, running<Engine>(fmt::format("two sizes {} {}", state.range(0), state.range(1)), make,
                                     usual_run_up(state.range(0)), unknown));
}

/// The textbook engine's cells are as wide as the large disk, so its run-up is short too.
template <class Engine>
void one_large(benchmark::State& state) {
  const auto make = [&] { return test::one_large_system(state.range(0), packing_fraction_of(state), Boundary::periodic); };
  time_events(state, running<Engine>(fmt::format("one large {} {}", state.range(0), state.range(1)), make,
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

BENCHMARK(gas<Fast>)->Apply(gases<1'000, 10'000, 100'000, 1'000'000>);
BENCHMARK(gas<Textbook>)->Apply(gases<1'000, 10'000, 100'000, 1'000'000>);
BENCHMARK(gas<FastOfAnySize>)->Apply(at<60, 1'000, 100'000>);  // what radii and masses of one's own cost
BENCHMARK(quarter<Fast>)->Apply(at<60, 10'000, 100'000>);
BENCHMARK(quarter<Textbook>)->Apply(at<60, 10'000, 100'000>);
BENCHMARK(two_sizes<FastOfAnySize>)->Apply(at<40, 10'000, 100'000>);
BENCHMARK(two_sizes<Textbook>)->Apply(at<40, 10'000, 100'000>);
BENCHMARK(one_large<FastOfAnySize>)->Apply(at<40, 1'000, 10'000, 100'000>);
BENCHMARK(one_large<Textbook>)->Apply(at<40, 1'000>);  // 10'000 take it half a minute per 10'000 collisions
BENCHMARK(gas<TextbookEngine<float>>)->Apply(at<60, 1'000>);
BENCHMARK(gas<TextbookEngine<long double>>)->Apply(at<60, 1'000>);
BENCHMARK(gas<TextbookEngine<Quad>>)->Apply(at<60, 1'000>);

}  // namespace
