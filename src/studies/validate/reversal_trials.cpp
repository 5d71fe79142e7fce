// Trials of the reversal rule. Equal masses only exchange velocities, so no distribution relaxes; pressure is that of smooth
// disks nevertheless; the rate and the decay of the autocorrelation follow from the frozen velocities.

#include "studies/validate/gas.hpp"
#include "studies/validate/speed_law.hpp"
#include "theory/equation_of_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace carom::validation {

namespace {

/// Moments of the relative speed g over all pairs.
struct PairMoments {
  double first = 0.0, second = 0.0, third = 0.0;
};
PairMoments pair_moments(const Eigen::Matrix2Xd& v) {
  PairMoments sum;
  const Eigen::Index n = v.cols();
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < i; ++j) {
      const double g = (v.col(i) - v.col(j)).norm();
      sum.first += g, sum.second += g * g, sum.third += g * g * g;
    }
  const double pairs = 0.5 * static_cast<double>(n) * static_cast<double>(n - 1);
  return {sum.first / pairs, sum.second / pairs, sum.third / pairs};
}

/// Returns the speeds in rising order, which equal masses never change.
std::vector<double> sorted_speeds(const Eigen::Matrix2Xd& v) {
  std::vector<double> speeds(static_cast<std::size_t>(v.cols()));
  for (Eigen::Index i = 0; i < v.cols(); ++i) speeds[static_cast<std::size_t>(i)] = v.col(i).norm();
  std::sort(speeds.begin(), speeds.end());
  return speeds;
}

TrialResult frozen(const std::string& trial, const Effort& effort) {
  TrialResult result{.trial = trial};
  constexpr std::int64_t disks = 256;
  constexpr double eta = 0.3;
  const Gas gas{.disks = disks,
                .packing_fraction = eta,
                .collisions = effort.collisions(4e6),
                .observe = {{.name = "pressure"}, {.name = "collision_rate"}, {.name = "velocity_autocorrelation"}},
                .rule = CollisionRule::reversal,
                .velocities = FixedSpeed{std::numbers::sqrt2}};
  const theory::Microcanonical law(disks, true);
  SpeedCounts counts(law);
  std::vector<std::unique_ptr<Observable>> own;
  own.push_back(std::make_unique<Snapshots>(4.0, counts));
  std::vector<double> before;
  const Found found = run(scene_of(gas, effort.seed_of(0)), effort, result, std::move(own),
                          [&](State& start) { before = sorted_speeds(start.velocities); });
  const std::string what = fmt::format("{} equal disks under reversal, at first equally fast", disks);
  Check relaxed = speed_check(what, counts);
  relaxed.name += " (must not fit)";
  relaxed.judged = Judged::disagrees;
  result.checks.push_back(std::move(relaxed));
  const Eigen::Matrix2Xd velocities = found.simulation.state().velocities;
  const std::vector<double> after = sorted_speeds(velocities);
  double changed = 0.0;
  for (std::size_t k = 0; k < before.size(); ++k) changed = std::max(changed, std::abs(after[k] - before[k]));
  result.checks.push_back({.name = "largest change of a speed in the ordered set of all, " + what,
                           .theory = "none, to the last bit: partners exchange velocities",
                           .source = "docs/model.md",
                           .measured = {changed, 0.0}});
  const double Z = theory::kolafa_rottner_finite(eta, disks);
  result.checks.push_back(
      {.name = "Z, " + what,
       .theory = "that of smooth disks",
       .source = "r . dp is the same; Kolafa & Rottner, Mol. Phys. 104, 3435 (2006), with the first term in 1/N",
       .expected = Z,
       .measured = found.measured("pressure", "Z"),
       .reference_error = theory::kolafa_rottner_error(eta)});
  const PairMoments g = pair_moments(velocities);
  const Measured rate = found.measured("collision_rate", "rate");
  const double expected = 4.0 * (Z - 1.0) * g.first / std::numbers::pi;
  result.checks.push_back({.name = "collisions of a disk per time, " + what,
                           .theory = "4 (Z - 1) <g> / pi sigma, <g> the mean relative speed of the frozen velocities",
                           .source = "docs/model.md",
                           .expected = expected,
                           .measured = rate,
                           .reference_error = 1e-5 * expected});
  const Measured slope = found.measured("velocity_autocorrelation", "initial_slope");
  const double square = velocities.colwise().squaredNorm().mean();
  result.checks.push_back(
      {.name = "initial slope of the velocity autocorrelation over the rate, " + what,
       .theory = "<g^3> / 2 <g> <v^2>, which is 3/2 of a Maxwell gas",
       .source = "docs/model.md",
       .expected = g.third / g.first / (2.0 * square),
       .measured = {slope.value / rate.value,
                    slope.value / rate.value * std::hypot(slope.error / slope.value, rate.error / rate.value)},
       .error_is_bound = true});
  result.curves.push_back(counts.density("speeds-reversal", "reversal, equal masses"));
  result.curves.push_back(speed_curve("speeds-reversal", law, square));
  return result;
}

TrialResult tensor(const std::string& trial, const Effort& effort) {
  TrialResult result{.trial = trial};
  const Gas gas{.disks = 256,
                .packing_fraction = 0.4,
                .collisions = effort.collisions(3e6),
                .observe = {{.name = "temperature"}, {.name = "pressure"}},
                .rule = CollisionRule::reversal};
  double x_to_y = 0.0;
  const auto ratio = [](const Eigen::Matrix2Xd& v) { return v.row(0).squaredNorm() / v.row(1).squaredNorm(); };
  const Found found = run(scene_of(gas, effort.seed_of(0)), effort, result, {}, [&](State& start) {
    start.velocities.row(1) *= 0.5;
    x_to_y = ratio(start.velocities);
  });
  const std::string what = "256 equal disks under reversal, four times as much energy along x";
  result.checks.push_back({.name = "K_x / K_y at the end over that at the start, " + what,
                           .theory = "1: every collision conserves the tensor sum of m v_a v_b",
                           .source = "docs/model.md",
                           .expected = 1.0,
                           .measured = {ratio(found.simulation.state().velocities) / x_to_y, 0.0},
                           .allowance = 1e-12,
                           .allowance_for = "256 roundings of 1e-16, summed in another order"});
  const Measured xx = found.measured("pressure", "P_xx"), yy = found.measured("pressure", "P_yy");
  const double quotient = xx.value / yy.value;
  result.checks.push_back({.name = "P_xx / P_yy, " + what,
                           .theory = "K_x / K_y in a square box",
                           .source = "docs/model.md",
                           .expected = x_to_y,
                           .measured = {quotient, quotient * std::hypot(xx.error / xx.value, yy.error / yy.value)},
                           .error_is_bound = true});
  return result;
}

TrialResult unequal(const std::string& trial, const Effort& effort) {
  TrialResult result{.trial = trial};
  constexpr double N = 64.0;
  const Scene scene{.box = {.upper = {14.0, 14.0}},
                    .species = {{.name = "heavy", .count = 32, .radius = 0.5, .mass = 1.0, .velocities = FixedSpeed{1.0}},
                                {.name = "light", .count = 32, .radius = 0.5, .mass = 0.25, .velocities = FixedSpeed{1.0}}},
                    .effects = {.collision = {.rule = CollisionRule::reversal}},
                    .run = run_of(effort.collisions(2e6), 300.0, effort.seed_of(0)),
                    .observe = {{.name = "temperature"}, {.name = "velocity_moments"}}};
  double x_to_y = 0.0;
  const auto energies = [](const State& state, const Disks& disks) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (Eigen::Index i = 0; i < state.velocities.cols(); ++i)
      sum += disks.mass[static_cast<std::size_t>(i)] * state.velocities.col(i).cwiseAbs2();
    return sum;
  };
  Disks disks;
  disks.mass.assign(32, 1.0);
  disks.mass.insert(disks.mass.end(), 32, 0.25);
  const Found found = run(scene, effort, result, {}, [&](State& start) {
    start.velocities.row(1) *= 0.7;
    const Eigen::Vector2d sum = energies(start, disks);
    x_to_y = sum.x() / sum.y();
  });
  const Eigen::Vector2d end = energies(found.simulation.state(), disks);
  const std::string what = "64 disks of masses 1 and 1/4 under reversal, between walls, unequal energy along x and y";
  result.checks.push_back({.name = "K_x / K_y at the end over that at the start, " + what,
                           .theory = "1: each axis keeps its own temperature",
                           .source = "docs/model.md",
                           .expected = 1.0,
                           .measured = {end.x() / end.y() / x_to_y, 0.0},
                           .allowance = 20.0 * std::sqrt(effort.collisions(2e6)) * 1.1e-16,
                           .allowance_for = "rounding: a random walk of one unit of rounding of the energy in each collision"});
  const double kT = found.scalar("temperature", "kT").value.value();
  for (const char* species : {"heavy", "light"}) {
    result.checks.push_back({.name = fmt::format("kT of the {} disks, {}", species, what),
                             .theory = "that of all: masses share the energy",
                             .source = "docs/model.md",
                             .expected = kT,
                             .measured = found.measured("temperature", fmt::format("kT_{}", species))});
    for (const char* axis : {"x", "y"})
      result.checks.push_back(
          {.name = fmt::format("kurtosis of v_{} of the {} disks, {}", axis, species, what),
           .theory = "3 N / (N + 2): with other masses present, each axis relaxes to Maxwell's law at fixed energy",
           .source = "m v_x^2 / 2 K_x has the distribution Beta(1/2, (N - 1)/2)",
           .expected = 3.0 * N / (N + 2.0),
           .measured = found.measured("velocity_moments", fmt::format("kurtosis_{}_{}", axis, species))});
  }
  return result;
}

}  // namespace

void add_reversal(std::vector<Trial>& trials) {
  const std::string group = "the reversal rule";
  trials.push_back({"reversal-frozen", group, false, [](const Effort& effort) { return frozen("reversal-frozen", effort); }});
  trials.push_back({"reversal-tensor", group, false, [](const Effort& effort) { return tensor("reversal-tensor", effort); }});
  trials.push_back({"reversal-masses", group, false, [](const Effort& effort) { return unequal("reversal-masses", effort); }});
}

}  // namespace carom::validation
