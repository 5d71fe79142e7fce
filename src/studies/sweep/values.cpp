#include "studies/sweep/values.hpp"

#include <algorithm>
#include <charconv>

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

}  // namespace carom
