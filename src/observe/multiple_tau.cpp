#include "observe/multiple_tau.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

/// So many numbers, which may be anything.
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

/// Of a level, and of those above that are full then.
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

/// The same of two channels, by far the most pairs of all: latest values come first, each channel by itself, so that lags lie
/// side by side.
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
    for (std::size_t k = first; k < lags_; ++k) {
      const std::optional<Blocking::Estimate> found = level.pairs.estimate(k);
      if (!found) continue;
      Row row{width * static_cast<double>(k), width, *found, std::nullopt};
      if (kind_ == Pairs::products) {
        row.integral = level.integrals.estimate(k);
        row.integral->mean *= width;
        if (row.integral->error) *row.integral->error *= width;
      }
      rows.push_back(row);
    }
  }
  return rows;
}

}  // namespace carom
