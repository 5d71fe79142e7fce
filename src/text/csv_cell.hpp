#pragma once
// Numbers in tables of comma-separated values.

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace carom {

/// Returns the fewest digits that read back as the same double, with a point or an exponent, so that readers which look at the
/// first rows alone do not take a column for one of whole numbers; "NaN" where the number is unknown or not finite.
[[nodiscard]] inline std::string csv_cell(double value) { return std::isfinite(value) ? fmt::format("{:#}", value) : "NaN"; }

}  // namespace carom
