#pragma once
// A sweep's results as a page: every number against every swept key, with error bars, tables, and the runs that failed.

#include "studies/sweep/results.hpp"

#include <carom/pages/page.hpp>

namespace carom {

/// Returns the page of a sweep.
[[nodiscard]] Page sweep_page(const Sweep& sweep, const SweepResults& results);

}  // namespace carom
