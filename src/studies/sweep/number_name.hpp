#pragma once
// The parts of a number's name: "observables.TABLE.COLUMN@VALUE".

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace carom::detail {

/// Names of numbers that observables measure begin so.
inline constexpr std::string_view observables_prefix = "observables.";

/// First columns that count something. There is nothing between two rows.
inline constexpr std::array<std::string_view, 2> counting_columns = {"neighbours", "size"};

/// Returns whether a column of a table says which row it is: of a lag, a time, a cell, or sizes.
inline bool is_place(std::string_view column) {
  static constexpr std::array<std::string_view, 7> places = {"lag", "time", "x", "y", "window", "integral_to", "size_to"};
  return std::ranges::find(places, column) != places.end();
}

/// Returns the observable of a number: "pressure" of "observables.pressure.Z".
inline std::string observable_of(std::string_view name) {
  const std::string_view rest = name.substr(observables_prefix.size());
  return std::string(rest.substr(0, rest.find('.')));
}

}  // namespace carom::detail
