#include "studies/compare/text.hpp"

#include "studies/compare/answers.hpp"
#include "studies/compare/sentences.hpp"
#include "text/numbers.hpp"
#include "text/table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

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
             counted ? percent_of(s.counts->repeated_fraction(), s.counts->reversals()) : ""});
}

std::string table_of(const Comparison& comparison) {
  const std::vector<MethodSummary> summaries = summaries_of(comparison);
  const MethodSummary* exact = nullptr;
  for (const MethodSummary& summary : summaries)
    if (summary.method.name == comparison.plan.horizon.engine) exact = &summary;
  TerminalTable table("lrrrrrr");
  table.add({"", "dt / mean", "error /", "processor", "bias of Z", "missed", "repeated"});
  table.add({"method", "free time", "diameter", "time", "%", "%", "%"});
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
      "  repeated: reversals of a pair that was already reversed in the same encounter, in per cent of all reversals\n",
      plan.early_time(), plan.sigma, plan.early_time(),
      starts > 1 ? fmt::format(" from the same start, in per cent, ± its standard error over {} starts", starts)
                 : ", in per cent");
}

std::string time_to_Z(const Answers& answers) {
  if (answers.time_to_Z.empty()) return "";
  TerminalTable table("rll");
  for (const TimeToZ& one : answers.time_to_Z)
    table.add({fmt::format("{} %", 100.0 * one.accuracy), one.method,
               one.seconds ? duration(*one.seconds) + (one.dt ? fmt::format(", dt = {:.2g}", *one.dt) : "") : one.remark});
  return "\n  processor time for Z = PA/(NkT) with an error of\n" + table.text();
}

}  // namespace

std::string compare_text(const Comparison& comparison, const Scene& scene, bool brief) {
  const ComparePlan& plan = comparison.plan;
  const Answers answers = answers_of(comparison);
  std::string text;
  if (!brief) {
    text = fmt::format(
        "{}\n{}, packing fraction {:.4g}; {}; errors at t = {:.4g}, after {:.2g} collisions per disk; mean free time {:.4g} "
        "(scene units)\n\n",
        scene.title.empty() ? scene.source : scene.title, counted(static_cast<std::uint64_t>(scene.disk_count()), "disk"),
        scene.packing_fraction(), starts_words(plan), plan.early_time(), plan.in_free_times(plan.early_time()),
        plan.mean_free_time);
    text += table_of(comparison) + "\n" + legend(plan);
    if (!comparison.left_out.empty())
      text += fmt::format("  left out, because longer than {}: {} (--longest raises the limit)\n", duration(plan.longest),
                          counted(comparison.left_out.size(), "slow run"));
    text += time_to_Z(answers) + "\n";
  }
  for (const std::string& sentence : answers.sentences) text += sentence + "\n";
  return text;
}

}  // namespace carom::cli
