// Checks that need further runs: velocities reversed, disks in another order, and a late sample.

#include "studies/hard_cases/checks.hpp"

#include <carom/simulation.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace carom {

namespace {

using Order = std::vector<std::size_t>;

/// Returns the scene with the disks of a run in another order: one species that lists them all.
Scene relabelled(const Scene& scene, const EngineRun& run, const Order& order) {
  Scene other = scene;
  Species all;
  all.name = "all";
  all.count = static_cast<std::int64_t>(order.size());
  ListedPositions positions;
  ListedVelocities velocities;
  for (const std::size_t i : order) {
    const auto column = static_cast<Eigen::Index>(i);
    all.radii.push_back(run.disks.radius[i]);
    all.masses.push_back(run.disks.mass[i]);
    positions.values.emplace_back(run.start.positions.col(column));
    velocities.values.emplace_back(run.start.velocities.col(column));
  }
  all.positions = positions;
  all.velocities = velocities;
  other.species = {all};
  other.run.equilibrate.reset();
  return other;
}

State in_order(const State& state, const Order& order) {
  State ordered = state;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto from = static_cast<Eigen::Index>(order[k]), to = static_cast<Eigen::Index>(k);
    ordered.positions.col(to) = state.positions.col(from);
    ordered.velocities.col(to) = state.velocities.col(from);
  }
  return ordered;
}

/// Backwards, and dealt out anew: every k-th disk in turn, k about the golden section of their number.
std::vector<Order> other_orders(std::size_t disks) {
  Order backwards(disks);
  std::iota(backwards.rbegin(), backwards.rend(), std::size_t{0});
  if (disks < 3) return {backwards};
  auto stride = static_cast<std::size_t>(0.618 * static_cast<double>(disks));
  while (std::gcd(stride, disks) != 1) ++stride;
  Order dealt;
  for (std::size_t k = 0; k < disks; ++k) dealt.push_back((k * stride + 1) % disks);
  return {backwards, dealt};
}

double off_when_relabelled(const Scene& scene, const EngineRun& run) {
  double largest = 0.0;
  for (const Order& order : other_orders(run.disks.count())) {
    const EngineRun rerun = run_in_engine(relabelled(scene, run, order), run.engine, {});
    largest = std::max(largest, difference(scene.box, rerun.end, in_order(run.end, order)));
  }
  return largest;
}

double off_when_reversed(const Scene& scene, const EngineRun& run) {
  State turned = run.end;
  turned.velocities = -turned.velocities;
  Simulation backwards = make_simulation(scene, turned, run.engine);
  backwards.run_until(run.report.time);
  State start = backwards.state();
  start.velocities = -start.velocities;
  return difference(scene.box, start, run.start);
}

/// Returns the error of the clock at a sample so late that no run would reach it one by one.
double off_at_late_sample(const Scene& scene, const EngineRun& run, const LateSample& expected) {
  Simulation late = make_simulation(scene, run.engine);
  late.run_until_sample(expected.number, scene.run.sample_every.value_or(0.0));
  return std::abs(late.time() - expected.time);
}

}  // namespace

std::vector<CaseCheck> checks_of_reruns(const HardCase& hard_case, const Scene& scene, const EngineRun& run) {
  std::vector<CaseCheck> checks;
  const Expectations& expect = hard_case.expect;
  if (expect.reversed) checks.push_back(within("reversed", run, off_when_reversed(scene, run), widened(*expect.reversed, run)));
  if (expect.relabelled)
    checks.push_back(within("relabelled", run, off_when_relabelled(scene, run), widened(*expect.relabelled, run)));
  if (expect.late_sample) checks.push_back(within("late sample", run, off_at_late_sample(scene, run, *expect.late_sample), 0.0));
  return checks;
}

}  // namespace carom
