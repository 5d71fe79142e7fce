#pragma once
// A sweep's numbers as a person reads them.

#include "studies/sweep/results.hpp"

#include <string>

namespace carom {

/// Returns whether two numbers differ by more than rounding leaves: a part in 10^9 of the larger.
[[nodiscard]] bool differ(double a, double b);

/// Returns text such as "1.0970 ± 0.0041", "50", or a dash where there is none.
[[nodiscard]] std::string average_words(const SeedAverage& average);

}  // namespace carom
