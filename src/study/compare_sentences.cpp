#include "study/compare_sentences.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace carom {

std::string two_digits(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  const double rounded = unit * std::nearbyint(value / unit);
  if (!(rounded >= 10.0 && rounded < 1e7)) return fmt::format("{:.2g}", value);
  std::string text = fmt::format("{:.0f}", rounded);
  for (std::size_t end = text.size(); end > 3; end -= 3) text.insert(end - 3, ",");
  return text;
}

namespace {

std::string what_it_costs(const ComparePlan& plan, const Answers& answers) {
  const std::string when =
      fmt::format("after {:.2g} collisions per disk (t = {:.4g})", plan.in_free_times(plan.early_time()), plan.early_time());
  if (!answers.to_millionth)
    return fmt::format(
        "The exact engine is right to {:.1e} sigma {}; the fixed step shows no law of convergence there, at any dt that was run.",
        answers.exact_error, when);
  const double ratio = answers.to_millionth->seconds / answers.exact_seconds;
  return fmt::format(
      "To reach an error of 1e-6 sigma {} the fixed step would need {} times the time of the exact engine, which is right to "
      "{:.1e} "
      "there{}.",
      when, two_digits(ratio), answers.exact_error,
      answers.to_millionth->extrapolated
          ? fmt::format(" (dt = {:.1e}, smaller than those run: extrapolated with the first order that the points show)",
                        answers.to_millionth->dt)
          : "");
}

std::string where_it_is_cheaper(const ComparePlan& plan, const std::vector<MethodSummary>& summaries, const Answers& answers) {
  if (answers.crossover_error)
    return fmt::format(
        "For an answer cruder than {} sigma the fixed step is the cheaper way (dt above {:.2g} mean free times, with the "
        "grid); for "
        "anything finer the exact engine is.",
        two_digits(*answers.crossover_error), plan.in_free_times(*answers.crossover_dt));
  double cheapest = INFINITY;
  for (const MethodSummary& summary : summaries)
    if (summary.method.name == "grid") cheapest = std::min(cheapest, summary.seconds_early);
  if (cheapest < answers.exact_seconds)
    return "At every dt that was run the fixed step is cheaper than the exact engine, and none of them reaches its accuracy.";
  return "At no dt that was run is the fixed step cheaper than the exact engine, however crude the answer.";
}

std::string what_the_naive_does(const std::vector<MethodSummary>& summaries, const Answers& answers) {
  const MethodSummary* exact = nullptr;
  const MethodSummary* naive = nullptr;  // at its smallest step with a pressure
  for (const MethodSummary& summary : summaries) {
    if (summary.method.name == answers.exact) exact = &summary;
    const bool smaller = naive == nullptr || summary.method.dt < naive->method.dt;
    if (summary.method.name == "naive" && summary.Z && smaller) naive = &summary;
  }
  if (exact == nullptr || naive == nullptr || !exact->Z || !naive->counts) return "";
  const double repeated = naive->counts->repeated_fraction();
  return fmt::format(
      "The naive method with dt = {:.2g} has Z = {:.4g} against {:.4g}{}; its energy has {}, which shows nothing of it.",
      naive->method.dt, naive->Z->value, exact->Z->value,
      repeated > 0.0 ? fmt::format(", and {:.2g} % of its reversals are repeats of one that was already done", 100.0 * repeated)
                     : "",
      naive->energy_drift > 0.0 ? fmt::format("changed by {:.0e}", naive->energy_drift) : "not changed in any digit");
}

std::string what_pressure_costs(const Answers& answers) {
  const auto seconds = [&](const std::string& method, double accuracy) -> std::optional<double> {
    for (const TimeToZ& row : answers.time_to_Z)
      if (row.method == method && row.accuracy == accuracy) return row.seconds;
    return std::nullopt;
  };
  const auto ratio = [&](double accuracy) -> std::optional<double> {
    const auto exact = seconds(answers.exact, accuracy), grid = seconds("grid", accuracy);
    return exact && grid ? std::optional(*grid / *exact) : std::nullopt;
  };
  const auto percent = ratio(0.01), thousandth = ratio(0.001);
  if (!percent || !thousandth) return "";
  return fmt::format("To know Z to 1 % the fixed step takes {} times as long as the exact engine, to 0.1 % {} times.",
                     two_digits(*percent), two_digits(*thousandth));
}

}  // namespace

std::vector<std::string> compare_sentences(const Comparison& comparison, const std::vector<MethodSummary>& summaries,
                                           const Answers& answers) {
  if (!(answers.exact_seconds > 0.0)) return {};
  std::vector<std::string> sentences = {what_it_costs(comparison.plan, answers),
                                        where_it_is_cheaper(comparison.plan, summaries, answers),
                                        what_the_naive_does(summaries, answers), what_pressure_costs(answers)};
  std::erase(sentences, "");
  return sentences;
}

}  // namespace carom
