#pragma once
// Blocking for rows that get a sample each at every step, as the lags of a correlation do: the same levels and estimates as a
// Blocking per row gives, at a fifth of the price. Sums of x and x^2 take the place of running means (no division), and all rows
// go from level to level together. x is taken from the first sample of its row on, which keeps the digits of the variance.

#include "observe/lag_rows.hpp"

#include <carom/blocking.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace carom {

class BlockedRows {
 public:
  BlockedRows() = default;
  explicit BlockedRows(std::size_t rows) : rows_(rows) {}

  /// The next step's samples. Row k begins at step k: requires min(rows, step + 1) numbers, step = 0, 1, 2, ...
  /// Blocks are the same steps for all rows, so that a row may leave its first sample out of the longer ones.
  void add(std::span<const double> samples);
  /// Nothing before the row has begun.
  [[nodiscard]] std::optional<Blocking::Estimate> estimate(std::size_t row) const;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(rows_, first_, levels_);
  }

 private:
  /// Blocks of 2^level steps.
  struct Level {
    std::uint64_t blocks = 0;  ///< of row 0
    std::vector<double> sum, square, waiting;

    template <class Archive>
    void serialize(Archive& archive) {
      archive(blocks, sum, square, waiting);
    }
  };

  std::size_t rows_ = 0;
  std::vector<double> first_;  ///< sample of every row
  std::vector<double> now_;    ///< scratch
  const LagRowsKernel* kernel_ = &lag_rows_kernel();
  std::vector<Level> levels_;
};

}  // namespace carom
