#pragma once
// When samples are taken: k * step, or the moments of logarithmic blocks, each without rounding.

#include "core/instant.hpp"

#include <carom/scene.hpp>
#include <carom/simulation.hpp>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace carom::detail {

class SamplingTimes {
 public:
  /// k * step
  explicit SamplingTimes(double step) : block_(step), offsets_{0.0} {}
  explicit SamplingTimes(const SampleLog& log);

  /// Returns the sampling times of a run; nothing where it has none that are known beforehand.
  [[nodiscard]] static std::optional<SamplingTimes> of(const Run& run);

  /// From one block to the next; with even steps the step.
  [[nodiscard]] double block() const { return block_; }

  [[nodiscard]] Instant at(std::uint64_t k) const {
    const std::uint64_t n = offsets_.size();
    const Instant block = Instant::product(k / n, block_);
    return k % n == 0 ? block : block.plus(offsets_[k % n]);
  }

  /// The largest k with at(k) <= time; a time that is a multiple of the block to rounding counts as one. At most about 2^53.
  /// Requires time >= 0.
  [[nodiscard]] std::uint64_t last(double time) const;

  /// The least k with at(k) >= time that the range has; one that is equal to rounding counts.
  [[nodiscard]] std::uint64_t next(const Instant& time, const SampleRange& range) const {
    std::uint64_t k = last(time.high);
    if (at(k) < time && !equal_to_rounding(at(k), time)) ++k;
    k = std::max(k, range.first);
    return k + (range.stride - k % range.stride) % range.stride;
  }

  /// The m with at(k * m) = k * step, to rounding; nothing where there is none.
  [[nodiscard]] std::optional<std::uint64_t> stride(double step) const;

 private:
  double block_;                 ///< length
  std::vector<double> offsets_;  ///< of the samples of a block from its beginning; rising, the first is 0
};

}  // namespace carom::detail
