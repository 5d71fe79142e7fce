#pragma once
// Errors for whole columns of a table.

#include <carom/blocking.hpp>
#include <carom/observe.hpp>

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace carom {

/// The entry of a table for an unknown number.
inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Compares the halves of the rows of a column. A row takes part where its mean over the rest is known to 5 % or better: where
/// fewer events were counted, Student's t makes chance look rarer than it is.
class ColumnComparison {
 public:
  /// Takes the next row, whose numbers in the table are offset + factor times those of `halves`.
  void add(const std::optional<Halves>& halves, double factor = 1.0, double offset = 0.0);
  /// Adds what was found to a table whose first column is there.
  void put(Table& table, const std::string& column) const;

 private:
  std::size_t row_ = 0, row_of_most_ = 0;
  ColumnHalves most_;
};

/// A Blocking for every row of a column.
class BlockedColumn {
 public:
  BlockedColumn() = default;
  explicit BlockedColumn(std::size_t rows) : rows_(rows) {}
  void add(std::size_t row, double x, double weight = 1.0) { rows_[row].add(x, weight); }
  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] const Blocking& row(std::size_t at) const { return rows_[at]; }
  /// The columns `name` and `name`_error; NaN where nothing is known. The halves of rows are compared.
  void put(Table& table, const std::string& name, const std::string& unit, double factor = 1.0) const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(rows_);
  }

 private:
  std::vector<Blocking> rows_;
};

}  // namespace carom
