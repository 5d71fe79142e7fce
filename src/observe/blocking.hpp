#pragma once
// Errors for whole columns of a table.

#include <carom/blocking.hpp>

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace carom {

/// The entry of a table for an unknown number.
inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// A Blocking for every row of a column.
class BlockedColumn {
 public:
  BlockedColumn() = default;
  explicit BlockedColumn(std::size_t rows) : rows_(rows) {}
  void add(std::size_t row, double x, double weight = 1.0) { rows_[row].add(x, weight); }
  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] const Blocking& row(std::size_t at) const { return rows_[at]; }
  /// The columns `name` and `name`_error; NaN where nothing is known.
  void put(Table& table, const std::string& name, const std::string& unit, double factor = 1.0) const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(rows_);
  }

 private:
  std::vector<Blocking> rows_;
};

}  // namespace carom
