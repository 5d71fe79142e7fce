#pragma once
// The tables of [observe] as plots, with error bars and what theory says of them.

#include "theory/run_theory.hpp"

#include <carom/pages/page.hpp>

#include <vector>

namespace carom {

/// One plot, or two where a table holds things that have no axis in common. A table that is not known here is plotted column by
/// column against its first one.
[[nodiscard]] std::vector<Plot> plots_of(const Table& table, const RunTheory& theory);

}  // namespace carom
