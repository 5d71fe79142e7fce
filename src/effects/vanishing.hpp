#pragma once
// Closing speeds that collisions have brought near to zero. Where others move faster, only collisions without end at one instant
// get there, each of which takes its share: it is the limit of a collapse.

#include "core/real.hpp"

#include <algorithm>
#include <limits>

namespace carom {

/// Returns the smallest number that decides how two disks meet that are `distance` apart: the closing speed, or its product with
/// the distance.
template <class Real>
[[nodiscard]] Real smallness(Real closing, Real distance) {
  return std::min<Real>(closing, closing * distance);
}

/// Returns whether speeds times lengths are so small that their squares vanish or lose digits: below 1e-150, in single precision
/// 1e-15.
template <class Real>
[[nodiscard]] bool squares_vanish(Real product) {
  return product < (std::numeric_limits<Real>::digits > 24 ? Real(1e-150) : Real(1e-15));
}

/// Returns whether they are so small that they lose digits themselves: below 1e-292, in single precision 1e-31.
template <class Real>
[[nodiscard]] bool vanishes(Real product) {
  return product < (std::numeric_limits<Real>::min)() / epsilon<Real>;
}

}  // namespace carom
