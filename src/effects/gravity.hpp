#pragma once
// How disks move between events: uniformly accelerated, all alike. It cancels in the relative motion of two disks, and acts only
// against what stands still and against the edges of cells.

#include "core/vec2.hpp"

#include <carom/effects.hpp>

#include <optional>

namespace carom {

template <class Real>
struct Falling {
  Vec2<Real> g = Vec2<Real>::Zero();

  Falling() = default;
  explicit Falling(const std::optional<Gravity>& gravity) {
    if (gravity) g = gravity->acceleration.cast<Real>();
  }

  [[nodiscard]] bool present() const { return g[0] != 0 || g[1] != 0; }

  /// Returns the position after a time t of flight from r with velocity v.
  [[nodiscard]] Vec2<Real> position(const Vec2<Real>& r, const Vec2<Real>& v, Real t) const {
    if (!present()) return r + v * t;
    return r + t * (v + (t / 2) * g);
  }
  [[nodiscard]] Vec2<Real> velocity(const Vec2<Real>& v, Real t) const {
    if (!present()) return v;
    return v + g * t;
  }
};

}  // namespace carom
