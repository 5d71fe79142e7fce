#pragma once
// The effects of a scene in words.

#include "pages/summary_row.hpp"

#include <carom/box.hpp>
#include <carom/effects.hpp>

#include <string>

namespace carom {

/// Returns the collision, and each effect beside it: a subject and what is said of it.
[[nodiscard]] SummaryRows words_of(const Effects& effects);

/// Returns the quantities that the dynamics conserves, rounding aside: "energy, momentum along x"; "nothing" where there is none.
[[nodiscard]] std::string conserved(const Box& box, const Effects& effects);

/// Returns the effects that the scene does not simulate, as part of a sentence: "rough disks with spin, a thermostat"; empty
/// where there are none.
[[nodiscard]] std::string absent(const Effects& effects);

}  // namespace carom
