#include "cli/compare_text.hpp"

#include "show/number_words.hpp"
#include "study/compare_answers.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace carom::cli {

namespace {

std::string percent(double fraction) {
  return fraction < 0.0995 ? fmt::format("{:.2g} %", 100.0 * fraction) : fmt::format("{:.0f} %", 100.0 * fraction);
}

/// Of so many events; a fraction of a handful says nothing.
std::string percent_of(double fraction, std::uint64_t events) { return events < 20 ? "" : percent(fraction); }

std::string row(const MethodSummary& s, const ComparePlan& plan, const MethodSummary* exact) {
  std::string Z;
  if (s.Z && exact != nullptr && exact->Z && exact->Z->value > 0.0)
    Z = s.method.name == exact->method.name ? fmt::format("Z = {:.4g}", s.Z->value)
        : s.Z_bias                          ? fmt::format("{:+.2f} ± {:.2f}", 100.0 * s.Z_bias->value, 100.0 * s.Z_bias->error)
                                            : "";
  const bool counted = s.counts.has_value();
  return fmt::format("  {:<21}{:>10}  {:>10}  {:>9}  {:>15}  {:>8}  {:>9}\n", s.method.name,
                     s.method.exact() ? "" : fmt::format("{:.2g}", plan.in_free_times(s.method.dt)),
                     fmt::format("{:.1e}", s.error.median), duration(s.seconds_early), Z,
                     counted ? percent_of(s.counts->missed_fraction(), s.counts->collisions()) : "",
                     counted ? percent_of(s.counts->repeated_fraction(), s.counts->reversals()) : "");
}

std::string table(const Comparison& comparison) {
  const std::vector<MethodSummary> summaries = summaries_of(comparison);
  const MethodSummary* exact = nullptr;
  for (const MethodSummary& summary : summaries)
    if (summary.method.name == comparison.plan.horizon.engine) exact = &summary;
  std::string text =
      fmt::format("  {:<21}{:>10}  {:>10}  {:>9}  {:>15}  {:>8}  {:>9}\n", "", "dt / mean", "error /", "", "bias", "", "");
  text += fmt::format("  {:<21}{:>10}  {:>10}  {:>9}  {:>15}  {:>8}  {:>9}\n", "method", "free time", "sigma", "time", "of Z",
                      "missed", "repeated");
  for (const MethodSummary& summary : summaries)
    if (summary.method.exact()) text += row(summary, comparison.plan, exact);
  for (const std::string& method : fixed_step_names())
    for (const MethodSummary& summary : summaries)
      if (summary.method.name == method) text += row(summary, comparison.plan, exact);
  return text;
}

std::string time_to_Z(const Answers& answers) {
  if (answers.time_to_Z.empty()) return "";
  std::string text = "\n  processor time to know Z to\n";
  for (const TimeToZ& one : answers.time_to_Z) {
    text +=
        fmt::format("  {:>5} %  {:<22}{}\n", 100.0 * one.accuracy, one.method,
                    one.seconds ? duration(*one.seconds) + (one.dt ? fmt::format(", dt = {:.2g}", *one.dt) : "") : one.remark);
  }
  return text;
}

}  // namespace

std::string compare_text(const Comparison& comparison, const Scene& scene, bool brief) {
  const ComparePlan& plan = comparison.plan;
  const Answers answers = answers_of(comparison);
  std::string text;
  if (!brief) {
    text = fmt::format(
        "{}\n{}, packing fraction {:.4g}; {}; errors at t = {:.4g}, collisions per disk {:.2g}; mean free time {:.4g}\n\n",
        scene.title.empty() ? scene.source : scene.title, counted(static_cast<std::uint64_t>(scene.disk_count()), "disk"),
        scene.packing_fraction(), counted(plan.seeds.size(), "seed"), plan.early_time(), plan.in_free_times(plan.early_time()),
        plan.mean_free_time);
    text += table(comparison);
    if (!comparison.left_out.empty())
      text += fmt::format("  left out, as longer than {}: {} (--longest allows more)\n", duration(plan.longest),
                          counted(comparison.left_out.size(), "slow run"));
    text += time_to_Z(answers) + "\n";
  }
  for (const std::string& sentence : answers.sentences) text += sentence + "\n";
  return text;
}

}  // namespace carom::cli
