#pragma once
// The one rule for units on axes, in headings and in lines: a label's unit stands in brackets behind it, made of the scene's own
// units, "(length² / time in scene units)"; a pure number has none.

#include <string>
#include <string_view>

namespace carom {

/// Returns text such as "length^2 / time" as "length² / time".
[[nodiscard]] std::string unit_words(std::string_view unit);

/// Returns the label with its unit, which is empty for a pure number: "speed (length / time in scene units)", "time (scene
/// units)".
[[nodiscard]] std::string with_unit(const std::string& label, std::string_view unit);

}  // namespace carom
