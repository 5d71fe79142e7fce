#pragma once
// Descriptions of a scene in words.

#include "pages/summary_row.hpp"

#include <carom/scene.hpp>

#include <string>

namespace carom {

/// Disks, box, collisions, effects, run: a subject and what is said of it.
[[nodiscard]] SummaryRows words_of(const Scene& scene);

/// Returns text such as "every 0.5", "every 1,000 collisions". Requires a run with samples.
[[nodiscard]] std::string sampling_words(const Run& run);

}  // namespace carom
