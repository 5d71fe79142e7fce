#include "observe/multiple_tau.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace carom {

MultipleTau::MultipleTau(std::size_t channels, Pairs pairs, std::size_t lags, std::size_t levels)
    : channels_(channels), kind_(pairs), lags_(lags), most_levels_(levels) {}

void MultipleTau::add(std::span<const double> value) { add(0, value); }

/// Pairs of a value with itself and those before it; it is kept for those to come.
void MultipleTau::find_pairs(Level& level, std::span<const double> value) {
  std::size_t slot = level.count % lags_;
  std::copy(value.begin(), value.end(), level.ring.begin() + static_cast<std::ptrdiff_t>(slot * channels_));
  const Eigen::Map<const Eigen::VectorXd> x(value.data(), static_cast<Eigen::Index>(channels_));
  for (double& found : found_) {
    const Eigen::Map<const Eigen::VectorXd> y(level.ring.data() + slot * channels_, x.size());
    found = (kind_ == Pairs::products ? x.dot(y) : (x - y).squaredNorm()) / static_cast<double>(channels_);
    slot = (slot > 0 ? slot : lags_) - 1;
  }
}

/// The same of two channels, four lags at a time: by far the most pairs of all.
void MultipleTau::find_pairs_of_two(Level& level, std::span<const double> value) {
  const std::size_t slot = lags_ - 1 - level.count % lags_;  // that of the latest value, with older ones behind it
  double *x = level.ring.data() + slot, *y = x + 2 * lags_;
  x[0] = x[lags_] = value[0];
  y[0] = y[lags_] = value[1];
  (kind_ == Pairs::products ? kernel_->products : kernel_->squares)(value.data(), x, y, found_.size(), found_.data());
}

void MultipleTau::add(std::size_t l, std::span<const double> value) {
  if (l == most_levels_) return;
  if (l == levels_.size()) {
    levels_.emplace_back();
    levels_[l].ring.resize(lags_ * channels_ * (channels_ == 2 ? 2 : 1));
    levels_[l].waiting.resize(channels_);
    levels_[l].pairs = BlockedRows(lags_);
    levels_[l].integrals = BlockedRows(lags_);
  }
  Level& level = levels_[l];
  found_.resize(std::min(lags_, level.count + 1));
  channels_ == 2 ? find_pairs_of_two(level, value) : find_pairs(level, value);
  ++level.count;
  level.pairs.add(found_);
  if (kind_ == Pairs::products) {
    found_.front() *= 0.5;
    std::partial_sum(found_.begin(), found_.end(), found_.begin());
    level.integrals.add(found_);
  }
  if (!level.has_waiting) {
    level.has_waiting = true;
    std::ranges::copy(value, level.waiting.begin());
    if (kind_ == Pairs::squared_differences) add(l + 1, value);
    return;
  }
  level.has_waiting = false;
  if (kind_ != Pairs::products) return;
  mean_.resize(channels_);
  for (std::size_t c = 0; c < channels_; ++c) mean_[c] = 0.5 * (level.waiting[c] + value[c]);
  add(l + 1, mean_);
}

std::vector<MultipleTau::Row> MultipleTau::rows() const {
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
