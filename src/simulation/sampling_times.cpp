#include "simulation/sampling_times.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom::detail {

namespace {

/// a / b where that is a whole number to rounding: both were decimal fractions once, each is off by half an ulp at most, and so
/// is the quotient.
std::optional<double> whole_ratio(double a, double b) {
  const double ratio = a / b;
  const double nearest = std::nearbyint(ratio);
  if (std::abs(ratio - nearest) <= 2.0 * std::numeric_limits<double>::epsilon() * ratio) return nearest;
  return std::nullopt;
}

constexpr double most = 9007199254740992.0;  // 2^53, from where k is no longer exact; no run gets there

}  // namespace

/// Divisions one by one are the same on every machine, which powers are not.
SamplingTimes::SamplingTimes(const SampleLog& log) : block_(log.block), offsets_(static_cast<std::size_t>(log.per_block)) {
  double time = log.block;
  for (std::size_t j = offsets_.size(); j-- > 1;) offsets_[j] = time /= log.base;
}

std::optional<SamplingTimes> SamplingTimes::of(const Run& run) {
  if (run.sample_every) return SamplingTimes(*run.sample_every);
  if (run.sample_log) return SamplingTimes(*run.sample_log);
  return std::nullopt;
}

std::uint64_t SamplingTimes::last(double time) const {
  const double blocks = whole_ratio(time, block_).value_or(std::floor(time / block_));
  const std::uint64_t n = offsets_.size();
  std::uint64_t k = static_cast<std::uint64_t>(std::min(blocks, most / static_cast<double>(n))) * n;
  for (std::uint64_t j = 1; j < n && !(Instant{time, 0.0} < at(k + 1)); ++j) ++k;
  return k;
}

std::optional<std::uint64_t> SamplingTimes::stride(double step) const {
  const std::optional<double> blocks = whole_ratio(step, block_);
  if (!blocks || *blocks < 1.0 || *blocks * static_cast<double>(offsets_.size()) >= most) return std::nullopt;
  return static_cast<std::uint64_t>(*blocks) * offsets_.size();
}

}  // namespace carom::detail
