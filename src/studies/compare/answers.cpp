#include "studies/compare/answers.hpp"

#include "studies/compare/sentences.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

/// Returns a method's summaries by falling dt.
std::vector<const MethodSummary*> by_step(const std::vector<MethodSummary>& summaries, const std::string& method) {
  std::vector<const MethodSummary*> found;
  for (const MethodSummary& summary : summaries)
    if (summary.method.name == method && !summary.method.exact()) found.push_back(&summary);
  std::sort(found.begin(), found.end(), [](const auto* a, const auto* b) { return a->method.dt > b->method.dt; });
  return found;
}

/// Returns log error against log dt by least squares.
std::optional<Estimate> order_of(const std::vector<MethodSummary>& summaries, const std::string& method) {
  std::vector<const MethodSummary*> steps = by_step(summaries, method);
  std::erase_if(steps, [](const auto* s) { return !shows_law(s->error.median); });
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

/// Returns where a method's cost passes that of exact events, by a straight line between the logarithms of neighbouring points. A
/// method that finds contacts is wrong with one step and right to rounding with the next: of it, the step that costs less.
std::optional<Crossover> crossover_of(const std::vector<MethodSummary>& summaries, const std::string& method,
                                      double exact_seconds) {
  std::optional<Crossover> found;
  const auto steps = by_step(summaries, method);
  for (std::size_t k = 0; k + 1 < steps.size(); ++k) {
    const MethodSummary &cheap = *steps[k], &dear = *steps[k + 1];
    if (!(cheap.seconds_early < exact_seconds && dear.seconds_early >= exact_seconds)) continue;
    if (!(dear.error.median > 0.0) || !std::isfinite(cheap.error.median)) continue;
    if (finds_contacts(method)) {
      found = Crossover{method, cheap.error.median, cheap.method.dt};
      continue;
    }
    const double at = std::log(exact_seconds / cheap.seconds_early) / std::log(dear.seconds_early / cheap.seconds_early);
    found = Crossover{method, between_logarithms(cheap.error.median, dear.error.median, at),
                      between_logarithms(cheap.method.dt, dear.method.dt, at)};
  }
  return found;
}

std::optional<Crossover> crossover_of(const std::vector<MethodSummary>& summaries, double exact_seconds) {
  std::optional<Crossover> best;
  for (const std::string& method : fixed_step_names()) {
    const std::optional<Crossover> one = crossover_of(summaries, method, exact_seconds);
    if (one && (!best || one->error < best->error)) best = one;
  }
  return best;
}

/// Both pay their set-up once and their steady price from there on.
std::optional<BreakEven> break_even_of(const Comparison& comparison, const std::vector<MethodSummary>& summaries,
                                       const std::string& exact, const Price& best) {
  std::vector<double> exact_setup, exact_per_time, method_setup;
  for (const MethodSummary& summary : summaries) {
    if (summary.method.name == exact)
      exact_setup.push_back(summary.setup_seconds), exact_per_time.push_back(summary.seconds_per_time);
    if (summary.method.name == best.method) method_setup.push_back(summary.setup_seconds);
  }
  if (exact_setup.empty() || method_setup.empty() || !(*best.ratio > 1.0)) return std::nullopt;
  BreakEven even{best.method, exact_setup.front(), spread_of(method_setup).median, 0.0};
  const double dearer = (*best.ratio - 1.0) * exact_per_time.front();
  even.collisions_per_disk = std::max(0.0, comparison.plan.in_free_times((even.exact_setup - even.method_setup) / dearer));
  return even;
}

}  // namespace

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
  answers.crossover = crossover_of(summaries, answers.exact_seconds);
  answers.mistakes = mistake_law(comparison.plan, summaries);
  answers.time_to_Z = time_to_Z(comparison, summaries);
  answers.prices = prices_of(comparison, summaries);
  if (const Price* best = best_fixed_step(answers.prices, "error 1e-6"))
    answers.break_even = break_even_of(comparison, summaries, answers.exact, *best);
  answers.sentences = compare_sentences(comparison, summaries, answers);
  return answers;
}

}  // namespace carom
