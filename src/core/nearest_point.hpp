#pragma once
// The point of a straight line that is nearest to another point.

#include "core/vec2.hpp"

#include <algorithm>

namespace carom {

/// Returns the point of the segment between `from` and `to` nearest to `point`. The two ends may be equal.
template <class Real>
[[nodiscard]] Vec2<Real> nearest_on_segment(const Vec2<Real>& from, const Vec2<Real>& to, const Vec2<Real>& point) {
  const Vec2<Real> along = to - from;
  const Real square = along.squaredNorm();
  if (!(square > 0)) return from;
  const Real share = std::clamp<Real>(along.dot(point - from) / square, Real(0), Real(1));
  return share == 1 ? to : Vec2<Real>(from + share * along);
}

}  // namespace carom
