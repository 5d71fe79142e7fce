#pragma once
// The values of a sweep's keys, as tables and plots show them.

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

}  // namespace carom
