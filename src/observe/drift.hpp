#pragma once
// Whether a run was in equilibrium: the first and the second half of it compared, for every number.

#include <carom/observe.hpp>
#include <carom/scene.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// How a remark on a number begins whose two halves differ by more than chance.
inline constexpr std::string_view not_in_equilibrium = "not yet at equilibrium";
inline constexpr std::string_view not_steady = "not steady";

/// Adds a remark to each number of a run whose halves (Scalar::halves) differ by more than chance: with a probability below 0.9 %
/// over the number of numbers that are compared. With the 0.1 % of the Z of the summary, at most one of a hundred runs in
/// equilibrium has such a remark anywhere, however the numbers depend on each other. Where disks lose energy or grow, or the
/// scene changes during the run, the remark says that the number is not steady. A table has the remark with its measurement, on
/// the row in which its halves differ the most, with the place of that row, in two dimensions with both coordinates.
void note_drifts(std::vector<Measurement>& measured, const Scene& scene);

/// Returns such a remark on the Z of the summary, which only runs have whose energy is steady; empty where there is none.
[[nodiscard]] std::string note_on_drift_of_Z(const std::optional<Halves>& halves);

/// Returns the names of the numbers with such a remark: "pressure.Z", "radial_distribution (its table)".
[[nodiscard]] std::vector<std::string> drifting_numbers(const std::vector<Measurement>& measured);

/// Returns whether a remark says that a number is not yet at equilibrium: to equilibrate for longer may help.
[[nodiscard]] bool says_not_in_equilibrium(std::string_view note);
/// Returns whether a number or a table of these has a remark that says so.
[[nodiscard]] bool some_not_in_equilibrium(const std::vector<Measurement>& measured);

/// Returns the sentence that says of which numbers the halves differ: "... so it was not in equilibrium: Z, pressure.Z."
[[nodiscard]] std::string sentence_of_drifts(const std::vector<std::string>& names, bool in_equilibrium_expected);

}  // namespace carom
