#pragma once
// The plots of a comparison.

#include "studies/compare/comparison.hpp"
#include "studies/compare/mistake_law.hpp"
#include "studies/compare/summaries.hpp"
#include "studies/horizon/page.hpp"

#include <carom/pages/page.hpp>

#include <string>
#include <vector>

namespace carom {

[[nodiscard]] Plot error_in_time(const Comparison& comparison);
[[nodiscard]] Plot work_precision(const Comparison& comparison, const std::vector<MethodSummary>& summaries);

/// The horizon of each method against its price: how long a trajectory can be trusted for a processor second. `disks` is their
/// number.
[[nodiscard]] Plot trust_for_price(const Comparison& comparison, const std::vector<MethodSummary>& summaries, double disks);

[[nodiscard]] Plot faults_of_steps(const Comparison& comparison, const std::vector<MethodSummary>& summaries);
[[nodiscard]] Plot mistakes_of_steps(const Comparison& comparison, const std::vector<MethodSummary>& summaries,
                                     const std::optional<MistakeLaw>& law);
[[nodiscard]] Plot overlap_of_steps(const Comparison& comparison, const std::vector<MethodSummary>& summaries);

/// One of MethodSummary's biases over dt. `law` is a dashed line of theory over the ladder, or has no points.
[[nodiscard]] Plot bias_of(const Comparison& comparison, const std::vector<MethodSummary>& summaries, const std::string& id,
                           const std::string& what, std::optional<Estimate> MethodSummary::*bias, const Series& law = {});

/// Returns the law of the bias of Z, in per cent over the ladder, for equal disks of a fluid at this packing fraction that are
/// reversed where they are found overlapping. Without points where the law is not known.
[[nodiscard]] Series law_of_bias(const Comparison& comparison, double packing_fraction);

[[nodiscard]] Plot energy_of_steps(const Comparison& comparison, const std::vector<MethodSummary>& summaries);

[[nodiscard]] Plot cost_against_size(const Comparison& comparison, double packing_fraction);
[[nodiscard]] Plot cost_against_density(const Comparison& comparison);

}  // namespace carom
