#pragma once
// The difference of two runs as text for the terminal and as JSON.

#include "studies/diff/diff.hpp"

#include <string>

namespace carom {

/// Returns the table and the sentences that `carom diff` prints.
[[nodiscard]] std::string diff_text(const RunDifference& difference);

/// Returns the same as JSON; docs/output.md lists the keys.
[[nodiscard]] std::string diff_json(const RunDifference& difference);

}  // namespace carom
