#pragma once
// When do two disks on straight paths touch, and when do they part? The one place where that equation is solved. All questions
// below are answered in a form that keeps its digits where the textbook root (-b - sqrt(b^2 - v^2 c)) / v^2 loses them: at small
// gaps, where -b and the square root cancel, and at grazing, where b^2 and v^2 c do.
// Source: Alder & Wainwright 1959 for the equation; docs/numerics.md derives the bounds.

#include "core/vec2.hpp"

#include <cmath>

namespace carom {

/// First time t >= 0 at which disks at separation r + v t are in contact (|r + v t| = sigma) while they approach.
/// Zero where they touch or overlap already and approach; infinity where they never touch. Touching exactly in passing
/// (grazing) counts as contact; touching and receding, or at relative rest, does not.
///
/// r: separation (length), v: relative velocity, sigma > 0: contact distance. All finite.
/// Error: with u = epsilon/2 and h = |r| + sigma, the distance at the time returned differs from sigma by at most
/// 16 u h for disks that are apart, and a hit can be taken for a miss (or a miss for a hit) only where the distance of
/// closest approach differs from sigma by less than 4 u h. No overflow or underflow of squares is assumed.
template <class Real>
[[nodiscard]] Real contact_time(const Vec2<Real>& r, const Vec2<Real>& v, Real sigma) {
  using std::sqrt;
  const Real b = r.dot(v);
  if (!(b < 0)) return infinity<Real>;  // receding, or at relative rest

  const Real s = cross<Real>(r, v);  // |s| / |v| is the distance of closest approach
  const Real d = sigma * sigma * v.squaredNorm() - s * s;
  if (d < 0) return infinity<Real>;  // they pass each other

  const Real distance = sqrt(r.squaredNorm());
  const Real c = (distance - sigma) * (distance + sigma);
  if (c <= 0) return 0;  // touching or overlapping, and approaching
  return c / (sqrt(d) - b);
}

/// Returns the contact time for a contact distance that grows as sigma + expansion t: the first t >= 0 at which |r + v t| = sigma
/// + expansion t while |r + v t|^2 - (sigma + expansion t)^2 decreases. Returns zero where the disks touch or overlap already and
/// the gap shrinks. Where the gap opens but expansion closes it again (expansion > |v|), returns the time at which it has closed.
/// Touching disks whose gap opens never meet again unless expansion > |v|. With expansion 0 the result has the bits of the
/// function above.
///
/// expansion >= 0: length/time. All arguments finite. Error: with h = |r| + sigma + (|v| + expansion) t, the distance at the
/// returned time t differs from sigma + expansion t by at most 16 u k h, where k = |v| / sqrt(v^2 - expansion^2) for expansion <
/// |v| and 1 otherwise: disks that grow nearly as fast as they approach stay close to contact for long. For expansion < |v| a hit
/// can be taken for a miss, or a miss for a hit, only where the smallest gap is below 8 u k h at that time; for expansion > |v|
/// the disks always meet.
template <class Real>
[[nodiscard]] Real contact_time(const Vec2<Real>& r, const Vec2<Real>& v, Real sigma, Real expansion) {
  using std::sqrt;
  if (expansion == 0) return contact_time<Real>(r, v, sigma);
  const Real b = r.dot(v) - sigma * expansion;  // half the rate at which |.|^2 - (.)^2 changes
  const Real a = v.squaredNorm() - expansion * expansion;
  if (!(b < 0) && !(a < 0)) return infinity<Real>;  // the gap never shrinks

  const auto beyond_contact = [&r, sigma] {
    const Real distance = sqrt(r.squaredNorm());
    return (distance - sigma) * (distance + sigma);
  };
  if (a < 0) {  // expansion wins: they are sure to meet
    const Real c = beyond_contact();
    if (b < 0 && c <= 0) return 0;
    const Real d = b * b - a * c;  // of one sign, but for an overlap by rounding
    const Real root = d > 0 ? sqrt(d) : Real(0);
    return b < 0 ? c / (root - b) : (b + root) / -a;
  }

  const Vec2<Real> w = v - (expansion / sigma) * r;  // relative to the widening that sigma takes part in: r x w = r x v
  const Real s = cross<Real>(r, v);
  const Real d = sigma * sigma * w.squaredNorm() - s * s;  // b^2 - a c, whose terms cancel here
  if (d < 0) return infinity<Real>;                        // they pass each other
  const Real c = beyond_contact();
  if (c <= 0) return 0;  // touching or overlapping, and approaching
  return c / (sqrt(d) - b);
}

/// First time t >= 0 at which disks inside |r| < sigma leave: |r + v t| = sigma while they recede. Zero where they are at sigma
/// or outside and recede; infinity at relative rest.
///
/// Error: with h = |r| + sigma, |r + v t| at the time returned differs from sigma by at most 16 u h for disks that are inside.
template <class Real>
[[nodiscard]] Real escape_time(const Vec2<Real>& r, const Vec2<Real>& v, Real sigma) {
  using std::sqrt;
  const Real square = v.squaredNorm();
  if (!(square > 0)) return infinity<Real>;

  const Real b = r.dot(v);
  const Real s = cross<Real>(r, v);
  const Real d = sigma * sigma * square - s * s;
  const Real root = d > 0 ? sqrt(d) : Real(0);  // inside, only rounding makes it negative
  if (!(b > 0)) return (root - b) / square;

  const Real distance = sqrt(r.squaredNorm());
  const Real c = (distance - sigma) * (distance + sigma);
  return c < 0 ? -c / (root + b) : Real(0);
}

}  // namespace carom
