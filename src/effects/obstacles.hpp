#pragma once
#include <carom/box.hpp>
#include <carom/effects.hpp>
#include <cstdint>
#include <vector>
#include "core/vec2.hpp"
namespace carom {
template <class Real>
class Obstacles {
 public:
  struct Meeting {
    Real time = infinity<Real>;
    std::int32_t obstacle = -1;
  };
  Obstacles(const Box&, const std::vector<Obstacle>&) {}
  bool empty() const { return true; }
  Meeting next(const Vec2<Real>&, const Vec2<Real>&, const Vec2<Real>&, Real, Real, Real) const { return {}; }
  Vec2<Real> from_nearest_point(std::int32_t, const Vec2<Real>& r) const { return r; }
};
}  // namespace carom
