#pragma once
// The effects of a scene in words.

#include <carom/effects.hpp>

#include <string>

namespace carom::cli {

/// One line for the collision and one for each effect beside it, as in describe(Scene). Ends with a newline.
std::string describe(const Effects& effects);

/// What the scene does not call for, as one sentence part: "gravity, a thermostat, shear"; empty where it calls for everything.
std::string absent(const Effects& effects);

}  // namespace carom::cli
