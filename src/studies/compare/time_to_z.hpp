#pragma once
// The processor time that each method needs for the compressibility factor.

#include "studies/compare/summaries.hpp"

#include <optional>
#include <string>
#include <vector>

namespace carom {

/// Processor time for Z to a relative accuracy, bias and statistical error together.
struct TimeToZ {
  std::string method;
  double accuracy = 0.0;
  std::optional<double> dt;       ///< the best; empty for exact events, and where there is none
  std::optional<double> seconds;  ///< empty where no dt will do, or it is not known
  std::string remark;             ///< why it is empty
};

/// Returns the rows for 1 % and 0.1 %. The statistical error of Z is C / sqrt(collisions), with C from the exact runs over the
/// seeds. The bias of the guarded methods is fitted as slope times dt where it is below a tenth of Z - 1; elsewhere, and for the
/// naive methods, the measured bias is used, with its error. The dt is that for which the time to bring the statistical error
/// down to what the bias leaves of the accuracy is shortest. A method whose bias exceeds the accuracy at every dt has no time.
///
/// The row "richardson" is that of two runs of `grid` with dt and dt / 2: 2 A(dt / 2) - A(dt) has no bias of first order. Its
/// bias of second order is taken from a parabola through the biases of `grid`.
[[nodiscard]] std::vector<TimeToZ> time_to_Z(const Comparison& comparison, const std::vector<MethodSummary>& summaries);

}  // namespace carom
