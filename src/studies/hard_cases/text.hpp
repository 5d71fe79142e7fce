#pragma once
// The table of carom hardcases on a terminal.

#include "studies/hard_cases/hard_case.hpp"

#include <span>
#include <string>

namespace carom::cli {

/// Returns every case with what it states, by family.
std::string hardcases_list(std::span<const HardCase> cases);

std::string hardcases_header();
std::string hardcases_row(const CaseVerdict& verdict);
/// Returns what was checked, how many cases hold, and one line for every check that fails.
std::string hardcases_footer(std::span<const CaseVerdict> verdicts);

}  // namespace carom::cli
