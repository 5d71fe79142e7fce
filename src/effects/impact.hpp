#pragma once
// What contact does to two velocities, for every collision rule. A rule (specular.hpp, reversal.hpp) says which part d of
// the relative velocity v is turned round; this file shares it out so that momentum and energy are kept to rounding with
// no bias, for any ratio of masses. With v and d of light relative to heavy and k = 2 m_light / (m_light + m_heavy) < 1,
//
//     v_heavy' = v_heavy + k d,    v_light' = v_heavy' + (v - 2 d).
//
// The relative velocity is turned round whatever the rounding of k, and k's error is that of the mass ratio alone. Shares
// 2 mu/m_i and 2 mu/m_j that are rounded one by one would heat or cool the gas by a fixed 1e-16 per collision.

#include "core/vec2.hpp"

#include <cmath>
#include <utility>

namespace carom {

/// The momentum that passed between two disks at contact, as r . dp_i: mass length^2 / time, >= 0. The virial.
template <class Real>
struct ImpactResult {
  Real virial = 0;
};

namespace detail {

/// Makes a pair recede that rounding has left approaching by less than its velocities can resolve: equal and opposite
/// impulses that change velocities by an ulp or so, and energy by less than its own rounding. Without it a grazing pair
/// could collide for ever at one instant.
template <class Real>
[[gnu::noinline, gnu::cold]] void recede(const Vec2<Real>& r, Real m_i, Vec2<Real>& v_i, Real m_j, Vec2<Real>& v_j) {
  using std::sqrt;
  const Real speed = sqrt(v_i.squaredNorm()) + sqrt(v_j.squaredNorm());
  const Vec2<Real> n = (speed / sqrt(r.squaredNorm())) * r;
  for (Real push = epsilon<Real>; r.dot(v_i - v_j) < 0; push *= 2) {
    v_i += (push * m_j / (m_i + m_j)) * n;
    v_j -= (push * m_i / (m_i + m_j)) * n;
  }
}

}  // namespace detail

/// Collides disks i and j at separation r = r_i - r_j under Rule. Requires contact (to rounding). Ensures that they do
/// not approach afterwards. A pair that rounding finds already receding exchanges nothing.
template <class Rule, class Real>
ImpactResult<Real> collide(const Vec2<Real>& r, Real m_i, Vec2<Real>& v_i, Real m_j, Vec2<Real>& v_j) {
  const Vec2<Real> v = v_i - v_j;
  const Real b = r.dot(v);
  if (!(b < 0)) return {};

  const Vec2<Real> d = Rule::turned(r, v, b);
  Real virial;
  if (m_i == m_j) {
    virial = -b * m_i;
    if (Rule::exchanges_velocities) {
      std::swap(v_i, v_j);
      return {virial};
    }
    v_i -= d;
    v_j += d;
  } else {
    const bool i_is_light = m_i < m_j;
    Vec2<Real>& light = i_is_light ? v_i : v_j;
    Vec2<Real>& heavy = i_is_light ? v_j : v_i;
    const Real k = 2 * (i_is_light ? m_i : m_j) / (m_i + m_j);
    virial = -b * k * (i_is_light ? m_j : m_i);
    const Vec2<Real> sent = i_is_light ? d : -d;  // d, light relative to heavy
    const Vec2<Real> kept = i_is_light ? Vec2<Real>(v - 2 * d) : Vec2<Real>(2 * d - v);
    heavy += k * sent;
    light = heavy + kept;
  }
  if (r.dot(v_i - v_j) < 0) detail::recede(r, m_i, v_i, m_j, v_j);
  return {virial};
}

}  // namespace carom
