#pragma once
// The effects of a scene in words.

#include "pages/summary_row.hpp"

#include <carom/effects.hpp>

#include <string>

namespace carom {

/// The collision, and each effect beside it: a subject and what is said of it.
[[nodiscard]] SummaryRows words_of(const Effects& effects);

/// What the scene does not call for, as one sentence part: "gravity, a thermostat, shear"; empty where it calls for everything.
[[nodiscard]] std::string absent(const Effects& effects);

}  // namespace carom
