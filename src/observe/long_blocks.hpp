#pragma once
// The error of a mean over a few long blocks, from one of which correlations may reach into the next. They are taken to fall
// exponentially in time, as the slowest motion does.

#include <cstddef>

namespace carom {

/// The correlation of a mean over a block with that over the next, as many series of `count` blocks show it together. Series
/// take part alike, whatever their scatter.
class NextBlockCorrelation {
 public:
  explicit NextBlockCorrelation(std::size_t count) : count_(count) {}

  /// Adds a series by its mean, and the sums of its squared deviations from it and of the products of each with the next, or both
  /// sums in one proportion. A series without scatter but rounding, or with unknown numbers, takes no part.
  void add(double mean, double squares, double products);

  /// Returns the correlation, 0 without a series. To first order in 1 / count it is free of the bias that comes from deviations
  /// being those from the mean of the same blocks.
  [[nodiscard]] double value() const;

 private:
  std::size_t count_, series_ = 0;
  double sum_ = 0.0;
};

/// The correlation of a block with the next beyond which `count` blocks of a run hold too few correlation times (some six of 16
/// blocks) for the scatter to give the error.
inline constexpr double most_correlation_of_blocks = 0.8;

/// Returns the factor by which the variance of the mean of `count` blocks, two or more, exceeds what their scatter says of
/// independent ones: 1 where `correlation` is not positive. Correlations beyond most_correlation_of_blocks count as that.
[[nodiscard]] double variance_by_correlated_blocks(double correlation, std::size_t count);

}  // namespace carom
