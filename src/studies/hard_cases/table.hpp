#pragma once
// Verdicts of hard cases as people and programs read them: a table on a terminal, Markdown, JSON, a page.

#include "studies/hard_cases/hard_case.hpp"

#include <carom/pages/page.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// The mark of every page of hard cases, in its first 512 bytes.
inline constexpr std::string_view hard_cases_mark = "<meta name=\"generator\" content=\"carom hardcases\">";

/// One case in words.
struct HardCaseRow {
  std::string name;
  std::string engines;  ///< "fast, general, textbook"; "-" where none ran, as for a scene that is refused
  std::string checked;  ///< names of the checks besides those that are always made
  std::string worst;    ///< "overlap 2.2e-16 of 1e-12 (fast)"; where something fails, what was found
  std::string verdict;  ///< "holds", "FAILS" or "not run"
};
[[nodiscard]] HardCaseRow row_of(const CaseVerdict& verdict);

/// Returns text such as "96 cases, 530 runs, 6200 checks: all hold; 12 s"
[[nodiscard]] std::string summary_of(std::span<const CaseVerdict> verdicts);

/// Returns one sentence on what is checked in every run.
[[nodiscard]] std::string always_checked();

/// Returns the tables of docs/hard-cases.md, one for each family.
[[nodiscard]] std::string hard_cases_markdown(std::span<const CaseVerdict> verdicts);

[[nodiscard]] std::string hard_cases_json(std::span<const CaseVerdict> verdicts);

/// Returns the page of the verdicts; `cases` are in the order of `verdicts`.
[[nodiscard]] Page hard_case_page(std::span<const HardCase> cases, std::span<const CaseVerdict> verdicts,
                                  const std::string& command_line);

}  // namespace carom

namespace carom::cli {

/// Returns every case with what it states, by family.
std::string hardcases_list(std::span<const HardCase> cases);

std::string hardcases_header();
std::string hardcases_row(const CaseVerdict& verdict);
/// Returns what was checked, how many cases hold, and one line for every check that fails.
std::string hardcases_footer(std::span<const CaseVerdict> verdicts);

}  // namespace carom::cli
