#pragma once
// Tables of observables, averaged over the seeds of a point.

#include "studies/sweep/results.hpp"
#include "studies/sweep/sweep.hpp"

#include <carom/observe.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace carom {

/// Returns the table in a file observe_NAME.csv of a run. Throws std::runtime_error where it is none.
[[nodiscard]] Table read_observed_table(const std::filesystem::path& path);

/// Returns whether the rows of a table are points of a curve, in the order of its first column: cells of a grid are not.
[[nodiscard]] bool is_curve(const Table& table);

/// Returns the column of the last value that belongs to each row, where a row begins with the value of the first column:
/// "size_to" beside "size"; null where a row has one value.
[[nodiscard]] const Column* last_in_rows(const Table& table);

/// Returns the names of the columns that say which row of a table it is: the first, and of cells of a grid "x" and "y" after it.
[[nodiscard]] std::vector<std::string> key_columns(const Table& table);

/// Returns the number in `column` of a table where the first columns have the values `at`. On a curve that is on a straight line
/// between the two rows around one value; that of a column of errors is an upper bound, because errors of neighbouring rows are
/// correlated. Of rows from a size to another it is that of the row that contains the value. Of cells it is the number of the
/// cell that contains the place; an edge belongs to the cell right of or above it. Nothing where the table has no such column,
/// ends before, is no curve for one value, or has no number there.
[[nodiscard]] std::optional<double> value_at(const Table& table, const std::string& column, const std::vector<double>& at);

/// Returns the table of means over tables of the same columns, row by row. Columns that come with errors, and others that differ,
/// have the standard error of independent seeds in `NAME_error`; NaN is left out. Rows are those that all have. Throws
/// std::runtime_error, with a sentence without its stop, where columns differ, or the values of the first one;
/// `radii_are_drawn`, by each seed, may be why.
[[nodiscard]] Table mean_of_tables(const std::vector<Table>& tables, bool radii_are_drawn = false);

/// A table of one point, over its finished seeds.
struct SeedTable {
  std::size_t point = 0;
  std::size_t seeds = 0;   ///< number of tables that it is the mean of
  Table table = {};        ///< empty where there is a `fault`
  std::string fault = {};  ///< why it has no mean
};

/// Returns the means of all tables of observables, point by point, of points with two finished seeds at least.
[[nodiscard]] std::vector<SeedTable> seed_tables_of(const Sweep& sweep, const SweepResults& results,
                                                    const std::filesystem::path& directory);

/// Returns the text of the file of a mean.
[[nodiscard]] std::string seed_table_csv(const SeedTable& mean);

}  // namespace carom
