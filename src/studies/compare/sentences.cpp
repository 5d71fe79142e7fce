#include "studies/compare/sentences.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

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

std::vector<std::string> reasons_left_out(const Comparison& comparison) {
  struct Reasons {
    std::string method, last;
    std::size_t steps = 1;
    bool differ = false;
  };
  std::vector<Reasons> all;
  for (const LeftOut& one : comparison.left_out) {  // by falling dt
    if (one.reason.empty()) continue;
    const auto found = std::find_if(all.begin(), all.end(), [&](const Reasons& r) { return r.method == one.method.name; });
    if (found == all.end()) {
      all.push_back({one.method.name, one.reason});
      continue;
    }
    ++found->steps;
    found->differ = found->differ || found->last != one.reason;
    found->last = one.reason;
  }
  std::vector<std::string> clauses;
  for (const Reasons& r : all)
    clauses.push_back(r.differ ? fmt::format("{} with {} of the steps: {}", r.method, r.steps, r.last)
                               : fmt::format("{}: {}", r.method, r.last));
  return clauses;
}

namespace {

std::string collisions_per_disk(double number) {
  const std::string text = fmt::format("{:.2g}", number);
  return text + (text == "1" ? " collision per disk" : " collisions per disk");
}

/// Returns text such as "2.2", or "at most 2.2".
std::string at_most(const Price& price) { return (price.at_most ? "at most " : "") + two_digits(*price.ratio); }

/// Returns text such as "2.2 times (1.9 to 2.6)"; the spread where there are several starts.
std::string times(const Price& price, const ComparePlan& plan) {
  const std::string ratio = at_most(price) + " times";
  if (plan.seeds.size() < 2 || !std::isfinite(price.highest)) return ratio;
  return fmt::format("{} ({} to {} over {})", ratio, two_digits(price.lowest), two_digits(price.highest), starts_words(plan));
}

std::string with_its_step(const Price& price, const ComparePlan& plan) {
  return fmt::format("{} with dt = {:.2g} mean free times", price.method, plan.in_free_times(*price.dt));
}

/// The price of the best fixed step.
std::string what_it_costs(const ComparePlan& plan, const Answers& answers) {
  const std::string when =
      fmt::format("after {} (t = {:.4g})", collisions_per_disk(plan.in_free_times(plan.early_time())), plan.early_time());
  const std::string exact = fmt::format("The exact engine is right to {:.1e} diameters", answers.exact_error);
  const bool any =
      std::any_of(answers.prices.begin(), answers.prices.end(), [](const Price& p) { return p.target == "error 1e-6" && p.dt; });
  const Price* best = best_fixed_step(answers.prices, "error 1e-6");
  if (best != nullptr)
    return fmt::format(
        "For an error of 1e-6 diameters {} the best fixed step ({}{}) needs {} the processor time of the exact engine, both on "
        "one core of {}.{} {} there.",
        when, with_its_step(*best, plan),
        best->extrapolated() ? fmt::format(", extrapolated by {:.2g} in dt", best->extrapolation)
        : best->at_most      ? ", the longest that was run"
                             : "",
        times(*best, plan), plan.machine, best->at_most ? " A longer one may need less." : "", exact);
  return fmt::format("{} {}. {}", exact, when,
                     any ? "No fixed step that was run comes within a factor of 3 in dt of an error of 1e-6 diameters."
                         : "No fixed step that was run is right to 1e-6 diameters, and their errors do not say which would be.");
}

/// The method that reverses disks where it finds them, against the best.
std::string what_not_knowing_when_costs(const std::vector<MethodSummary>& summaries, const Answers& answers) {
  const Price* best = best_fixed_step(answers.prices, "error 1e-6");
  const MethodSummary* finest = nullptr;
  for (const MethodSummary& summary : summaries)
    if (summary.method.name == "grid" && (finest == nullptr || summary.method.dt < finest->method.dt)) finest = &summary;
  if (best == nullptr || best->method == "grid" || finest == nullptr || !(finest->error.median > 1e-6)) return "";
  return fmt::format(
      "A fixed step that reverses disks where it finds them overlapping (grid) still has an error of {:.1e} diameters there at "
      "{} "
      "times the processor time of the exact engine.",
      finest->error.median, two_digits(finest->seconds_early / answers.exact_seconds));
}

/// Error, in diameters, above which the trajectory counts as lost.
constexpr double lost = 0.3;

std::string where_it_is_cheaper(const ComparePlan& plan, const std::vector<MethodSummary>& summaries, const Answers& answers) {
  if (answers.crossover && answers.crossover->error < lost)
    return fmt::format(
        "A fixed step is the better choice for errors above {} diameters ({} with dt above {:.2g} mean free times). The exact "
        "engine is cheaper for smaller errors.",
        two_digits(answers.crossover->error), answers.crossover->method, plan.in_free_times(answers.crossover->dt));
  if (answers.crossover)
    return fmt::format(
        "A fixed step is cheaper than the exact engine only with dt above {:.2g} mean free times ({}), where its error is {} "
        "diameters and the trajectory is lost.",
        plan.in_free_times(answers.crossover->dt), answers.crossover->method, two_digits(answers.crossover->error));
  bool any = false, cheaper = false, dearer = false;
  for (const MethodSummary& summary : summaries) {
    if (summary.method.exact() || !(summary.seconds_early > 0.0)) continue;
    any = true;
    (summary.seconds_early < answers.exact_seconds ? cheaper : dearer) = true;
  }
  if (!any) return "No fixed step was run: each would have taken too long.";
  if (!cheaper) return "The exact engine is cheaper than every fixed step that was run.";
  if (!dearer) return "Every fixed step that was run is cheaper than the exact engine, and less accurate.";
  return "";
}

std::string what_the_naive_does(const ComparePlan& plan, const std::vector<MethodSummary>& summaries, const Answers& answers) {
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
  std::string text = fmt::format(
      "The naive method with dt = {:.2g} has Z = {:.4g} where the exact engine has {:.4g}{}.", naive->method.dt, naive->Z->value,
      exact->Z->value,
      repeated > 0.0 ? fmt::format("; {} % of its reversals repeat an earlier one", two_digits(100.0 * repeated)) : "");
  constexpr double unnoticed = 1e-9;  // of the energy: what a user takes for rounding
  if (plan.conservative && naive->energy_drift < unnoticed)
    text += fmt::format(" Its energy has {}: conservation of energy does not show such errors.", energy);
  return text;
}

std::string what_pressure_costs(const ComparePlan& plan, const Answers& answers) {
  const Price* percent = best_fixed_step(answers.prices, "Z 1 %");
  const Price* thousandth = best_fixed_step(answers.prices, "Z 0.1 %");
  if (percent == nullptr) return "";
  std::vector<std::string> untold;  // their bias may be smaller than what these runs tell
  for (const Price& price : answers.prices)
    if (price.target == "Z 0.1 %" && finds_contacts(price.method) && !price.ratio) untold.push_back(price.method);
  if (!untold.empty())
    return fmt::format(
        "For Z to 1 % the best fixed step ({}) needs {} times the processor time of the exact engine. These runs are too short "
        "to tell which step of {} is right to 0.1 %.",
        with_its_step(*percent, plan), at_most(*percent), fmt::join(untold, " and "));
  if (thousandth == nullptr) return "";
  return fmt::format(
      "For Z to 1 % the best fixed step ({}) needs {} times the processor time of the exact engine, for Z to 0.1 % ({}) {} "
      "times.",
      with_its_step(*percent, plan), at_most(*percent), with_its_step(*thousandth, plan), at_most(*thousandth));
}

std::string how_often_backtrack_is_wrong(const Answers& answers) {
  if (!answers.mistakes) return "";
  const MistakeLaw& law = *answers.mistakes;
  return fmt::format(
      "In a mean free time backtrack makes c N (dt / mean free time)^2 mistakes on N disks, with c = {:.2g} ± {:.1g}{}.", law.c,
      law.error,
      law.grazes ? fmt::format(" (contacts of a dilute gas that begin and end between two steps: {:.2g})", *law.grazes) : "");
}

std::string what_cores_would_do(const Answers& answers) {
  const Price* best = best_fixed_step(answers.prices, "error 1e-6");
  if (best == nullptr || !(*best->ratio > 1.0)) return "";
  return fmt::format(
      "On {:.0f} cores that step would be as fast as the exact engine on one, if it lost nothing by sharing the work.",
      std::ceil(*best->ratio));
}

}  // namespace

std::vector<std::string> compare_sentences(const Comparison& comparison, const std::vector<MethodSummary>& summaries,
                                           const Answers& answers) {
  if (!(answers.exact_seconds > 0.0)) return {};
  std::vector<std::string> sentences = {what_it_costs(comparison.plan, answers),
                                        what_not_knowing_when_costs(summaries, answers),
                                        where_it_is_cheaper(comparison.plan, summaries, answers),
                                        what_pressure_costs(comparison.plan, answers),
                                        how_often_backtrack_is_wrong(answers),
                                        what_cores_would_do(answers),
                                        what_the_naive_does(comparison.plan, summaries, answers)};
  if (!comparison.plan.drawn)
    sentences.emplace_back("This scene's start contains nothing random. There is one start, and a bias has no error bar.");
  std::erase(sentences, "");
  return sentences;
}

}  // namespace carom
