#include "studies/compare/sentences.hpp"

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

std::string starts_words(const ComparePlan& plan) {
  if (!plan.drawn) return "1 start, which contains nothing random";
  return fmt::format("{} start{}", plan.seeds.size(), plan.seeds.size() == 1 ? "" : "s");
}

namespace {

bool was_run(const std::vector<MethodSummary>& summaries, const std::string& method) {
  return std::any_of(summaries.begin(), summaries.end(), [&](const MethodSummary& s) { return s.method.name == method; });
}

std::string collisions_per_disk(double number) {
  const std::string text = fmt::format("{:.2g}", number);
  return text + (text == "1" ? " collision per disk" : " collisions per disk");
}

std::string what_it_costs(const ComparePlan& plan, const std::vector<MethodSummary>& summaries, const Answers& answers) {
  const std::string when =
      fmt::format("after {} (t = {:.4g})", collisions_per_disk(plan.in_free_times(plan.early_time())), plan.early_time());
  if (!was_run(summaries, "grid"))
    return fmt::format("The exact engine is right to {:.1e} diameters {}. No fixed step was run: each would have taken too long.",
                       answers.exact_error, when);
  if (!answers.to_millionth)
    return fmt::format(
        "The exact engine is right to {:.1e} diameters {}. Too few of the steps that were run have errors between 1e-11 and 0.03 "
        "diameters there to extrapolate the cost of a finer one.",
        answers.exact_error, when);
  const double ratio = answers.to_millionth->seconds / answers.exact_seconds;
  return fmt::format(
      "For an error of 1e-6 diameters {} the fixed step needs {} times the processor time of the exact engine{}. The exact "
      "engine "
      "is right to {:.1e} diameters there.",
      when, two_digits(ratio),
      answers.to_millionth->extrapolated
          ? fmt::format(" (extrapolated at first order to dt = {:.1e}, smaller than those run)", answers.to_millionth->dt)
          : "",
      answers.exact_error);
}

/// Error, in diameters, above which the trajectory counts as lost.
constexpr double lost = 0.3;

std::string where_it_is_cheaper(const ComparePlan& plan, const std::vector<MethodSummary>& summaries, const Answers& answers) {
  if (!was_run(summaries, "grid")) return "";
  if (answers.crossover_error && *answers.crossover_error < lost)
    return fmt::format(
        "The fixed step is cheaper for errors above {} diameters (dt above {:.2g} mean free times, with the grid). The exact "
        "engine "
        "is cheaper for smaller errors.",
        two_digits(*answers.crossover_error), plan.in_free_times(*answers.crossover_dt));
  if (answers.crossover_error)
    return fmt::format(
        "The fixed step is cheaper only with dt above {:.2g} mean free times, where its error is {} diameters and the trajectory "
        "is lost.",
        plan.in_free_times(*answers.crossover_dt), two_digits(*answers.crossover_error));
  double cheapest = INFINITY;
  for (const MethodSummary& summary : summaries)
    if (summary.method.name == "grid") cheapest = std::min(cheapest, summary.seconds_early);
  if (cheapest < answers.exact_seconds)
    return "The fixed step is cheaper than the exact engine at every dt that was run, and less accurate at each.";
  return "The exact engine is cheaper than the fixed step at every dt that was run.";
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
  const std::string energy = naive->energy_drift > 0.0 ? fmt::format("changed by {:.0e}", naive->energy_drift) : "not changed";
  const bool differs = naive->Z_bias && std::abs(naive->Z_bias->value) > 2.0 * naive->Z_bias->error;
  if (!differs && repeated < 0.01) return "";
  return fmt::format(
      "The naive method with dt = {:.2g} has Z = {:.4g} where the exact engine has {:.4g}{}. Its energy has {}: conservation of "
      "energy does not show such errors.",
      naive->method.dt, naive->Z->value, exact->Z->value,
      repeated > 0.0 ? fmt::format("; {} % of its reversals repeat an earlier one", two_digits(100.0 * repeated)) : "", energy);
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
  return fmt::format(
      "For Z to 1 % the fixed step needs {} times the processor time of the exact engine, for Z to 0.1 % {} times.",
      two_digits(*percent), two_digits(*thousandth));
}

}  // namespace

std::vector<std::string> compare_sentences(const Comparison& comparison, const std::vector<MethodSummary>& summaries,
                                           const Answers& answers) {
  if (!(answers.exact_seconds > 0.0)) return {};
  std::vector<std::string> sentences = {what_it_costs(comparison.plan, summaries, answers),
                                        where_it_is_cheaper(comparison.plan, summaries, answers),
                                        what_the_naive_does(summaries, answers), what_pressure_costs(answers)};
  if (!comparison.plan.drawn)
    sentences.emplace_back("This scene's start contains nothing random. There is one start, and a bias has no error bar.");
  std::erase(sentences, "");
  return sentences;
}

}  // namespace carom
