#pragma once
// What correlations do to all their lags at every step, in rows that lie side by side: four at a time.

#include <cstddef>

namespace carom {

/// All give the same bits.
struct LagRowsKernel {
  /// now = samples - first
  void (*since)(const double* samples, const double* first, std::size_t rows, double* now);
  /// Adds `now` and its square to the sums. The first of two blocks is left in `waiting`; the second is joined with it: now
  /// becomes the mean of both.
  void (*block)(bool second, std::size_t rows, double* now, double* sum, double* square, double* waiting);
  /// Mean of a.x b.x and a.y b.y over earlier values b.
  void (*products)(const double* a, const double* x, const double* y, std::size_t rows, double* found);
  /// The same of (a.x - b.x)^2 and (a.y - b.y)^2.
  void (*squares)(const double* a, const double* x, const double* y, std::size_t rows, double* found);
};

[[nodiscard]] const LagRowsKernel& lag_rows_kernel();

}  // namespace carom
