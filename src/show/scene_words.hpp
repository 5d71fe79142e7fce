#pragma once
// What a scene simulates, in words.

#include "show/summary_row.hpp"

#include <carom/scene.hpp>

namespace carom {

/// Disks, box, collisions, effects, run: a subject and what is said of it.
[[nodiscard]] SummaryRows words_of(const Scene& scene);

}  // namespace carom
