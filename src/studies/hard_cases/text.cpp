#include "studies/hard_cases/text.hpp"

#include "studies/hard_cases/table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace carom::cli {

namespace {

std::string line(const std::string& name, const std::string& engines, const std::string& verdict, const std::string& worst,
                 const std::string& checked) {
  return fmt::format("{:<38} {:>7}  {:<8} {:<46} {}\n", name, engines, verdict, worst, checked);
}

}  // namespace

std::string hardcases_list(std::span<const HardCase> cases) {
  std::string text, family;
  for (const HardCase& one : cases) {
    if (one.family != family) text += fmt::format("{}{}\n", family.empty() ? "" : "\n", one.family);
    family = one.family;
    text += fmt::format("  {:<38} {}{}\n", one.name, one.title, one.takes_long ? " (--long)" : "");
  }
  return text;
}

std::string hardcases_header() { return line("case", "engines", "verdict", "nearest to its bound", "checked"); }

std::string hardcases_row(const CaseVerdict& verdict) {
  const HardCaseRow row = row_of(verdict);
  return line(row.name, verdict.engines.empty() ? "-" : fmt::format("{}", verdict.engines.size()), row.verdict,
              verdict.holds() ? row.worst : "see below", row.checked);
}

std::string hardcases_footer(std::span<const CaseVerdict> verdicts) {
  std::string text = "\n";
  for (const CaseVerdict& one : verdicts)
    for (const CaseCheck& check : one.checks)
      if (!check.holds)
        text += fmt::format("{}, {}: {} {:.3g} is not within {:.3g}{}\n", one.name, check.engine, check.what, check.value,
                            check.bound, check.remark.empty() ? "" : ": " + check.remark);
  return fmt::format("{}{}\n{}\n", text, always_checked(), summary_of(verdicts));
}

}  // namespace carom::cli
