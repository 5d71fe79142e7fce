#include "studies/hard_cases/table.hpp"

#include "io/json.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace carom {

namespace {

/// Checked in every run, so that rows need not name them.
constexpr std::array<std::string_view, 7> always = {"invariants",   "finite",  "clock",      "stopped",
                                                    "time reached", "overlap", "same events"};

std::string checked_beyond_always(const CaseVerdict& verdict) {
  std::vector<std::string> names;
  for (const CaseCheck& check : verdict.checks) {
    if (std::find(always.begin(), always.end(), check.what) != always.end()) continue;
    if (std::find(names.begin(), names.end(), check.what) == names.end()) names.push_back(check.what);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string worst_value(const CaseVerdict& verdict) {
  const CaseCheck* worst = verdict.worst();
  if (worst == nullptr) return "";
  if (!worst->holds && !worst->remark.empty()) return fmt::format("{} ({}): {}", worst->what, worst->engine, worst->remark);
  if (worst->holds && worst->bound == 0.0) return "exact";
  return fmt::format("{} {:.2g} of {:.2g} ({})", worst->what, worst->value, worst->bound, worst->engine);
}

std::size_t failures(std::span<const CaseVerdict> verdicts) {
  return static_cast<std::size_t>(std::count_if(verdicts.begin(), verdicts.end(), [](const auto& one) { return !one.holds(); }));
}

/// Returns `text` with its bars escaped, which would end the cell.
std::string table_cell(std::string text) {
  for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2)) text.replace(at, 1, "\\|");
  return text;
}

}  // namespace

HardCaseRow row_of(const CaseVerdict& verdict) {
  HardCaseRow row{.name = verdict.name,
                  .engines = verdict.engines.empty() ? "-" : fmt::format("{}", fmt::join(verdict.engines, ", ")),
                  .checked = checked_beyond_always(verdict),
                  .worst = worst_value(verdict),
                  .verdict = verdict.checks.empty() ? "not run"
                             : verdict.holds()      ? "holds"
                                                    : "FAILS"};
  return row;
}

std::string summary_of(std::span<const CaseVerdict> verdicts) {
  std::size_t runs = 0, checks = 0;
  double seconds = 0.0;
  for (const CaseVerdict& one : verdicts) {
    runs += one.engines.size();
    checks += one.checks.size();
    seconds += one.seconds;
  }
  const std::size_t failed = failures(verdicts);
  const auto not_run = std::count_if(verdicts.begin(), verdicts.end(), [](const auto& one) { return one.checks.empty(); });
  return fmt::format("{} {}, {}{} runs, {} checks: {}; {:.3g} s", verdicts.size(), verdicts.size() == 1 ? "case" : "cases",
                     not_run > 0 ? fmt::format("{} not run, ", not_run) : "", runs, checks,
                     failed == 0 ? "all hold" : fmt::format("{} {}", failed, failed == 1 ? "case fails" : "cases fail"), seconds);
}

std::string always_checked() {
  return "Also checked in every run: the engine's invariants, that every number is finite, that neither events nor samples go "
         "back in "
         "time, why the run stopped and when, the deepest overlap, and that every engine has the same events in the same order.";
}

std::string hard_cases_markdown(std::span<const CaseVerdict> verdicts) {
  std::string text;
  for (const std::string& family : hard_case_families()) {
    bool first = true;
    for (const CaseVerdict& one : verdicts) {
      if (one.family != family) continue;
      if (first)
        text += fmt::format(
            "\n### {}\n\n| case | what it states | engines | checked | nearest to its bound | |\n|---|---|---|---|---|---|\n",
            family);
      first = false;
      const HardCaseRow row = row_of(one);
      text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", row.name, table_cell(one.title), one.engines.size(),
                          table_cell(row.checked), table_cell(row.worst), row.verdict);
    }
  }
  return text + "\n" + summary_of(verdicts) + ".\n";
}

std::string hard_cases_json(std::span<const CaseVerdict> verdicts) {
  detail::Json json;
  json["carom"] = detail::build_json();
  json["failed"] = failures(verdicts);
  json["cases"] = detail::Json::array();
  for (const CaseVerdict& one : verdicts) {
    detail::Json checks = detail::Json::array();
    for (const CaseCheck& check : one.checks) {
      detail::Json entry = {{"what", check.what},
                            {"engine", check.engine},
                            {"value", detail::number(check.value)},
                            {"bound", detail::number(check.bound)},
                            {"holds", check.holds}};
      if (!check.remark.empty()) entry["remark"] = check.remark;
      checks.push_back(std::move(entry));
    }
    json["cases"].push_back({{"name", one.name},
                             {"family", one.family},
                             {"title", one.title},
                             {"engines", one.engines},
                             {"seconds", one.seconds},
                             {"verdict", row_of(one).verdict},
                             {"checks", std::move(checks)}});
  }
  return json.dump(2, ' ', false, detail::Json::error_handler_t::replace);
}

namespace {

TextTable table_of(std::span<const CaseVerdict> verdicts, const std::string& family) {
  TextTable table{.title = family,
                  .columns = {"case", "what it states", "engines", "checked", "nearest to its bound", "verdict"}};
  for (const CaseVerdict& one : verdicts) {
    if (one.family != family) continue;
    const HardCaseRow row = row_of(one);
    table.rows.push_back({row.name, one.title, row.engines, row.checked, row.worst, row.verdict});
  }
  return table;
}

}  // namespace

Page hard_case_page(std::span<const HardCase> cases, std::span<const CaseVerdict> verdicts, const std::string& command_line) {
  const auto held = std::count_if(verdicts.begin(), verdicts.end(), [](const CaseVerdict& one) { return one.holds(); });
  Page page{.generator = "carom hardcases",
            .title = "Hard cases",
            .subtitle = summary_of(verdicts),
            .lead = always_checked(),
            .key_numbers = {{fmt::format("{} of {}", held, verdicts.size()), "cases hold"}}};
  for (const std::string& family : hard_case_families()) {
    Section section{.heading = family, .blocks = {table_of(verdicts, family)}};
    if (std::get<TextTable>(section.blocks.front()).rows.empty()) continue;
    for (const HardCase& one : cases)
      if (one.family == family) section.blocks.emplace_back(Listing{one.name, one.text});
    page.sections.push_back(std::move(section));
  }
  page.facts = {{"Command", command_line}};
  add_build(page.facts);
  return page;
}

}  // namespace carom

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
