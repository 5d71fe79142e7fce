// The ranges of the numbers of the scene format, in numbers and in words.

#include "scene/number_keys.hpp"

#include "scene/refusal.hpp"
#include "scene/value_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace carom::detail {

bool NumberKey::holds(double value) const {
  if (!std::isfinite(value)) return false;
  switch (range) {
    case Range::any:
      return true;
    case Range::zero_or_more:
      return value >= 0.0;
    case Range::above_zero:
      return value > 0.0;
    case Range::within:
      return value >= least && value <= most;
  }
  return false;
}

std::string NumberKey::expected() const {
  static constexpr const char* kinds[] = {"a finite number", "a finite number, zero or more", "a finite number above zero"};
  const std::string kind =
      range == Range::within ? fmt::format("a number from {} to {}", least, most) : kinds[static_cast<int>(range)];
  return fmt::format("{}, such as {}", kind, example);
}

void refuse_number(const std::string& path, double value, const NumberKey& key) {
  throw Refusal(path, fmt::format("{} is a floating-point number ({}); it must be {}", path, number_text(value), key.expected()));
}

void require(const std::string& table, const std::optional<double>& value, const NumberKey& key) {
  if (value && !key.holds(*value)) refuse_number(fmt::format("{}.{}", table, key.name), *value, key);
}

void require_pair(const std::string& path, const Eigen::Vector2d& pair, std::string_view example) {
  if (pair.allFinite()) return;
  const int axis = std::isfinite(pair[0]) ? 1 : 0;
  refuse_number(fmt::format("{}.{}", path, axis), pair[axis], {"", example});
}

}  // namespace carom::detail
