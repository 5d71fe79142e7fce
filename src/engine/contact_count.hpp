#pragma once
// Counts of collisions that are hard on the arithmetic, for the "numerics" of a run's summary.

#include "core/real.hpp"
#include "core/vec2.hpp"

#include <carom/state.hpp>

#include <algorithm>

namespace carom {

/// A disk that reaches beyond a wall by at most this part of its radius, or into an obstacle by this part of their contact
/// distance, may have begun there: the check of a scene takes half of it or less for the rounding of decimal input.
inline constexpr double touches_a_wall = 4e-9;

namespace detail {

template <class Real>
[[gnu::noinline, gnu::cold]] void count_near_miss(Real rr, Real ss, Real rv, bool grazes, Numerics& numerics) {
  const double overlap = static_cast<double>((ss - rr) / (2 * ss));
  if (overlap < -0.001) return;  // the edge of a well
  numerics.overlapping += overlap > 16.0 * static_cast<double>(epsilon<Real>);
  numerics.deepest_overlap = std::max(numerics.deepest_overlap, overlap);
  numerics.grazing += grazes;
  numerics.already_receding += rv >= 0;
}

}  // namespace detail

/// Counts the contact of disks at separation r with relative velocity v, whose contact distance is sigma and grows at the speed
/// `expansion`.
template <class Real>
void count_contact(const Vec2<Real>& r, const Vec2<Real>& v, Real sigma, Real expansion, Numerics& numerics) {
  const Real rr = r.squaredNorm(), ss = sigma * sigma, rv = r.dot(v) - sigma * expansion;
  // At contact the discriminant sigma^2 v^2 - (r x v)^2 is (r . v)^2; its terms are of the size r^2 v^2 and rounded by 8 u of
  // that.
  const bool grazes = rv * rv <= 4 * epsilon<Real> * (rr * v.squaredNorm());
  if (ss - rr > 32 * epsilon<Real> * ss || rv >= 0 || grazes) [[unlikely]]
    detail::count_near_miss(rr, ss, rv, grazes, numerics);
}

/// Counts collisions at the same instant as the one before.
class LastInstant {
 public:
  template <class Real>
  void count(Real now, Numerics& numerics) {
    const double time = static_cast<double>(now);
    if (time == time_) [[unlikely]]
      ++numerics.simultaneous;
    time_ = time;
  }
  /// Forgets the last collision, since the zero of the clock has moved.
  void rebase() { time_ = -1.0; }

 private:
  double time_ = -1.0;  ///< since the epoch
};

}  // namespace carom
