#pragma once
// The scenes that `carom init` writes: the texts of docs/scenes, built into the library so that the installed program
// has them too.

#include <string>
#include <vector>

namespace carom {

/// Returns the names of all presets: "box" first, then the others in alphabetical order.
std::vector<std::string> preset_names();

/// Returns the TOML text of a preset. Throws std::invalid_argument, with the names that exist, for any other name.
std::string preset(const std::string& name);

}  // namespace carom
