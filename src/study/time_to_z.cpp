#include "study/time_to_z.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom {

namespace {

struct Exact {
  double Z = 0.0;
  double Z_error = 0.0;
  double scatter = 0.0;  ///< C: relative standard deviation of Z times the root of the number of collisions
  double collisions_per_time = 0.0;
};

/// From all exact double-precision runs of the engine that runs the scene.
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
  return Exact{mean, deviation / std::sqrt(n), deviation / mean * std::sqrt(pairs / n), pairs / time};
}

std::vector<const MethodSummary*> with_pressure(const std::vector<MethodSummary>& summaries, const std::string& method) {
  std::vector<const MethodSummary*> steps;
  for (const MethodSummary& summary : summaries)
    if (summary.method.name == method && summary.Z) steps.push_back(&summary);
  std::sort(steps.begin(), steps.end(), [](const auto* a, const auto* b) { return a->method.dt < b->method.dt; });
  return steps;
}

/// Relative bias of Z per dt, where it is below a third: a line through nothing, each point weighted by its error.
std::optional<double> bias_per_dt(const std::vector<const MethodSummary*>& steps, const Exact& exact) {
  double numerator = 0.0, denominator = 0.0;
  for (const auto* step : steps) {
    const double bias = step->Z->value / exact.Z - 1.0;
    if (std::abs(bias) > 1.0 / 3.0) continue;
    const double error = std::max(1e-12, std::hypot(step->Z->error, exact.Z_error) / exact.Z);
    numerator += step->method.dt * bias / (error * error);
    denominator += step->method.dt * step->method.dt / (error * error);
  }
  if (!(denominator > 0.0)) return std::nullopt;
  return numerator / denominator;
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

TimeToZ guarded(const std::string& method, double accuracy, const std::vector<const MethodSummary*>& steps, const Exact& exact) {
  TimeToZ row{method, accuracy, std::nullopt, std::nullopt, ""};
  const std::optional<double> slope = bias_per_dt(steps, exact);
  if (!slope) return row.remark = "not known from these runs", row;
  double least = std::numeric_limits<double>::infinity();
  for (double bias = 0.02 * accuracy; bias < 0.99 * accuracy; bias *= 1.02) {
    const double dt = std::min(bias / std::max(std::abs(*slope), 1e-300), steps.back()->method.dt);
    const double seconds = time_for_chance(exact, std::sqrt(accuracy * accuracy - bias * bias)) * seconds_per_time(steps, dt);
    if (seconds < least) least = seconds, row.dt = dt;
  }
  row.seconds = least;
  return row;
}

TimeToZ naive(const std::string& method, double accuracy, const std::vector<const MethodSummary*>& steps, const Exact& exact) {
  TimeToZ row{method, accuracy, std::nullopt, std::nullopt, "never: its bias is larger at every dt that was run"};
  for (const auto* step : steps) {
    const double bias = std::abs(step->Z->value / exact.Z - 1.0);
    const double error = std::hypot(step->Z->error, exact.Z_error) / exact.Z;
    if (bias < accuracy + 2.0 * error) row.remark = "not known: its bias and its chance cannot be told apart in these runs";
  }
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
