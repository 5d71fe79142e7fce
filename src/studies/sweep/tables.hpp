#pragma once
// A sweep's results as text: one row per run, and one per point with means over its seeds and their standard errors.

#include "studies/sweep/results.hpp"

#include <string>

namespace carom {

/// Returns the text of runs.csv.
[[nodiscard]] std::string runs_csv(const Sweep& sweep, const SweepResults& results);
/// Returns the text of sweep.csv.
[[nodiscard]] std::string points_csv(const Sweep& sweep, const SweepResults& results);

}  // namespace carom
