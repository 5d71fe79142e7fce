#pragma once
// The plots of a sweep.

#include "studies/sweep/results.hpp"

#include <carom/pages/page.hpp>

#include <cstddef>
#include <vector>

namespace carom {

/// Returns whether the number is not the same everywhere: else there is nothing to see.
[[nodiscard]] bool varies(const SweepResults& results, std::size_t number);

/// Returns a number against each key that has more than one numeric value: a curve for every combination of the others.
[[nodiscard]] std::vector<Plot> plots_of(const Sweep& sweep, const SweepResults& results, std::size_t number);

}  // namespace carom
