#pragma once
// Products and squares of a correlator at all its lags, in rows side by side: four at a time, for many steps in a row.
//
// A matrix has a line for each step, as long as there are rows.

#include <cstddef>

namespace carom {

struct BlockSums {
  double *sum, *square, *waiting;
  std::size_t rows;    ///< the first of each line
  std::size_t length;  ///< of a line
};

/// All give the same bits.
struct LagRowsKernel {
  static constexpr std::size_t tree_levels = 5, tree_lines = std::size_t{1} << tree_levels;

  /// Takes `first` from all lines.
  void (*since)(double* samples, const double* first, std::size_t rows, std::size_t lines);
  /// Adds lines of `samples` and their squares to the sums. Each two are joined to their mean, a line of `means`, which may be
  /// where `samples` are; one that is left waits for the next. `second`: the first has one that waits.
  void (*blocks)(const double* samples, const BlockSums& sums, bool second, std::size_t lines, double* means);
  /// Both for tree_lines, with which blocks of all levels below tree_levels begin: those are `sums`. Leaves the mean of all in
  /// the first line.
  void (*blocks_of_tree)(double* samples, const double* first, const BlockSums* sums);
  /// Computes products of values whose latest come first: one value for each line, then as many earlier values as there are rows.
  /// Line n is about a, the n-th of the former in time; its row k is the mean of a.x b.x and a.y b.y, where b is the value k
  /// before a.
  void (*products)(const double* x, const double* y, std::size_t rows, std::size_t lines, double* found);
  /// Computes likewise the mean of (a.x - b.x)^2 and (a.y - b.y)^2.
  void (*squares)(const double* x, const double* y, std::size_t rows, std::size_t lines, double* found);
};

[[nodiscard]] const LagRowsKernel& lag_rows_kernel();

}  // namespace carom
