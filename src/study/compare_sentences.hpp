#pragma once
// The answer in words, every number from the data.

#include "study/compare_answers.hpp"

#include <string>
#include <vector>

namespace carom {

/// What accuracy costs; where the fixed step is the cheaper way to a crude answer; what it does to collisions and to Z.
[[nodiscard]] std::vector<std::string> compare_sentences(const Comparison& comparison,
                                                         const std::vector<MethodSummary>& summaries, const Answers& answers);

}  // namespace carom
