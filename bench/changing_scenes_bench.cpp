// Scenes that become others while they run, on both engines, from the same start to the same end each time: an inelastic gas that
// cools and clusters, and disks that grow until they are dense. What an engine has fitted to the scene, neighbourhoods, lists,
// cells and the width of its calendar, has to adapt.
//
// No time is reported of a run in which energy is not what went in and came out, or whose plan at the end is not what an
// independent search finds.

#include "observe/mechanics.hpp"
#include "support/engines.hpp"
#include "support/systems.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <string>
#include <vector>

namespace {

using namespace carom;

/// A start, the effects, and the time or number of collisions at which the run ends.
struct Change {
  test::System start;
  Effects effects;
  Instant end = forever;
  std::uint64_t collisions = test::no_limit;
};

/// Packing fraction 0.3, e = 0.8, 200 collisions of every disk: the gas has lost nearly all of its energy, and dense clusters
/// have formed. Collisions closer in time than any in the gas are elastic, or a cluster would stand still.
Change cooling(std::int64_t disks) {
  Change change{
      test::system_of(test::gas_scene(disks, 0.3, Boundary::periodic)), {}, forever, 100 * static_cast<std::uint64_t>(disks)};
  change.effects.collision.restitution = 0.8;
  change.effects.collision.elastic_below = 1e-4;
  return change;
}

/// Growth from packing fraction 0.3 to 0.65 while the thermal speed at the start would cross 19 radii. Nothing takes out the
/// heat.
Change growing(std::int64_t disks) {
  constexpr double rate = 0.05;
  Change change{test::system_of(test::gas_scene(disks, 0.3, Boundary::periodic)), {}, {}, test::no_limit};
  change.effects.growth = Growth{.rate = rate};
  change.end = Instant{(std::sqrt(0.65 / 0.3) - 1.0) / rate, 0.0};
  return change;
}

/// The number of disks in the most crowded of some squares over the mean, each with the area of sixteen disks.
double crowding(const Box& box, const State& state) {
  const auto disks = static_cast<double>(state.positions.cols());
  const auto squares = std::max<Eigen::Index>(1, static_cast<Eigen::Index>(std::sqrt(disks / 16.0)));
  Eigen::MatrixXd count = Eigen::MatrixXd::Zero(squares, squares);
  for (Eigen::Index i = 0; i < state.positions.cols(); ++i) {
    const Eigen::Vector2d place =
        (state.positions.col(i) - box.lower).cwiseQuotient(box.lengths()) * static_cast<double>(squares);
    count(std::min(static_cast<Eigen::Index>(place.x()), squares - 1),
          std::min(static_cast<Eigen::Index>(place.y()), squares - 1)) += 1.0;
  }
  return count.maxCoeff() / count.mean();
}

std::string fault_of(const Change& change, const test::AnyEngine& engine) {
  const Totals totals = engine.totals();
  const double before = kinetic_energy(change.start.disks, change.start.state);
  const double after = kinetic_energy(change.start.disks, engine.state());
  const double drift = after - before + totals.dissipated - totals.growth_energy;
  // A million terms, each rounded by 1e-16 of the sum of them at most.
  if (!(std::abs(drift) < 1e-10 * std::max(before, after))) return "the energy is not that of the account";
  if (std::abs(after / before - 1.0) < 0.5) return "the temperature has changed by less than a half";
  const std::vector<std::string> broken = engine.check_invariants();
  return broken.empty() ? "" : broken.front();
}

void run(benchmark::State& state, const std::string& name, const Change& change) {
  double seconds = 0.0, pairs = 0.0;
  for (auto _ : state) {
    const auto made = test::make_engine(name, change.start, change.effects);
    test::AnyEngine& engine = *made;
    const std::clock_t begin = std::clock();
    engine.run_until(change.end, change.collisions, test::no_limit);
    const double took = static_cast<double>(std::clock() - begin) / static_cast<double>(CLOCKS_PER_SEC);
    state.SetIterationTime(took);
    if (const std::string fault = fault_of(change, engine); !fault.empty()) {
      state.SkipWithError(fault.c_str());
      return;
    }
    seconds += took;
    pairs += static_cast<double>(engine.totals().pair);
    const State end = engine.state();
    state.counters["other/collision"] = static_cast<double>(engine.totals().other) / static_cast<double>(engine.totals().pair);
    state.counters["kT at the end"] = kinetic_temperature(change.start.box, change.start.disks, end);
    state.counters["crowding at the end"] = crowding(change.start.box, end);
  }
  state.counters["collisions/s"] = pairs / seconds;
}

void cooling_gas(benchmark::State& state, const std::string& engine) { run(state, engine, cooling(state.range(0))); }
void growing_disks(benchmark::State& state, const std::string& engine) { run(state, engine, growing(state.range(0))); }

BENCHMARK_CAPTURE(cooling_gas, general, "general")->Arg(10'000)->Iterations(3)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cooling_gas, textbook, "textbook")->Arg(10'000)->Iterations(1)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(growing_disks, general, "general")->Arg(10'000)->Iterations(3)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(growing_disks, textbook, "textbook")
    ->Arg(10'000)
    ->Iterations(1)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
