#pragma once
// Errors for whole columns of a table.

#include <carom/blocking.hpp>
#include <carom/observe.hpp>

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// How a note begins where blocks of any length are correlated.
inline constexpr std::string_view too_short = "the run is too short for its correlations";

/// The entry of a table for an unknown number.
inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Below this many blocks their scatter says little: the error has an error of 1 / sqrt(2 (n - 1)), a quarter at 8.
inline constexpr std::uint64_t least_blocks = 8;

/// The relative error up to which a number that counts rare events, or is a mean of squares, can be compared with itself: with
/// fewer of them Student's t makes chance look rarer than it is. The mean of n squares of Gaussian numbers has the relative error
/// sqrt(2 / n) and the skewness sqrt(8 / n), which is then at most 0.1.
inline constexpr double most_error_of_halves = 0.05;

/// Compares the mean over a share of the run, the first, with that over the rest. The standard error of the latter came from so
/// many independent blocks. Returns nothing where a number is unknown, or there is no scatter but rounding.
[[nodiscard]] std::optional<Halves> compared_halves(double share, double first, double rest, double error_of_rest, double blocks);

/// Returns how many of a few long blocks are the first part of a run, a third or more; the rest is an even number of them.
/// Returns 0 for fewer than 16, which are too few. The rest counts as half as many independent blocks, for correlations may reach
/// from one into the next.
[[nodiscard]] std::size_t first_of_long_blocks(std::size_t blocks);

/// Returns the halves of offset + factor x from those of x.
[[nodiscard]] std::optional<Halves> in_proportion(std::optional<Halves> halves, double factor, double offset = 0.0);

/// Returns the halves where the rest is known to this relative error or better, else nothing.
[[nodiscard]] std::optional<Halves> if_known(const std::optional<Halves>& halves, double most_error = most_error_of_halves);

/// Compares the halves of the rows of a column. A row takes part where the rest knows it to `most_error` or better.
class ColumnComparison {
 public:
  explicit ColumnComparison(double most_error = most_error_of_halves) : most_error_(most_error) {}
  /// Takes the next row, whose numbers in the table are offset + factor times those of `halves`.
  void add(const std::optional<Halves>& halves, double factor = 1.0, double offset = 0.0);
  /// Adds what was found to a table whose first columns, which say where its rows are, are there.
  void put(Table& table, const std::string& column, std::size_t dimensions = 1) const;

 private:
  double most_error_;
  std::size_t row_ = 0, row_of_most_ = 0;
  ColumnHalves most_;
};

/// Adds a remark to an observable where some errors in its tables are lower bounds (Blocking::Estimate::lower_bound).
void note_lower_bounds(Measurement& found, bool some_are);

/// Counts the rows of a column whose errors are lower bounds. A few are so by chance: neighbours, which scatter together.
class LowerBounds {
 public:
  void add(const Blocking::Estimate& found);
  /// Returns whether they are a quarter or more of the rows that have an error.
  [[nodiscard]] bool are_many() const { return bounds_ > 0 && 4 * bounds_ >= known_; }

 private:
  std::size_t known_ = 0, bounds_ = 0;
};

/// A Blocking for every row of a column.
class BlockedColumn {
 public:
  BlockedColumn() = default;
  explicit BlockedColumn(std::size_t rows) : rows_(rows) {}
  void add(std::size_t row, double x, double weight = 1.0) { rows_[row].add(x, weight); }
  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] const Blocking& row(std::size_t at) const { return rows_[at]; }
  /// Returns whether errors of many rows are lower bounds, of those rows that are known as well as a count of sixteen independent
  /// events: one fast disk stays in its bin for a while.
  [[nodiscard]] bool has_lower_bounds() const;
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
