#include "studies/sweep/words.hpp"

#include "text/numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace carom {

bool differ(double a, double b) { return std::abs(a - b) > 1e-9 * std::max(std::abs(a), std::abs(b)); }

std::string average_words(const SeedAverage& average) {
  if (!average.mean) return "–";
  const bool has_error = average.error && differ(*average.mean, *average.mean + *average.error);
  return has_error ? with_error(*average.mean, *average.error) : fmt::format("{:.6g}", *average.mean);
}

}  // namespace carom
