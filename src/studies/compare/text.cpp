#include "studies/compare/text.hpp"

#include "studies/compare/answers.hpp"
#include "studies/compare/sentences.hpp"
#include "text/numbers.hpp"
#include "text/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace carom::cli {

namespace {

/// Returns a fraction in per cent, to two digits.
std::string percent(double fraction) {
  return fraction < 0.0995 ? fmt::format("{:.2g}", 100.0 * fraction) : fmt::format("{:.0f}", 100.0 * fraction);
}

/// Returns a fraction of `events` in per cent; empty below 20 events, where it would mean little.
std::string percent_of(double fraction, std::uint64_t events) { return events < 20 ? "" : percent(fraction); }

/// Returns a bias in per cent, with its error where there are several starts.
std::string bias_in_percent(const Estimate& bias) {
  const std::string value = fmt::format("{:+.2f}", 100.0 * bias.value);
  return std::isfinite(bias.error) ? fmt::format("{} ± {:.2f}", value, 100.0 * bias.error) : value;
}

void put(TerminalTable& table, const MethodSummary& s, const ComparePlan& plan, const MethodSummary* exact) {
  std::string Z;
  if (s.Z && exact != nullptr && exact->Z && exact->Z->value > 0.0)
    Z = s.method.name == exact->method.name ? fmt::format("Z = {:.4g}", s.Z->value) : s.Z_bias ? bias_in_percent(*s.Z_bias) : "";
  const bool counted = s.counts.has_value();
  table.add({s.method.name, s.method.exact() ? "" : fmt::format("{:.2g}", plan.in_free_times(s.method.dt)),
             fmt::format("{:.1e}", s.error.median), duration(s.seconds_early), Z,
             counted ? percent_of(s.counts->missed_fraction(), s.counts->collisions()) : "",
             counted ? percent_of(s.counts->repeated_fraction(), s.counts->reversals()) : "",
             s.mistakes && s.mistakes->steps > 0 ? percent(s.mistakes->fraction()) : ""});
}

std::string table_of(const Comparison& comparison) {
  const std::vector<MethodSummary> summaries = summaries_of(comparison);
  const MethodSummary* exact = nullptr;
  for (const MethodSummary& summary : summaries)
    if (summary.method.name == comparison.plan.horizon.engine) exact = &summary;
  TerminalTable table("lrrrrrrr");
  table.add({"", "dt / mean", "error /", "processor", "bias of Z", "missed", "repeated", "wrong steps"});
  table.add({"method", "free time", "diameter", "time", "%", "%", "%", "%"});
  for (const MethodSummary& summary : summaries)
    if (summary.method.exact()) put(table, summary, comparison.plan, exact);
  for (const std::string& method : fixed_step_names())
    for (const MethodSummary& summary : summaries)
      if (summary.method.name == method) put(table, summary, comparison.plan, exact);
  return table.text();
}

/// Returns the meaning of the table's columns, one line each.
std::string legend(const ComparePlan& plan) {
  const std::size_t starts = plan.seeds.size();
  return fmt::format(
      "  error: root-mean-square distance from the 113-bit positions at t = {:.4g}, in mean diameters ({:.4g})\n"
      "  processor time: time to reach t = {:.4g}\n"
      "  bias of Z: Z minus that of the exact engine{}\n"
      "  missed: pairs that touched and parted without a collision, in per cent of all collisions that should happen\n"
      "  repeated: reversals of a pair that was already reversed in the same encounter, in per cent of all reversals\n"
      "  wrong steps: of methods that find contacts within a step, steps after which a disk is not where exact events bring it\n",
      plan.early_time(), plan.sigma, plan.early_time(),
      starts > 1 ? fmt::format(" from the same start, in per cent, ± its standard error over {} starts", starts)
                 : ", in per cent");
}

/// Returns a line for all runs that would have taken too long, and a line for each method that cannot run the scene.
std::string left_out(const Comparison& comparison) {
  std::uint64_t slow = 0;
  for (const LeftOut& one : comparison.left_out)
    if (one.reason.empty()) ++slow;
  std::string lines;
  for (const std::string& clause : reasons_left_out(comparison)) lines += fmt::format("  left out: {}\n", clause);
  if (slow > 0)
    lines += fmt::format("  left out, because longer than {}: {} (--longest raises the limit)\n",
                         duration(comparison.plan.longest), counted(slow, "slow run"));
  return lines;
}

std::string price_cell(const Price& price, const ComparePlan& plan) {
  if (!price.ratio) return "-";
  const std::string step = price.dt ? fmt::format(" ({:.2g})", plan.in_free_times(*price.dt)) : "";
  return (price.at_most ? "≤ " : "") + two_digits(*price.ratio) + (price.extrapolated() ? "*" : "") + step;
}

/// Returns the table of prices: a row per method, a column per target.
std::string prices_of(const Answers& answers, const ComparePlan& plan) {
  if (answers.prices.empty()) return "";
  TerminalTable table("lllll");
  table.add({"", "1e-6 diameters", "1e-10 diameters", "Z to 1 %", "Z to 0.1 %"});
  std::vector<std::string> methods;
  for (const Price& price : answers.prices)
    if (std::find(methods.begin(), methods.end(), price.method) == methods.end()) methods.push_back(price.method);
  for (const std::string& method : methods) {
    std::vector<std::string> cells = {method};
    for (const Target& target : price_targets()) {
      const auto same = [&](const Price& p) { return p.method == method && p.target == target.name; };
      const auto price = std::find_if(answers.prices.begin(), answers.prices.end(), same);
      cells.push_back(price == answers.prices.end() ? "-" : price_cell(*price, plan));
    }
    table.add(cells);
  }
  return "\n  price: processor time over that of the exact engine, and in brackets the dt in mean free times\n" + table.text() +
         "  *: extrapolated to a shorter dt than was run.  ≤: with the longest dt that was run; a longer one may cost less.\n"
         "  -: not reached, or not known from these runs (compare.json says why)\n";
}

}  // namespace

std::string compare_text(const Comparison& comparison, const Scene& scene, bool brief) {
  const ComparePlan& plan = comparison.plan;
  const Answers answers = answers_of(comparison);
  std::string text;
  if (!brief) {
    text = fmt::format(
        "{}\n{}, packing fraction {:.4g}; {}; errors at t = {:.4g}, after {:.2g} collisions per disk; mean free time {:.4g} "
        "(scene units){}\n\n",
        scene.title.empty() ? scene.source : scene.title, counted(static_cast<std::uint64_t>(scene.disk_count()), "disk"),
        scene.packing_fraction(), starts_words(plan), plan.early_time(), plan.in_free_times(plan.early_time()),
        plan.mean_free_time, plan.stiffness ? fmt::format("; stiffness of soft {:g}", *plan.stiffness) : "");
    text += table_of(comparison) + "\n" + legend(plan);
    text += left_out(comparison);
    text += prices_of(answers, plan) + "\n";
  }
  for (const std::string& sentence : answers.sentences) text += sentence + "\n";
  return text;
}

}  // namespace carom::cli
