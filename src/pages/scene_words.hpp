#pragma once
// A scene and its effects in words.

#include "pages/summary_rows.hpp"

#include <carom/box.hpp>
#include <carom/effects.hpp>
#include <carom/scene.hpp>

#include <string>

namespace carom {

/// Returns the collision, and each effect beside it: a subject and what is said of it.
[[nodiscard]] SummaryRows words_of(const Effects& effects);

/// Returns the quantities that the dynamics conserves, rounding aside: "energy, momentum along x"; "nothing" where there is none.
[[nodiscard]] std::string conserved(const Box& box, const Effects& effects);

/// Returns the effects that the scene does not simulate, as part of a sentence: "rough disks with spin, a thermostat"; empty
/// where there are none.
[[nodiscard]] std::string absent(const Effects& effects);

/// Disks, box, collisions, effects, run: a subject and what is said of it.
[[nodiscard]] SummaryRows words_of(const Scene& scene);

/// Returns text such as "every 0.5", "every 1,000 collisions". Requires a run with samples.
[[nodiscard]] std::string sampling_words(const Run& run);

}  // namespace carom
