#include "observe/multiple_tau.hpp"

#include "observe/blocking.hpp"

#include <fmt/format.h>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

/// Returns memory for so many numbers, whose values are undefined.
std::span<double> scratch(std::vector<double>& memory, std::size_t numbers) {
  if (memory.size() < numbers) memory.resize(numbers);
  return std::span(memory).first(numbers);
}

/// Sums of each line of `found` up to every lag, with half of its first.
void integrate(std::span<const double> found, std::size_t lags, double* integrals) {
  for (; !found.empty(); found = found.subspan(lags), integrals += lags) {
    double sum = -0.5 * found[0];
    for (std::size_t k = 0; k < lags; ++k) integrals[k] = sum += found[k];
  }
}

using Means = std::vector<std::optional<Blocking::Estimate>>;

/// Correlation of (x(t) - x(0))^2 over k steps with the same 1, 2, ... steps later, x Gaussian with <(x(t) - x(0))^2> in
/// proportion to t^power (Wick's theorem): the two windows share what x did where they overlap.
std::vector<double> correlation_of_squares(std::size_t k, double power) {
  std::vector<double> correlation;
  for (std::size_t j = 1; j < 2 * k; ++j) {
    const double u = static_cast<double>(j) / static_cast<double>(k);
    const double shared = 0.5 * (std::pow(1.0 + u, power) + std::pow(std::abs(1.0 - u), power)) - std::pow(u, power);
    correlation.push_back(shared * shared);
  }
  return correlation;
}

/// Returns the correlation of row k of squares with itself, where windows overlap. The squares are taken as those of diffusion,
/// unless they grow more slowly by more than a standard error, as between walls or in a crystal. Ballistic motion lasts less than
/// the lag, which blocks detect.
std::vector<double> correlation_of_row(const BlockedRows& squares, const Means& means, std::size_t k) {
  std::vector<double> of_diffusion = correlation_of_squares(k, 1.0);
  const Blocking::Estimate diffusing = *squares.estimate(k, of_diffusion);
  const std::size_t half = k / 2;
  if (half == 0 || !diffusing.error || !(means[half]->mean > 0.0)) return of_diffusion;
  const double span = std::log(static_cast<double>(k) / static_cast<double>(half));
  const double power = std::log(means[k]->mean / means[half]->mean) / span, error = *diffusing.error / means[k]->mean / span;
  if (!(power < 1.0 - error)) return of_diffusion;
  return correlation_of_squares(k, std::max(0.0, power));
}

/// Correlation of x at 0, 1, 2, ... steps, as far as it stands out of its errors.
std::vector<double> significant(const Means& products) {
  std::vector<double> correlation;
  for (const auto& found : products) {
    if (!found || !found->error || !(std::abs(found->mean) > 3.0 * *found->error)) break;
    correlation.push_back(found->mean / products.front()->mean);
  }
  return correlation;
}

/// Correlation of x(t) sum_i a_i x(t - i) with the same 1, 2, ... steps later, x Gaussian with the correlation `of_x` (Wick's
/// theorem).
std::vector<double> correlation_of_products(const std::vector<double>& a, const std::vector<double>& of_x) {
  const auto c = [&](std::ptrdiff_t m) {
    const auto apart = static_cast<std::size_t>(std::abs(m));
    return apart < of_x.size() ? of_x[apart] : 0.0;
  };
  std::vector<double> correlation;
  for (std::ptrdiff_t m = 0; m < static_cast<std::ptrdiff_t>(a.size() + of_x.size()); ++m) {
    double both = 0.0, later = 0.0, earlier = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const auto at = static_cast<std::ptrdiff_t>(i);
      later += a[i] * c(m - at);
      earlier += a[i] * c(m + at);
      for (std::size_t j = 0; j < a.size(); ++j) both += a[i] * a[j] * c(m + at - static_cast<std::ptrdiff_t>(j));
    }
    correlation.push_back(c(m) * both + later * earlier);
  }
  const double variance = correlation.front();
  if (!(variance > 0.0)) return {};
  correlation.erase(correlation.begin());
  for (double& one : correlation) one /= variance;
  return correlation;
}

}  // namespace

MultipleTau::MultipleTau(std::size_t channels, Pairs pairs, std::size_t lags, std::size_t levels)
    : channels_(channels), kind_(pairs), lags_(lags), most_levels_(levels) {}

void MultipleTau::add(std::span<const double> value) {
  if (channels_ == 0) return;
  if (levels_.empty()) add_level();
  std::vector<double>& coming = levels_.front().coming;
  coming.insert(coming.end(), value.begin(), value.end());
  if (coming.size() == together() * channels_) look_at_coming(0);
}

void MultipleTau::add_level() {
  Level& level = levels_.emplace_back();
  level.earlier.resize(lags_ * channels_);
  level.waiting.resize(channels_);
  level.pairs = BlockedRows(lags_);
  level.integrals = BlockedRows(lags_);
}

/// Processes the new values of a level, and of those above that are full then.
void MultipleTau::look_at_coming(std::size_t l) {
  if (l + 1 == levels_.size() && l + 1 < most_levels_) add_level();
  Level& level = levels_[l];
  const std::size_t count = level.coming.size() / channels_;
  const std::size_t samples = count * lags_;
  const std::span<double> found = scratch(found_, samples);
  channels_ == 2 ? find_pairs_of_two(level, count) : find_pairs(level, count);
  if (kind_ == Pairs::products) {
    const std::span<double> integrals = scratch(integrals_, samples);
    integrate(found, lags_, integrals.data());
    level.integrals.add(integrals);
  }
  level.pairs.add(found);
  if (l + 1 < levels_.size()) join(level, levels_[l + 1].coming);
  level.coming.clear();
  if (l + 1 < levels_.size() && levels_[l + 1].coming.size() >= together() * channels_) look_at_coming(l + 1);
}

/// Pairs of each value with itself and those before it, which are kept in a ring.
void MultipleTau::find_pairs(Level& level, std::size_t count) {
  for (std::size_t n = 0; n < count; ++n) {
    const double* value = level.coming.data() + n * channels_;
    std::size_t slot = level.count++ % lags_;
    std::copy_n(value, channels_, level.earlier.begin() + static_cast<std::ptrdiff_t>(slot * channels_));
    const Eigen::Map<const Eigen::VectorXd> x(value, static_cast<Eigen::Index>(channels_));
    for (std::size_t k = 0; k < lags_; ++k) {
      const Eigen::Map<const Eigen::VectorXd> y(level.earlier.data() + slot * channels_, x.size());
      found_[n * lags_ + k] = (kind_ == Pairs::products ? x.dot(y) : (x - y).squaredNorm()) / static_cast<double>(channels_);
      slot = (slot > 0 ? slot : lags_) - 1;
    }
  }
}

/// Finds the pairs of two channels, by far the most frequent case: latest values come first, each channel by itself, so that lags
/// are adjacent in memory.
void MultipleTau::find_pairs_of_two(Level& level, std::size_t count) {
  const std::size_t length = count + lags_;
  double* latest_first = scratch(latest_first_, 2 * length).data();
  for (std::size_t c = 0; c < 2; ++c) {
    double* x = latest_first + c * length;
    double* earlier = level.earlier.data() + c * lags_;
    for (std::size_t n = 0; n < count; ++n) x[count - 1 - n] = level.coming[2 * n + c];
    std::copy_n(earlier, lags_, x + count);
    std::copy_n(x, lags_, earlier);
  }
  const auto find = kind_ == Pairs::products ? kernel_->products : kernel_->squares;
  find(latest_first, latest_first + length, lags_, count, found_.data());
}

/// Adds means of two and two values, or every second, to those that come on the next level.
void MultipleTau::join(Level& level, std::vector<double>& next) {
  for (const double* value = level.coming.data(); value != level.coming.data() + level.coming.size(); value += channels_) {
    const bool second = level.has_waiting;
    level.has_waiting = !second;
    if (kind_ == Pairs::products && second) {
      for (std::size_t c = 0; c < channels_; ++c) next.push_back(0.5 * (level.waiting[c] + value[c]));
    } else if (kind_ == Pairs::products) {
      std::copy_n(value, channels_, level.waiting.begin());
    } else if (!second) {
      next.insert(next.end(), value, value + channels_);
    }
  }
}

std::vector<MultipleTau::Row> MultipleTau::rows() {
  for (std::size_t l = 0; l < levels_.size(); ++l)
    if (!levels_[l].coming.empty()) look_at_coming(l);
  std::vector<Row> rows;
  for (std::size_t l = 0; l < levels_.size(); ++l) {
    const Level& level = levels_[l];
    const double width = std::ldexp(1.0, static_cast<int>(l));
    const std::size_t first = l > 0 ? lags_ / 2 : kind_ == Pairs::products ? 0 : 1;
    Means means;
    for (std::size_t k = 0; k < lags_; ++k) means.push_back(level.pairs.estimate(k));
    const std::vector<double> of_x = kind_ == Pairs::products ? significant(means) : std::vector<double>();
    for (std::size_t k = first; k < lags_ && means[k]; ++k) {
      if (kind_ == Pairs::squared_differences) {
        const std::vector<double> known = correlation_of_row(level.pairs, means, k);
        rows.push_back({.lag = width * static_cast<double>(k),
                        .width = width,
                        .pairs = *level.pairs.estimate(k, known),
                        .halves = level.pairs.halves(k, known)});
        continue;
      }
      std::vector<double> weights(k + 1);
      weights[k] = 1.0;
      const std::vector<double> known = correlation_of_products(weights, of_x);
      Row row{.lag = width * static_cast<double>(k),
              .width = width,
              .pairs = *level.pairs.estimate(k, known),
              .halves = level.pairs.halves(k, known)};
      weights.assign(k + 1, 1.0);
      weights[0] = 0.5;
      const std::vector<double> known_of_sums = correlation_of_products(weights, of_x);
      row.integral = level.integrals.estimate(k, known_of_sums);
      row.integral_halves = in_proportion(level.integrals.halves(k, known_of_sums), width);
      row.integral->mean *= width;
      if (row.integral->error) *row.integral->error *= width;
      rows.push_back(row);
    }
  }
  return rows;
}

void MultipleTau::Row::fill(Scalar& scalar, double step, double factor) const {
  const Blocking::Estimate& found = estimate();
  scalar.value = factor * found.mean;
  scalar.error = factor * *found.error;
  scalar.halves = in_proportion(if_known(integral ? integral_halves : halves), factor);
  if (found.statistical_inefficiency) scalar.integrated_correlation_time = 0.5 * step * width * *found.statistical_inefficiency;
  if (found.lower_bound) scalar.note += fmt::format("; {}: the error is a lower bound", too_short);
}

std::string MultipleTau::note_on_errors(const std::vector<Row>& rows) {
  const auto is_bound = [](const Row& row) { return row.pairs.lower_bound || (row.integral && row.integral->lower_bound); };
  const auto is_unknown = [](const Row& row) { return !row.pairs.error; };
  std::string note;
  if (std::ranges::any_of(rows, is_unknown)) note = "where a lag has no error the run holds too few independent windows of it";
  if (std::ranges::any_of(rows, is_bound))
    note += std::string(note.empty() ? "" : "; ") + "the run is too short for some correlations: errors there are lower bounds";
  return note;
}

}  // namespace carom
