#pragma once
// The plots of a comparison.

#include "studies/compare/answers.hpp"
#include "studies/compare/comparison.hpp"
#include "studies/horizon/page.hpp"

#include <carom/pages/page.hpp>

#include <string>
#include <vector>

namespace carom {

[[nodiscard]] Plot error_in_time(const Comparison& comparison);
[[nodiscard]] Plot work_precision(const Comparison& comparison, const std::vector<MethodSummary>& summaries);
[[nodiscard]] Plot faults_of_steps(const Comparison& comparison, const std::vector<MethodSummary>& summaries);
[[nodiscard]] Plot overlap_of_steps(const Comparison& comparison, const std::vector<MethodSummary>& summaries);

/// One of MethodSummary's biases over dt.
[[nodiscard]] Plot bias_of(const Comparison& comparison, const std::vector<MethodSummary>& summaries, const std::string& id,
                           const std::string& what, std::optional<Estimate> MethodSummary::*bias);
[[nodiscard]] Plot energy_of_steps(const Comparison& comparison, const std::vector<MethodSummary>& summaries);

[[nodiscard]] Plot cost_against_size(const Comparison& comparison, double packing_fraction);
[[nodiscard]] Plot cost_against_density(const Comparison& comparison);

}  // namespace carom
