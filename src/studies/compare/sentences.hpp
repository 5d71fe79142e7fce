#pragma once
// The answer in words, every number from the data.

#include "studies/compare/answers.hpp"

#include <string>
#include <vector>

namespace carom {

/// Returns the conclusions: the cost of accuracy, the errors for which the fixed step is cheaper, and its effect on collisions
/// and Z.
[[nodiscard]] std::vector<std::string> compare_sentences(const Comparison& comparison,
                                                         const std::vector<MethodSummary>& summaries, const Answers& answers);

/// Returns text such as "8 starts", or that there is one, and why.
[[nodiscard]] std::string starts_words(const ComparePlan& plan);

/// Returns a clause for each method that cannot run the scene, or not with all steps: the method, and the reason at its shortest
/// step.
[[nodiscard]] std::vector<std::string> reasons_left_out(const Comparison& comparison);

/// Two digits and no more: "1.3", "420", "23,000", "2.1e+09". Requires a positive value.
[[nodiscard]] std::string two_digits(double value);

}  // namespace carom
