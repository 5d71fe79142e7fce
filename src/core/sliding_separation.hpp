#pragma once
// Separations in a sheared box, where the nearest image of a disk may be beyond an edge past which images slide.

#include "core/prediction.hpp"
#include "core/vec2.hpp"

#include <cstdint>

namespace carom {

/// Separation from b to a at one time, and its rate of change.
struct Approach {
  Vec2<double> r;
  Vec2<double> v;
};

/// Returns the separation from the image of b that lies `above` boxes above it (core/flight.hpp computes that number).
template <class Line>
[[nodiscard]] Approach approach(const PredictionFrame& frame, const Line& a, const Line& b, std::int32_t above, double now) {
  const std::uint64_t displacement =
      static_cast<std::uint64_t>(std::int64_t{above}) * static_cast<std::uint64_t>(frame.sliding.displacement);
  const std::int64_t x = wrapped_difference(wrapped_difference(a.x[0], b.x[0]), static_cast<std::int64_t>(displacement));
  const std::int64_t y = wrapped_difference(a.x[1], b.x[1]);
  const Vec2<double> v((a.v[0] - b.v[0]) - above * frame.sliding.speed, a.v[1] - b.v[1]);
  return {{static_cast<double>(x) * frame.unit[0] + v[0] * now, static_cast<double>(y) * frame.unit[1] + v[1] * now}, v};
}

}  // namespace carom
