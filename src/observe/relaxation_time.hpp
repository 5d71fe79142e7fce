#pragma once
// When a function of the lag has fallen to 1/e.

#include "observe/blocking.hpp"
#include "observe/lagged_rows.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

namespace carom {

/// Returns the time at which `function`, the mean of `rows`, has fallen to 1/e, between two rows in proportion to the logarithm
/// of time. Its error is at most that of the line between both rows there, whose errors add up. Its halves are those of the row
/// that is nearer. `step` is the time of a step.
[[nodiscard]] inline Scalar relaxation_time(std::string name, const LaggedRows& rows, double step, std::string_view function) {
  Scalar found{.name = std::move(name), .unit = "time"};
  const double level = 1.0 / std::numbers::e;
  for (std::size_t row = 2; row < rows.size(); ++row) {
    const auto before = rows.estimate(row - 1), here = rows.estimate(row);
    if (!before || !here || !(before->mean >= level && here->mean < level)) continue;
    const double from = std::log(LaggedStates::lag(row - 1)), to = std::log(LaggedStates::lag(row));
    const double slope = (here->mean - before->mean) / (to - from);
    const double time = step * std::exp(from + (level - before->mean) / slope);
    found.value = time;
    const double share = (level - before->mean) / (here->mean - before->mean);  // of the way from one row to the other
    if (before->error && here->error) found.error = time * std::lerp(*before->error, *here->error, share) / std::abs(slope);
    if (before->lower_bound || here->lower_bound) found.note = fmt::format("{}: the error is a lower bound", too_short);
    const bool is_nearer_to_this = level - here->mean < before->mean - level;
    const double at_row = is_nearer_to_this ? here->mean : before->mean, per_fall = -time / slope;
    found.halves = in_proportion(rows.halves(is_nearer_to_this ? row : row - 1), per_fall, time - per_fall * at_row);
    return found;
  }
  found.note = fmt::format("{} does not fall to 1/e between one step and the longest lag", function);
  return found;
}

}  // namespace carom
