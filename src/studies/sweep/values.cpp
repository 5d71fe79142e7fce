#include "studies/sweep/values.hpp"

#include "text/numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace carom {

std::optional<double> number_of(const std::string& value) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  return error == std::errc() && end == value.data() + value.size() && !value.empty() ? std::optional(number) : std::nullopt;
}

bool is_numeric(const Sweep& sweep, std::size_t key) {
  return std::all_of(sweep.points.begin(), sweep.points.end(), [&](const SweepPoint& point) {
    return point.values[key].empty() || number_of(point.values[key]).has_value();
  });
}

std::string plain_value(const std::string& value) {
  const bool is_plain_string = value.size() >= 2 && value.front() == '"' && value.find('\\') == std::string::npos;
  return is_plain_string ? value.substr(1, value.size() - 2) : value;
}

bool differ(double a, double b) { return std::abs(a - b) > 1e-9 * std::max(std::abs(a), std::abs(b)); }

std::string average_words(const SeedAverage& average) {
  if (!average.mean) return "–";
  const bool has_error = average.error && differ(*average.mean, *average.mean + *average.error);
  return has_error ? with_error(*average.mean, *average.error) : fmt::format("{:.6g}", *average.mean);
}

}  // namespace carom
