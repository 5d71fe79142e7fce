#include "studies/hard_cases/page.hpp"

#include "studies/hard_cases/table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace carom {

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
  Page page{.title = "Hard cases",
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
