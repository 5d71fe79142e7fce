#pragma once
// The processor time that each method needs for the compressibility factor.

#include "studies/compare/answers.hpp"

#include <vector>

namespace carom {

/// Returns the rows for 1 % and 0.1 %. The statistical error of Z is C / sqrt(collisions), with C from the exact runs over the
/// seeds. The bias of the guarded methods is fitted as slope times dt where it is below a tenth of Z - 1; elsewhere, and for the
/// naive methods, the measured bias is used, with its error. The dt is that for which the time to bring the statistical error
/// down to what the bias leaves of the accuracy is shortest. A method whose bias exceeds the accuracy at every dt has no time.
[[nodiscard]] std::vector<TimeToZ> time_to_Z(const Comparison& comparison, const std::vector<MethodSummary>& summaries);

}  // namespace carom
