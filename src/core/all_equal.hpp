#pragma once

#include <algorithm>
#include <functional>
#include <vector>

namespace carom {

[[nodiscard]] inline bool all_equal(const std::vector<double>& values) {
  return std::adjacent_find(values.begin(), values.end(), std::not_equal_to<>()) == values.end();
}

}  // namespace carom
