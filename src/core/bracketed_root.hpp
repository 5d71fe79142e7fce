#pragma once
// Root of a function of one variable between two points at which it has opposite signs, by Newton steps inside a shrinking
// bracket.

#include "core/real.hpp"

#include <cmath>

namespace carom {

template <class Real>
struct ValueAndSlope {
  Real value;
  Real slope;
};

/// Returns a zero of `function` between the places `positive`, where its value is positive, and `other`, where it is not, in
/// either order. `function(t)` returns a ValueAndSlope<Real>.
///
/// Ends when no number is left between two places of opposite sign, or when a Newton step no longer changes t: to the last bits
/// that the function's own rounding leaves. A step that leaves the bracket, or is not half the one before the last, is replaced
/// by bisection, so the cost is bounded: some ten evaluations in double precision where the slope is not small, and two per bit
/// of the bracket at worst.
template <class Real, class Function>
[[nodiscard]] Real bracketed_root(const Function& function, Real positive, Real other) {
  using std::abs;
  Real t = positive + (other - positive) / 2;
  Real step = abs(other - positive);
  Real step_before = step;
  while (t != positive && t != other) {
    const ValueAndSlope<Real> at = function(t);
    (at.value > 0 ? positive : other) = t;
    const Real newton = at.value / at.slope;
    Real next = t - newton;
    if (next == t) return t;
    const bool inside = positive < other ? next > positive && next < other : next > other && next < positive;
    if (!inside || !(2 * abs(newton) <= step_before)) next = positive + (other - positive) / 2;
    step_before = step;
    step = abs(next - t);
    t = next;
  }
  return t;
}

}  // namespace carom
