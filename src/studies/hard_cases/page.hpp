#pragma once
// The verdicts on hard cases as a page.

#include "studies/hard_cases/hard_case.hpp"

#include <carom/pages/page.hpp>

#include <span>
#include <string>

namespace carom {

/// `cases` in the order of `verdicts`.
[[nodiscard]] Page hard_case_page(std::span<const HardCase> cases, std::span<const CaseVerdict> verdicts,
                                  const std::string& command_line);

}  // namespace carom
