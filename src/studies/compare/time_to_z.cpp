#include "studies/compare/time_to_z.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

struct Exact {
  double Z = 0.0;
  double scatter = 0.0;  ///< C: relative standard deviation of Z times the root of the number of collisions
  double collisions_per_time = 0.0;
};

/// Returns the statistics of all exact double-precision runs of the engine that runs the scene.
std::optional<Exact> exact_of(const Comparison& comparison) {
  std::vector<double> Z;
  double pairs = 0.0, time = 0.0;
  for (const MethodRun& run : comparison.runs) {
    if (run.method.name != comparison.plan.horizon.engine || run.pair == 0) continue;
    Z.push_back(run.Z);
    pairs += static_cast<double>(run.pair);
    time += run.time;
  }
  if (Z.size() < 4) return std::nullopt;
  const auto n = static_cast<double>(Z.size());
  double mean = 0.0, squares = 0.0;
  for (const double z : Z) mean += z / n;
  for (const double z : Z) squares += (z - mean) * (z - mean);
  const double deviation = std::sqrt(squares / (n - 1.0));
  return Exact{mean, deviation / mean * std::sqrt(pairs / n), pairs / time};
}

std::vector<const MethodSummary*> with_pressure(const std::vector<MethodSummary>& summaries, const std::string& method) {
  std::vector<const MethodSummary*> steps;
  for (const MethodSummary& summary : summaries)
    if (summary.method.name == method && summary.Z) steps.push_back(&summary);
  std::sort(steps.begin(), steps.end(), [](const auto* a, const auto* b) { return a->method.dt < b->method.dt; });
  return steps;
}

/// Largest bias, over Z - 1, that counts as proportional to dt: collisions then still transfer nearly the right momentum.
constexpr double lawful_share = 0.1;

/// The bias of Z of the guarded methods: slope times dt up to the largest dt for which that holds.
struct BiasLaw {
  double slope = 0.0;  ///< relative bias of Z per dt
  double up_to = 0.0;
};

/// Fits a line through the origin, each point weighted by its error; needs three points.
std::optional<BiasLaw> bias_law(const std::vector<const MethodSummary*>& steps, const Exact& exact) {
  double numerator = 0.0, denominator = 0.0;
  BiasLaw law;
  int points = 0;
  for (const auto* step : steps) {  // by rising dt
    if (!step->Z_bias || std::abs(step->Z_bias->value) > lawful_share * (exact.Z - 1.0) / exact.Z) break;
    const double error = std::max(1e-12, step->Z_bias->error);
    numerator += step->method.dt * step->Z_bias->value / (error * error);
    denominator += step->method.dt * step->method.dt / (error * error);
    law.up_to = step->method.dt;
    ++points;
  }
  if (points < 3 || !(denominator > 0.0)) return std::nullopt;
  law.slope = numerator / denominator;
  return law;
}

/// Seconds per unit of time with that step: between the steps that were run by a power law, beyond them by 1/dt.
double seconds_per_time(const std::vector<const MethodSummary*>& steps, double dt) {
  if (dt <= steps.front()->method.dt) return steps.front()->seconds_per_time * steps.front()->method.dt / dt;
  for (std::size_t k = 1; k < steps.size(); ++k) {
    const MethodSummary &fine = *steps[k - 1], &coarse = *steps[k];
    if (dt > coarse.method.dt) continue;
    const double at = std::log(dt / fine.method.dt) / std::log(coarse.method.dt / fine.method.dt);
    return std::exp(std::lerp(std::log(fine.seconds_per_time), std::log(coarse.seconds_per_time), at));
  }
  return steps.back()->seconds_per_time;
}

/// Collisions after which chance alone is that large, as time.
double time_for_chance(const Exact& exact, double chance) {
  return std::pow(exact.scatter / chance, 2) / exact.collisions_per_time;
}

/// The best of the steps that were looked at.
struct Best {
  const Exact& exact;
  const std::vector<const MethodSummary*>& steps;
  double accuracy;
  TimeToZ& row;

  void consider(double dt, double bias) {
    if (!(bias < accuracy)) return;
    const double chance = std::sqrt(accuracy * accuracy - bias * bias);
    const double seconds = time_for_chance(exact, chance) * seconds_per_time(steps, dt);
    if (!row.seconds || seconds < *row.seconds) row.seconds = seconds, row.dt = dt;
  }
  void consider_as_run(double longer_than) {
    for (const auto* step : steps)
      if (step->Z_bias && step->method.dt > longer_than)
        consider(step->method.dt, std::abs(step->Z_bias->value) + step->Z_bias->error);
  }
};

TimeToZ guarded(const std::string& method, double accuracy, const std::vector<const MethodSummary*>& steps, const Exact& exact) {
  TimeToZ row{method, accuracy, std::nullopt, std::nullopt, ""};
  const std::optional<BiasLaw> law = bias_law(steps, exact);
  if (!law) return row.remark = "unknown: too few time steps have a bias proportional to dt", row;
  Best best{exact, steps, accuracy, row};
  for (double bias = 0.02 * accuracy; bias < 0.99 * accuracy; bias *= 1.02) {
    const double dt = std::min(bias / std::max(std::abs(law->slope), 1e-300), law->up_to);
    best.consider(dt, std::abs(law->slope) * dt);
  }
  best.consider_as_run(law->up_to);
  return row;
}

TimeToZ naive(const std::string& method, double accuracy, const std::vector<const MethodSummary*>& steps, const Exact& exact) {
  TimeToZ row{method, accuracy, std::nullopt, std::nullopt, ""};
  Best{exact, steps, accuracy, row}.consider_as_run(0.0);
  if (row.seconds) return row;
  row.remark = "never: the bias is larger at every dt that was run";
  for (const auto* step : steps)
    if (step->Z_bias && std::abs(step->Z_bias->value) < accuracy + 2.0 * step->Z_bias->error)
      row.remark = "unknown: these runs are too short to tell bias from noise";
  return row;
}

}  // namespace

std::vector<TimeToZ> time_to_Z(const Comparison& comparison, const std::vector<MethodSummary>& summaries) {
  std::vector<TimeToZ> rows;
  const std::optional<Exact> exact = exact_of(comparison);
  if (!exact || !(exact->scatter > 0.0)) return rows;
  for (const double accuracy : {0.01, 0.001}) {
    for (const MethodSummary& summary : summaries) {
      if (!summary.method.exact()) continue;
      rows.push_back(
          {summary.method.name, accuracy, std::nullopt, time_for_chance(*exact, accuracy) * summary.seconds_per_time, ""});
    }
    for (const std::string& method : fixed_step_names()) {
      const auto steps = with_pressure(summaries, method);
      if (steps.empty()) continue;
      rows.push_back(method.starts_with("naive") ? naive(method, accuracy, steps, *exact)
                                                 : guarded(method, accuracy, steps, *exact));
    }
  }
  return rows;
}

}  // namespace carom
