#pragma once
// Whether a run was in equilibrium: the first and the second half of it compared, for every number.

#include <carom/effects.hpp>
#include <carom/observe.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// How a remark on a number begins whose two halves differ by more than chance.
inline constexpr std::string_view not_in_equilibrium = "not yet at equilibrium";
inline constexpr std::string_view not_steady = "not steady";

/// Adds a remark to each number of a run whose halves (Scalar::halves) differ by more than chance: with a probability below 1 %
/// over the number of numbers that are compared, so that of a hundred runs in equilibrium at most one has such a remark anywhere,
/// however the numbers depend on each other. Where disks lose energy or grow, the remark says that the number is not steady.
/// A table has the remark with its measurement, on the row in which its halves differ the most.
void note_drifts(std::vector<Measurement>& measured, const Effects& effects);

/// Returns the names of the numbers with such a remark: "pressure.Z", "radial_distribution (its table)".
[[nodiscard]] std::vector<std::string> drifting_numbers(const std::vector<Measurement>& measured);

}  // namespace carom
