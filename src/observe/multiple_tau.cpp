#include "observe/multiple_tau.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

MultipleTau::MultipleTau(std::size_t channels, Pairs pairs, std::size_t lags, std::size_t levels)
    : channels_(channels), kind_(pairs), lags_(lags), most_levels_(levels) {}

void MultipleTau::add(std::span<const double> value) { add(0, value); }

double MultipleTau::pair(std::span<const double> a, const double* b) const {
  double sum = 0.0;
  if (kind_ == Pairs::products)
    for (std::size_t c = 0; c < channels_; ++c) sum += a[c] * b[c];
  else
    for (std::size_t c = 0; c < channels_; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return sum / static_cast<double>(channels_);
}

void MultipleTau::add(std::size_t l, std::span<const double> value) {
  if (l == most_levels_) return;
  if (l == levels_.size()) {
    levels_.emplace_back();
    levels_[l].ring.resize(lags_ * channels_);
    levels_[l].pairs.resize(lags_);
    if (kind_ == Pairs::products) levels_[l].integrals.resize(lags_);
  }
  Level& level = levels_[l];
  const std::size_t slot = level.count % lags_;
  std::copy(value.begin(), value.end(), level.ring.begin() + static_cast<std::ptrdiff_t>(slot * channels_));
  ++level.count;
  double integral = 0.0;
  for (std::size_t k = 0; k < std::min(lags_, level.count); ++k) {
    const double* before = level.ring.data() + (level.count - 1 - k) % lags_ * channels_;
    const double found = pair(value, before);
    level.pairs[k].add(found);
    if (kind_ != Pairs::products) continue;
    integral += (k == 0 ? 0.5 : 1.0) * found;
    level.integrals[k].add(integral);
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
      const std::optional<Blocking::Estimate> found = level.pairs[k].estimate();
      if (!found) continue;
      Row row{width * static_cast<double>(k), width, *found, std::nullopt};
      if (kind_ == Pairs::products) {
        row.integral = level.integrals[k].estimate();
        row.integral->mean *= width;
        if (row.integral->error) *row.integral->error *= width;
      }
      rows.push_back(row);
    }
  }
  return rows;
}

}  // namespace carom
