#pragma once
// The number of box lengths that each disk has travelled past the periodic edges: 64 bits, of which 32 are stored where no disk
// has gone further than these can count. Beyond that, after two thousand million box lengths, the rest is in a list of the few.

#include "core/large_memory.hpp"
#include "core/prefetch.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>

namespace carom {

class ImageCounts {
 public:
  explicit ImageCounts(std::size_t disks) : low_(disks) {}

  [[nodiscard]] std::int64_t of(std::int32_t i, int axis) const {
    const std::int64_t low = low_[static_cast<std::size_t>(i)][static_cast<std::size_t>(axis)];
    return far_.empty() ? low : low + beyond(i, axis);
  }

  void set(std::int32_t i, int axis, std::int64_t count) {
    std::int32_t& low = entry(i, axis);
    low = static_cast<std::int32_t>(count);
    keep(i, axis, count - low);
  }

  /// `by` is 1 or -1. Seldom called, and so kept out of the way of what is.
  [[gnu::noinline, gnu::cold]] void step(std::int32_t i, int axis, std::int32_t by) { set(i, axis, of(i, axis) + by); }

  void prefetch_count(std::int32_t i) const { prefetch_early(&low_[static_cast<std::size_t>(i)]); }

  [[nodiscard]] std::size_t bytes() const { return low_.capacity() * sizeof(low_[0]) + far_.size() * sizeof(*far_.begin()); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(low_, far_);
  }

 private:
  using Place = std::array<std::int32_t, 2>;  ///< disk and axis

  [[nodiscard]] std::int32_t& entry(std::int32_t i, int axis) {
    return low_[static_cast<std::size_t>(i)][static_cast<std::size_t>(axis)];
  }
  [[nodiscard, gnu::noinline, gnu::cold]] std::int64_t beyond(std::int32_t i, int axis) const {
    const auto found = far_.find({i, axis});
    return found == far_.end() ? 0 : found->second;
  }
  void keep(std::int32_t i, int axis, std::int64_t rest) {
    if (rest != 0)
      far_[{i, axis}] = rest;
    else if (!far_.empty())
      far_.erase({i, axis});
  }

  LargeVector<std::array<std::int32_t, 2>> low_;
  std::map<Place, std::int64_t> far_;  ///< what is beyond 32 bits, multiples of 2^32
};

}  // namespace carom
