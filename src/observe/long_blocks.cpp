#include "observe/long_blocks.hpp"

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace carom {

namespace {

/// x - 1 + exp(-x): x^2 / 2 times the variance of the mean over a time x of what has variance 1 and correlation exp(-t).
double double_integral(double x) { return x + std::expm1(-x); }

/// Returns the correlation of the mean over a time x with that over the next.
double correlation_with_next(double x) {
  const double fallen = -std::expm1(-x);
  return fallen * fallen / (2.0 * double_integral(x));
}

/// Returns the time, in correlation times, that a block with this correlation to the next lasts.
double length_of_block(double correlation) {
  constexpr double shortest = 1e-2, longest = 1e4;
  if (correlation <= correlation_with_next(longest)) return longest;
  std::uintmax_t steps = 100;
  const auto excess = [&](double x) { return correlation_with_next(x) - correlation; };
  const auto [from, to] =
      boost::math::tools::toms748_solve(excess, shortest, longest, boost::math::tools::eps_tolerance<double>(40), steps);
  return 0.5 * (from + to);
}

}  // namespace

void NextBlockCorrelation::add(double mean, double squares, double products) {
  constexpr double rounding = 1e-24;  // relative, of squares
  if (!(squares > rounding * mean * mean) || !std::isfinite(squares) || !std::isfinite(products)) return;
  sum_ += products / squares;
  ++series_;
}

double NextBlockCorrelation::value() const {
  if (series_ == 0) return 0.0;
  const double n = static_cast<double>(count_);
  return (sum_ / static_cast<double>(series_) + 1.0 / n) / (1.0 - 4.0 / n);
}

double variance_by_correlated_blocks(double correlation, std::size_t count) {
  if (!(correlation > 0.0)) return 1.0;
  const double length = length_of_block(std::min(correlation, most_correlation_of_blocks)), n = static_cast<double>(count);
  // The variance of the mean over the run, in units of that over a block; and how much of the latter is left about the former.
  const double of_mean = double_integral(n * length) / (n * n * double_integral(length));
  const double about_mean = n / (n - 1.0) * (1.0 - of_mean);
  return n * of_mean / about_mean;
}

}  // namespace carom
