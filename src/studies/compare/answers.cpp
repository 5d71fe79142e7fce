#include "studies/compare/answers.hpp"

#include "studies/compare/sentences.hpp"
#include "studies/compare/time_to_z.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

/// Errors in this range are those of the method: above, disks have lost each other; below, doubles end.
constexpr double largest_lawful_error = 0.03, smallest_lawful_error = 1e-11;

std::optional<Estimate> mean_of(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  const auto n = static_cast<double>(values.size());
  double mean = 0.0, squares = 0.0;
  for (const double value : values) mean += value / n;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return Estimate{mean, values.size() < 2 ? NAN : std::sqrt(squares / (n - 1.0) / n)};
}

/// Returns the run of the engine that runs the scene, from the same start.
const MethodRun* exact_twin(const Comparison& comparison, const MethodRun& run) {
  for (const MethodRun& one : comparison.runs)
    if (one.method.name == comparison.plan.horizon.engine && one.seed == run.seed) return &one;
  return nullptr;
}

MethodSummary summary_of(const Comparison& comparison, const Method& method) {
  MethodSummary summary;
  summary.method = method;
  std::vector<double> error, seconds, per_time, Z, rate, path, Z_bias, rate_bias, path_bias;
  const std::size_t early = comparison.plan.early;
  for (const MethodRun& run : comparison.runs) {
    if (run.method.name != method.name || run.method.dt != method.dt) continue;
    ++summary.runs;
    if (early >= 1 && run.error.size() >= early) error.push_back(run.error[early - 1]);
    seconds.push_back(run.seconds_early);
    per_time.push_back(run.seconds / run.time);
    if (run.error.size() >= comparison.plan.samples) {
      Z.push_back(run.Z);
      rate.push_back(run.collision_rate);
      if (run.pair > 0) path.push_back(run.mean_free_path);
      const MethodRun* exact = exact_twin(comparison, run);
      if (exact != nullptr && exact->pair > 0) {
        Z_bias.push_back(run.Z / exact->Z - 1.0);
        rate_bias.push_back(run.collision_rate / exact->collision_rate - 1.0);
        if (run.pair > 0) path_bias.push_back(run.mean_free_path / exact->mean_free_path - 1.0);
      }
    }
    summary.worst_overlap = std::max(summary.worst_overlap, run.worst_overlap);
    summary.energy_drift = std::max(summary.energy_drift, std::abs(run.energy_drift));
    if (run.counts) summary.counts = run.counts;
  }
  summary.error = spread_of(error);
  summary.seconds_early = spread_of(seconds).median;
  summary.seconds_per_time = spread_of(per_time).median;
  summary.Z = mean_of(Z);
  summary.collision_rate = mean_of(rate);
  summary.mean_free_path = mean_of(path);
  summary.Z_bias = mean_of(Z_bias);
  summary.rate_bias = mean_of(rate_bias);
  summary.path_bias = mean_of(path_bias);
  return summary;
}

/// Returns a method's summaries by falling dt.
std::vector<const MethodSummary*> by_step(const std::vector<MethodSummary>& summaries, const std::string& method) {
  std::vector<const MethodSummary*> found;
  for (const MethodSummary& summary : summaries)
    if (summary.method.name == method && !summary.method.exact()) found.push_back(&summary);
  std::sort(found.begin(), found.end(), [](const auto* a, const auto* b) { return a->method.dt > b->method.dt; });
  return found;
}

std::vector<const MethodSummary*> lawful(const std::vector<MethodSummary>& summaries, const std::string& method) {
  std::vector<const MethodSummary*> steps = by_step(summaries, method);
  std::erase_if(
      steps, [](const auto* s) { return !(s->error.median < largest_lawful_error && s->error.median > smallest_lawful_error); });
  return steps;
}

/// Returns log error against log dt by least squares.
std::optional<Estimate> order_of(const std::vector<MethodSummary>& summaries, const std::string& method) {
  const auto steps = lawful(summaries, method);
  if (steps.size() < 4) return std::nullopt;
  const auto n = static_cast<double>(steps.size());
  double mx = 0.0, my = 0.0, sxx = 0.0, sxy = 0.0, rest = 0.0;
  const auto x = [](const MethodSummary* s) { return std::log(s->method.dt); };
  const auto y = [](const MethodSummary* s) { return std::log(s->error.median); };
  for (const auto* s : steps) mx += x(s) / n, my += y(s) / n;
  for (const auto* s : steps) sxx += (x(s) - mx) * (x(s) - mx), sxy += (x(s) - mx) * (y(s) - my);
  const double order = sxy / sxx;
  for (const auto* s : steps) rest += std::pow(y(s) - my - order * (x(s) - mx), 2);
  return Estimate{order, std::sqrt(rest / (n - 2.0) / sxx)};
}

/// Finds where the method's cost passes that of exact events, by a straight line between the logarithms of neighbouring points.
void find_crossover(const std::vector<MethodSummary>& summaries, Answers& answers) {
  const auto steps = by_step(summaries, "grid");
  for (std::size_t k = 0; k + 1 < steps.size(); ++k) {
    const MethodSummary &cheap = *steps[k], &dear = *steps[k + 1];
    if (!(cheap.seconds_early < answers.exact_seconds && dear.seconds_early >= answers.exact_seconds)) continue;
    if (!(dear.error.median > 0.0) || !std::isfinite(cheap.error.median)) continue;
    const double at = std::log(answers.exact_seconds / cheap.seconds_early) / std::log(dear.seconds_early / cheap.seconds_early);
    answers.crossover_error = std::exp(std::lerp(std::log(cheap.error.median), std::log(dear.error.median), at));
    answers.crossover_dt = std::exp(std::lerp(std::log(cheap.method.dt), std::log(dear.method.dt), at));
  }
}

}  // namespace

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
    const auto same = [&](const MethodSummary& s) { return s.method.name == run.method.name && s.method.dt == run.method.dt; };
    if (std::none_of(all.begin(), all.end(), same)) all.push_back(summary_of(comparison, run.method));
  }
  return all;
}

std::optional<PriceOfError> price_of_error(const std::vector<MethodSummary>& summaries, const std::string& method, double error) {
  const auto steps = lawful(summaries, method);
  if (steps.size() < 3) return std::nullopt;
  // First order: error / dt is one number; its median over the three smallest steps.
  std::vector<double> per_dt;
  for (std::size_t k = steps.size() - 3; k < steps.size(); ++k) per_dt.push_back(steps[k]->error.median / steps[k]->method.dt);
  const double dt = error / spread_of(per_dt).median;
  const MethodSummary& last = *steps.back();
  if (dt < last.method.dt) return PriceOfError{dt, last.seconds_early * last.method.dt / dt, true};
  for (std::size_t k = steps.size() - 1; k > 0; --k) {
    const MethodSummary &fine = *steps[k], &coarse = *steps[k - 1];
    if (dt > coarse.method.dt) continue;
    const double at = std::log(dt / fine.method.dt) / std::log(coarse.method.dt / fine.method.dt);
    return PriceOfError{dt, std::exp(std::lerp(std::log(fine.seconds_early), std::log(coarse.seconds_early), at)), false};
  }
  return PriceOfError{dt, steps.front()->seconds_early * steps.front()->method.dt / dt, false};
}

Answers answers_of(const Comparison& comparison) {
  Answers answers;
  const std::vector<MethodSummary> summaries = summaries_of(comparison);
  answers.exact = comparison.plan.horizon.engine;
  for (const MethodSummary& summary : summaries) {
    if (summary.method.name != answers.exact) continue;
    answers.exact_seconds = summary.seconds_early;
    answers.exact_error = summary.error.median;
  }
  answers.order = order_of(summaries, "grid");
  answers.to_millionth = price_of_error(summaries, "grid", 1e-6);
  find_crossover(summaries, answers);
  answers.time_to_Z = time_to_Z(comparison, summaries);
  answers.sentences = compare_sentences(comparison, summaries, answers);
  return answers;
}

}  // namespace carom
