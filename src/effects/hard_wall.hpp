#pragma once
// Hard, smooth walls: the component of the velocity across the wall is reversed when the disk's edge reaches it.

#include "core/domain.hpp"

#include <carom/state.hpp>

namespace carom {

template <class Real>
struct WallContact {
  Real time = infinity<Real>;
  Wall wall = wall_left;
};

/// The next contact of a disk of the given radius, at position r at time t, with a wall. A disk that touches or
/// overlaps a wall and moves into it is in contact now. Of a corner's two walls the vertical one comes first.
template <class Real>
[[nodiscard]] WallContact<Real> next_wall_contact(const Domain<Real>& domain, const Vec2<Real>& r, const Vec2<Real>& v,
                                                  Real radius, Real t) {
  WallContact<Real> next;
  for (int a = 0; a < 2; ++a) {
    if (domain.periodic[a] || v[a] == 0) continue;
    const bool up = v[a] > 0;
    const Real gap = up ? (domain.upper[a] - radius) - r[a] : r[a] - (domain.lower[a] + radius);
    const Real time = gap > 0 ? t + gap / (up ? v[a] : -v[a]) : t;
    if (time < next.time) next = {time, static_cast<Wall>(wall_left - 2 * a - (up ? 1 : 0))};
  }
  return next;
}

/// The axis that a wall is across: 0 for left and right, 1 for bottom and top.
[[nodiscard]] constexpr int axis_of(Wall wall) { return wall >= wall_right ? 0 : 1; }

}  // namespace carom
