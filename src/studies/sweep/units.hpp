#pragma once
// What the numbers and keys of a sweep are measured in, made of the scene's own units.

#include <string>
#include <string_view>

namespace carom {

/// Of a number of summary.json that is none of an observable, as docs/output.md has it: "energy" for "energy.final"; empty for a
/// pure number.
[[nodiscard]] std::string unit_of_number(std::string_view name);

/// Of a key of the scene, as docs/scene-format.md has it: "length" for "disks.0.radius"; empty for a pure number and for words.
[[nodiscard]] std::string unit_of_key(std::string_view key);

}  // namespace carom
