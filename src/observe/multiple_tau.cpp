#include "observe/multiple_tau.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace carom {

MultipleTau::MultipleTau(std::size_t channels, Pairs pairs, std::size_t lags, std::size_t levels)
    : channels_(channels), kind_(pairs), lags_(lags), most_levels_(levels) {}

void MultipleTau::add(std::span<const double> value) { add(0, value); }

double MultipleTau::pair(std::span<const double> a, const double* b) const {
  if (channels_ == 2) {  // by far the most pairs; the same bits as below
    if (kind_ == Pairs::products) return 0.5 * (a[0] * b[0] + a[1] * b[1]);
    const double x = a[0] - b[0], y = a[1] - b[1];
    return 0.5 * (x * x + y * y);
  }
  const Eigen::Map<const Eigen::VectorXd> x(a.data(), static_cast<Eigen::Index>(channels_)), y(b, x.size());
  return (kind_ == Pairs::products ? x.dot(y) : (x - y).squaredNorm()) / static_cast<double>(channels_);
}

void MultipleTau::add(std::size_t l, std::span<const double> value) {
  if (l == most_levels_) return;
  if (l == levels_.size()) {
    levels_.emplace_back();
    levels_[l].ring.resize(lags_ * channels_);
    levels_[l].pairs = BlockedRows(lags_);
    levels_[l].integrals = BlockedRows(lags_);
  }
  Level& level = levels_[l];
  std::size_t slot = level.count % lags_;
  std::copy(value.begin(), value.end(), level.ring.begin() + static_cast<std::ptrdiff_t>(slot * channels_));
  ++level.count;
  const std::size_t lags = std::min(lags_, level.count);
  found_.resize(lags);
  for (double& found : found_) {
    found = pair(value, level.ring.data() + slot * channels_);
    slot = (slot > 0 ? slot : lags_) - 1;
  }
  level.pairs.add(found_);
  if (kind_ == Pairs::products) {
    found_.front() *= 0.5;
    std::partial_sum(found_.begin(), found_.end(), found_.begin());
    level.integrals.add(found_);
  }
  if (!level.has_waiting) {
    level.has_waiting = true;
    level.waiting.assign(value.begin(), value.end());
    if (kind_ == Pairs::squared_differences) add(l + 1, value);
    return;
  }
  level.has_waiting = false;
  if (kind_ != Pairs::products) return;
  std::vector<double> mean(channels_);
  for (std::size_t c = 0; c < channels_; ++c) mean[c] = 0.5 * (level.waiting[c] + value[c]);
  add(l + 1, mean);
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
