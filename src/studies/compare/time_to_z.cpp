#include "studies/compare/time_to_z.hpp"

#include "studies/horizon/method.hpp"

#include <carom/simulation.hpp>

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
  const Estimate mean = *mean_of(Z);
  return Exact{mean.value, mean.error / mean.value * std::sqrt(pairs), pairs / time};  // the deviation is error * sqrt(runs)
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
    return between_logarithms(fine.seconds_per_time, coarse.seconds_per_time, at);
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
  for (const auto* step : steps)  // a shorter step may be the cheaper one: a long one holds more contacts
    if (step->method.dt <= law->up_to) best.consider(step->method.dt, std::abs(law->slope) * step->method.dt);
  best.consider_as_run(law->up_to);
  return row;
}

/// Largest bias, over Z - 1, up to which a parabola describes it.
constexpr double parabolic_share = 0.25;

/// The bias of Z of a first-order method as slope dt + curvature dt^2, fitted by weighted least squares; needs four points.
struct Parabola {
  double curvature = 0.0;
  double up_to = 0.0;
};
std::optional<Parabola> parabola(const std::vector<const MethodSummary*>& steps, const Exact& exact) {
  double xx = 0.0, xxx = 0.0, xxxx = 0.0, xy = 0.0, xxy = 0.0;
  Parabola fit;
  int points = 0;
  for (const auto* step : steps) {  // by rising dt
    if (!step->Z_bias || std::abs(step->Z_bias->value) > parabolic_share * (exact.Z - 1.0) / exact.Z) break;
    const double x = step->method.dt, y = step->Z_bias->value, weight = std::pow(std::max(1e-12, step->Z_bias->error), -2.0);
    xx += weight * x * x, xxx += weight * x * x * x, xxxx += weight * x * x * x * x;
    xy += weight * x * y, xxy += weight * x * x * y;
    fit.up_to = x;
    ++points;
  }
  const double determinant = xx * xxxx - xxx * xxx;
  if (points < 4 || !(determinant > 0.0)) return std::nullopt;
  fit.curvature = (xx * xxy - xxx * xy) / determinant;
  return fit;
}

/// 2 A(dt / 2) - A(dt) of a first-order method. Chance is shared so that it costs least: variance 4 C^2 / n_fine + C^2 / n_coarse
/// of n_fine and n_coarse collisions, at prices s_fine and s_coarse, takes C^2 (2 sqrt(s_fine) + sqrt(s_coarse))^2 for one.
TimeToZ richardson(double accuracy, const std::vector<const MethodSummary*>& steps, const Exact& exact) {
  TimeToZ row{"richardson", accuracy, std::nullopt, std::nullopt, ""};
  const std::optional<Parabola> fit = parabola(steps, exact);
  if (!fit) return row.remark = "unknown: too few time steps have a bias that a parabola describes", row;
  for (double dt = fit->up_to; dt > 1e-4 * fit->up_to; dt /= 1.02) {
    const double bias = 0.5 * std::abs(fit->curvature) * dt * dt;
    if (!(bias < accuracy)) continue;
    const double chance = std::sqrt(accuracy * accuracy - bias * bias);
    const double price = std::pow(2.0 * std::sqrt(seconds_per_time(steps, 0.5 * dt)) + std::sqrt(seconds_per_time(steps, dt)), 2);
    const double seconds = time_for_chance(exact, chance) * price;
    if (!row.seconds || seconds < *row.seconds) row.seconds = seconds, row.dt = dt;
  }
  return row;
}

/// Of methods whose bias follows no law of dt: the naive ones, and those that go to the moment of contact, whose bias is that of
/// few mistakes. Steps count as they were run.
TimeToZ as_run(const std::string& method, double accuracy, const std::vector<const MethodSummary*>& steps, const Exact& exact) {
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
      const bool has_law = !method.starts_with("naive") && !finds_contacts(method);
      rows.push_back(has_law ? guarded(method, accuracy, steps, *exact) : as_run(method, accuracy, steps, *exact));
      if (method == "grid") rows.push_back(richardson(accuracy, steps, *exact));
    }
  }
  return rows;
}

}  // namespace carom
