#include "studies/compare/summaries.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace carom {

namespace {

/// Returns the run of the engine that runs the scene, from the same start.
const MethodRun* exact_twin(const Comparison& comparison, const MethodRun& run) {
  for (const MethodRun& one : comparison.runs)
    if (one.method.name == comparison.plan.horizon.engine && one.seed == run.seed) return &one;
  return nullptr;
}

MethodSummary summary_of(const Comparison& comparison, const Method& method) {
  MethodSummary summary;
  summary.method = method;
  std::vector<double> error, seconds, setup, per_time, horizons, Z, rate, path, Z_bias, rate_bias, path_bias;
  const std::size_t early = comparison.plan.early;
  for (const MethodRun& run : comparison.runs) {
    if (!run.method.same_step(method)) continue;
    ++summary.runs;
    if (early >= 1 && run.error.size() >= early) error.push_back(run.error[early - 1]);
    seconds.push_back(run.seconds_early);
    setup.push_back(run.setup_seconds);
    if (const std::optional<double> horizon = horizon_of(comparison.plan, run)) horizons.push_back(*horizon);
    per_time.push_back(run.seconds / run.time);
    if (run.error.size() >= comparison.plan.samples) {
      if (std::isfinite(run.Z)) Z.push_back(run.Z);
      rate.push_back(run.collision_rate);
      if (run.pair > 0) path.push_back(run.mean_free_path);
      const MethodRun* exact = exact_twin(comparison, run);
      if (exact != nullptr && exact->pair > 0) {
        if (std::isfinite(run.Z) && std::isfinite(exact->Z)) Z_bias.push_back(run.Z / exact->Z - 1.0);
        rate_bias.push_back(run.collision_rate / exact->collision_rate - 1.0);
        if (run.pair > 0) path_bias.push_back(run.mean_free_path / exact->mean_free_path - 1.0);
      }
    }
    summary.worst_overlap = std::max(summary.worst_overlap, run.worst_overlap);
    summary.energy_drift = std::max(summary.energy_drift, std::abs(run.energy_drift));
    if (run.counts) summary.counts = run.counts;
    if (run.mistakes) {
      StepMistakes all = summary.mistakes.value_or(StepMistakes{});
      all.steps += run.mistakes->steps;
      all.mistaken += run.mistakes->mistaken;
      summary.mistakes = all;
    }
  }
  summary.error = spread_of(error);
  summary.seconds_early = spread_of(seconds).median;
  summary.seconds_per_time = spread_of(per_time).median;
  summary.setup_seconds = spread_of(setup).median;
  if (summary.runs > 0 && horizons.size() == summary.runs) summary.horizon = spread_of(horizons).median;
  summary.Z = mean_of(Z);
  summary.collision_rate = mean_of(rate);
  summary.mean_free_path = mean_of(path);
  summary.Z_bias = mean_of(Z_bias);
  summary.rate_bias = mean_of(rate_bias);
  summary.path_bias = mean_of(path_bias);
  return summary;
}

}  // namespace

std::optional<Estimate> mean_of(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  const auto n = static_cast<double>(values.size());
  double mean = 0.0, squares = 0.0;
  for (const double value : values) mean += value / n;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return Estimate{mean, values.size() < 2 ? NAN : std::sqrt(squares / (n - 1.0) / n)};
}

double between_logarithms(double a, double b, double at) { return std::exp(std::lerp(std::log(a), std::log(b), at)); }

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {NAN, NAN, NAN};
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    const double place = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    if (values[below] == values[above]) return values[below];  // infinities too
    return std::lerp(values[below], values[above], place - static_cast<double>(below));
  };
  return {at(0.5), at(0.25), at(0.75)};
}

std::vector<MethodSummary> summaries_of(const Comparison& comparison) {
  std::vector<MethodSummary> all;
  for (const MethodRun& run : comparison.runs) {
    const auto same = [&](const MethodSummary& s) { return s.method.same_step(run.method); };
    if (std::none_of(all.begin(), all.end(), same)) all.push_back(summary_of(comparison, run.method));
  }
  return all;
}

std::optional<double> horizon_of(const ComparePlan& plan, const MethodRun& run) {
  const double tolerance = plan.horizon.tolerance;
  for (std::size_t k = 0; k < run.error.size(); ++k) {
    if (run.error[k] <= tolerance) continue;
    if (k == 0) return std::nullopt;
    const double before = run.error[k - 1], after = run.error[k];
    const bool both_known = before > 0.0 && std::isfinite(after);
    const double share = both_known ? std::log(tolerance / before) / std::log(after / before) : 0.0;
    return plan.in_free_times((static_cast<double>(k) + share) * plan.sample_step);
  }
  return std::nullopt;
}

}  // namespace carom
