#pragma once
// How hard a collision was on the arithmetic: counted at every one, for the "numerics" of a run's summary.

#include "core/real.hpp"
#include "core/vec2.hpp"

#include <carom/state.hpp>

namespace carom {

/// Disks meet at separation r with relative velocity v; their contact distance is sigma and grows at a speed. Edges of wells are
/// farther out, and no contacts.
template <class Real>
void count_contact(const Vec2<Real>& r, const Vec2<Real>& v, Real sigma, Real growth, Numerics& numerics) {
  const Real rr = r.squaredNorm(), ss = sigma * sigma, rv = r.dot(v) - sigma * growth;
  const double overlap = static_cast<double>((ss - rr) / (2 * ss));
  if (overlap < -0.001) return;
  numerics.overlapping += overlap > 16.0 * static_cast<double>(epsilon<Real>);
  if (overlap > numerics.deepest_overlap) numerics.deepest_overlap = overlap;
  // At contact the discriminant sigma^2 v^2 - (r x v)^2 is (r . v)^2; its terms are of the size r^2 v^2 and rounded by 8 u of
  // that.
  numerics.grazing += rv * rv <= 4 * epsilon<Real> * (rr * v.squaredNorm());
  numerics.receding += rv >= 0;
}

/// The same for two collisions at one instant, and which the last one was.
class LastInstant {
 public:
  template <class Real>
  void count(Real now, Numerics& numerics) {
    const double time = static_cast<double>(now);
    numerics.at_once += time == time_;
    time_ = time;
  }
  /// The clock's zero has moved.
  void rebase() { time_ = -1.0; }

 private:
  double time_ = -1.0;  ///< since the epoch
};

}  // namespace carom
