#pragma once
// How long each method takes to know the compressibility factor.

#include "studies/compare/answers.hpp"

#include <vector>

namespace carom {

/// For 1 % and 0.1 %. Chance: Z scatters by C / sqrt(collisions), with C from the exact runs over the seeds. Bias: that of the
/// guarded methods is fitted, slope times dt, where it is below a tenth of Z - 1; elsewhere, and for the naive methods, it is
/// taken as it was measured, with its error. Then the dt is taken for which the time to bring chance down to what bias leaves of
/// the accuracy is shortest. A method whose bias is larger than the accuracy at every dt never gets there.
[[nodiscard]] std::vector<TimeToZ> time_to_Z(const Comparison& comparison, const std::vector<MethodSummary>& summaries);

}  // namespace carom
