#pragma once
// How pages show an engine or a fixed-step method.

#include <string>

namespace carom {

/// Returns the method's colour in every plot.
[[nodiscard]] int group_of(const std::string& method);
/// Returns its name for people: "double", "113 bits", "grid, fixed step".
[[nodiscard]] std::string name_of(const std::string& method);

}  // namespace carom
