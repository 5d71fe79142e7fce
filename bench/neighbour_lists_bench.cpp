// Neighbour lists alone, in a gas at equilibrium: one disk gets a new neighbourhood, and all lists are made anew. Before any time
// is taken the lists are held against a search through all disks.

#include "neighbours/neighbour_lists.hpp"
#include "neighbours/neighbourhood_tuning.hpp"
#include "support/engines.hpp"
#include "support/systems.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

namespace {

using namespace carom;

constexpr std::int32_t disks = 10'000;

/// Lists of a gas, with neighbourhoods of the width that an engine begins with.
class Gas {
 public:
  explicit Gas(double packing_fraction)
      : system_(test::system_of(test::gas_scene(disks, packing_fraction, Boundary::periodic))),
        axes_{{system_.box, 0, 0.0}, {system_.box, 1, 0.0}},
        lists(axes_[0], axes_[1], system_.disks.radius) {
    const auto engine = test::make_engine("fast", system_);
    engine->run_until(forever, 10 * static_cast<std::uint64_t>(disks), test::no_limit);
    const State state = engine->state();
    std::uniform_real_distribution<double> angle(0.0, 2.0 * std::numbers::pi);
    half_width = HalfWidthSearch::first_half_width(1.0, system_.box.area() / disks);
    for (Eigen::Index i = 0; i < disks; ++i) {
      const double direction = angle(random);
      // A disk at the edge of its neighbourhood, and its next neighbourhood half a half-width ahead of it.
      const double way[2] = {1.5 * half_width * std::cos(direction), 1.5 * half_width * std::sin(direction)};
      centres.push_back({steps(0, state.positions(0, i)), steps(1, state.positions(1, i))});
      moved.push_back({steps(0, state.positions(0, i) + way[0]), steps(1, state.positions(1, i) + way[1])});
    }
    lists.rebuild(half_width, centres);
  }

  /// Whether the lists of some disks, chosen at random, are right.
  [[nodiscard]] bool lists_are_right() {
    std::uniform_int_distribution<std::int32_t> any(0, disks - 1);
    for (int k = 0; k < 100; ++k) {
      const std::int32_t i = any(random);
      std::vector<std::int32_t> listed(lists.ids(i), lists.ids(i) + lists.count(i)), near;
      std::sort(listed.begin(), listed.end());
      for (std::int32_t j = 0; j < disks; ++j)
        if (j != i && lists.near(i, j)) near.push_back(j);
      if (listed != near) return false;
    }
    return true;
  }

 private:
  [[nodiscard]] std::int32_t steps(int axis, double position) const {
    const double length = axes_[axis].upper - axes_[axis].lower;
    const double inside = position - length * std::floor((position - axes_[axis].lower) / length);
    return static_cast<std::int32_t>(axes_[axis].at(inside) >> 32);
  }

  test::System system_;
  FixedAxis axes_[2];

 public:
  NeighbourLists lists;
  double half_width = 0.0;
  std::vector<NeighbourhoodCentre> centres, moved;
  std::mt19937_64 random{1};
};

double packing_fraction_of(const benchmark::State& state) { return static_cast<double>(state.range(0)) / 100.0; }

/// Every disk in turn, in random order, to a new neighbourhood and in the next round back to the old one.
void move_neighbourhood(benchmark::State& state) {
  Gas gas(packing_fraction_of(state));
  std::vector<std::int32_t> order(static_cast<std::size_t>(disks));
  for (std::int32_t i = 0; i < disks; ++i) order[static_cast<std::size_t>(i)] = i;
  std::shuffle(order.begin(), order.end(), gas.random);
  std::size_t k = 0;
  bool forth = true;
  const auto move_next = [&] {
    const std::int32_t i = order[k];
    const auto at = static_cast<std::size_t>(i);
    benchmark::DoNotOptimize(gas.lists.move_neighbourhood(i, forth ? gas.moved[at] : gas.centres[at]));
    if (++k == order.size()) k = 0, forth = !forth;
  };
  for (std::int32_t n = 0; n < disks / 2; ++n) move_next();
  if (!gas.lists_are_right()) {
    state.SkipWithError("a list differs from a search through all disks");
    return;
  }
  const std::uint64_t before = gas.lists.changes();
  for (auto _ : state) move_next();
  const auto moves = static_cast<double>(state.iterations());
  state.counters["changes/move"] = static_cast<double>(gas.lists.changes() - before) / moves;
  state.counters["entries/disk"] = static_cast<double>(gas.lists.entries()) / disks;
}

void rebuild(benchmark::State& state) {
  Gas gas(packing_fraction_of(state));
  if (!gas.lists_are_right()) {
    state.SkipWithError("a list differs from a search through all disks");
    return;
  }
  for (auto _ : state) gas.lists.rebuild(gas.half_width, gas.centres);
  state.counters["per disk"] =
      benchmark::Counter(disks, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.counters["entries/disk"] = static_cast<double>(gas.lists.entries()) / disks;
  state.counters["bytes/disk"] = static_cast<double>(gas.lists.bytes()) / disks;
}

void densities(benchmark::internal::Benchmark* benchmark) { benchmark->ArgName("percent")->Arg(5)->Arg(30)->Arg(60); }

BENCHMARK(move_neighbourhood)->Apply(densities);
BENCHMARK(rebuild)->Apply(densities);

}  // namespace
