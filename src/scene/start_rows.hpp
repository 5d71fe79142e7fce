#pragma once
// The rows of a start file, whatever its format, on their way into a StartFile.

#include "scene/start_file.hpp"

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace carom::detail {

inline constexpr std::array<std::string_view, 6> start_columns = {"x", "y", "vx", "vy", "radius", "mass"};

class StartRows {
 public:
  /// Throws with the place of a column, counted from 0, in the row at hand.
  using Fail = std::function<void(std::size_t column, const std::string& sentence)>;

  StartRows(const std::string& source, Fail fail) : fail_(std::move(fail)) { file_.rows.source = source; }

  /// Fails at a name that is no column or stands twice, and where a column is missing.
  void name_columns(std::span<const std::string_view> names);

  [[nodiscard]] std::size_t column_count() const { return order_.size(); }
  [[nodiscard]] std::string_view name(std::size_t column) const { return start_columns[order_[column]]; }

  /// One value for each column. Fails where a radius or mass is not above zero, and where a value is not finite.
  void add(std::span<const double> values, std::array<int, 2> place);

  StartFile take() { return std::move(file_); }

 private:
  Fail fail_;
  std::vector<std::size_t> order_;  ///< of each column of the file, its number in start_columns
  StartFile file_;
};

}  // namespace carom::detail
