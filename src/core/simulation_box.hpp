#pragma once
// The box as an engine sees it: limits in the engine's number type, and the folding of positions into it.

#include "core/vec2.hpp"

#include <carom/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace carom {

template <class Real>
struct SimulationBox {
  Vec2<Real> lower;
  Vec2<Real> upper;
  Vec2<Real> length;
  bool periodic[2];

  explicit SimulationBox(const Box& box)
      : lower(box.lower.cast<Real>()),
        upper(box.upper.cast<Real>()),
        length(upper - lower),
        periodic{box.periodic(0), box.periodic(1)} {}

  /// Folds `position` into [lower, upper) along periodic axes; returns by how many box lengths it was moved, so that
  /// position + returned * length is what it was (to one rounding). Beyond 2^53 box lengths no digit of the position is
  /// left: it becomes the lower edge.
  [[nodiscard]] Winding wrap(Vec2<Real>& position) const {
    using std::floor;
    Winding winding = Winding::Zero();
    for (int a = 0; a < 2; ++a) {
      if (!periodic[a] || inside(position, a)) continue;
      const Real limit = Real(9007199254740992.0);  // 2^53
      const Real n = std::clamp<Real>(floor((position[a] - lower[a]) / length[a]), -limit, limit);
      position[a] -= n * length[a];
      winding[a] = static_cast<std::int64_t>(n);
      if (position[a] < lower[a]) position[a] += length[a], --winding[a];
      if (position[a] >= upper[a]) position[a] -= length[a], ++winding[a];
      if (!inside(position, a)) position[a] = lower[a];  // an ulp short of an edge: both edges are the same place
    }
    return winding;
  }

  /// Returns whether no other image of a pair at separation r is nearer.
  [[nodiscard]] bool nearest(const Vec2<Real>& r) const {
    using std::abs;
    for (int a = 0; a < 2; ++a)
      if (periodic[a] && 2 * abs(r[a]) > length[a]) return false;
    return true;
  }

  /// Which axes are periodic is not among it: walls move, boundaries stay what they are.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(lower[0], lower[1], upper[0], upper[1], length[0], length[1]);
  }

 private:
  [[nodiscard]] bool inside(const Vec2<Real>& position, int a) const { return position[a] >= lower[a] && position[a] < upper[a]; }
};

}  // namespace carom
