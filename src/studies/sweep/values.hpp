#pragma once
// The values of a sweep's keys and numbers, as tables, plots and the terminal show them.

#include "studies/sweep/results.hpp"
#include "studies/sweep/sweep.hpp"

#include <cstddef>
#include <optional>
#include <string>

namespace carom {

/// Returns a value in TOML as a number; absent where it is none, or absent itself.
[[nodiscard]] std::optional<double> number_of(const std::string& value);
/// Returns whether all values of this key are numbers.
[[nodiscard]] bool is_numeric(const Sweep& sweep, std::size_t key);
/// Returns a string without the quotes that TOML needs; other values as they are.
[[nodiscard]] std::string plain_value(const std::string& value);

/// Returns whether two numbers differ by more than rounding leaves: a part in 10^9 of the larger.
[[nodiscard]] bool differ(double a, double b);

/// Returns text such as "1.0970 ± 0.0041", "50", or a dash where there is none.
[[nodiscard]] std::string average_words(const SeedAverage& average);

}  // namespace carom
