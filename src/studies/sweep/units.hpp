#pragma once
// The units of the numbers and keys of a sweep, made of the scene's own units.

#include <string>
#include <string_view>

namespace carom {

/// Returns the unit of a number of summary.json outside of `observables`, as in docs/output.md: "energy" for "energy.final";
/// empty for a pure number.
[[nodiscard]] std::string unit_of_number(std::string_view name);

/// Returns the unit of a key of the scene, as in docs/scene-format.md: "length" for "disks.0.radius"; empty for a pure number and
/// for words.
[[nodiscard]] std::string unit_of_key(std::string_view key);

}  // namespace carom
