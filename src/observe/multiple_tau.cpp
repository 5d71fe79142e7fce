#include "observe/multiple_tau.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace carom {

MultipleTau::MultipleTau(std::size_t channels, Pairs pairs, std::size_t lags, std::size_t levels)
    : channels_(channels), kind_(pairs), lags_(lags), most_levels_(levels) {}

void MultipleTau::add(std::span<const double> value) {
  new_.insert(new_.end(), value.begin(), value.end());
  if (new_.size() == together() * channels_) look_at_new();
}

/// Level by level.
void MultipleTau::look_at_new() {
  std::size_t count = channels_ > 0 ? new_.size() / channels_ : 0;
  for (std::size_t level = 0; level < most_levels_ && count > 0; ++level) count = add(level, count);
  new_.clear();
}

/// The first so many of the new values. Leaves those of the next level in their place, and returns how many.
std::size_t MultipleTau::add(std::size_t l, std::size_t count) {
  if (l == levels_.size()) {
    levels_.emplace_back();
    levels_[l].ring.resize(lags_ * channels_ * (channels_ == 2 ? 2 : 1));
    levels_[l].waiting.resize(channels_);
    levels_[l].pairs = BlockedRows(lags_);
    levels_[l].integrals = BlockedRows(lags_);
  }
  Level& level = levels_[l];
  found_.resize(count * lags_);
  integrals_.resize(kind_ == Pairs::products ? count * lags_ : 0);
  for (std::size_t n = 0; n < count; ++n) {
    const double* value = new_.data() + n * channels_;
    double* found = found_.data() + n * lags_;
    channels_ == 2 ? find_pairs_of_two(level, value, found) : find_pairs(level, value, found);
    ++level.count;
    if (kind_ != Pairs::products) continue;
    double sum = -0.5 * found[0];
    for (std::size_t k = 0; k < lags_; ++k) integrals_[n * lags_ + k] = sum += found[k];
  }
  level.pairs.add(found_);
  if (kind_ == Pairs::products) level.integrals.add(integrals_);
  return join(level, count);
}

/// Pairs of a value with itself and those before it; it is kept for those to come.
void MultipleTau::find_pairs(Level& level, const double* value, double* found) {
  std::size_t slot = level.count % lags_;
  std::copy_n(value, channels_, level.ring.begin() + static_cast<std::ptrdiff_t>(slot * channels_));
  const Eigen::Map<const Eigen::VectorXd> x(value, static_cast<Eigen::Index>(channels_));
  for (std::size_t k = 0; k < lags_; ++k) {
    const Eigen::Map<const Eigen::VectorXd> y(level.ring.data() + slot * channels_, x.size());
    found[k] = (kind_ == Pairs::products ? x.dot(y) : (x - y).squaredNorm()) / static_cast<double>(channels_);
    slot = (slot > 0 ? slot : lags_) - 1;
  }
}

/// The same of two channels, four lags at a time: by far the most pairs of all.
void MultipleTau::find_pairs_of_two(Level& level, const double* value, double* found) {
  const std::size_t slot = lags_ - 1 - level.count % lags_;  // that of the latest value, with older ones behind it
  double *x = level.ring.data() + slot, *y = x + 2 * lags_;
  x[0] = x[lags_] = value[0];
  y[0] = y[lags_] = value[1];
  (kind_ == Pairs::products ? kernel_->products : kernel_->squares)(value, x, y, lags_, found);
}

/// Means of two and two, or every second.
std::size_t MultipleTau::join(Level& level, std::size_t count) {
  std::size_t joined = 0;
  for (std::size_t n = 0; n < count; ++n) {
    const double* value = new_.data() + n * channels_;
    double* next = new_.data() + joined * channels_;
    const bool second = level.has_waiting;
    level.has_waiting = !second;
    if (!second) std::copy_n(value, channels_, level.waiting.begin());
    if (second != (kind_ == Pairs::products)) continue;
    for (std::size_t c = 0; c < channels_; ++c) next[c] = second ? 0.5 * (level.waiting[c] + value[c]) : value[c];
    ++joined;
  }
  return joined;
}

std::vector<MultipleTau::Row> MultipleTau::rows() {
  look_at_new();
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
