#pragma once
// What contact does to two velocities, for every collision rule. A rule (specular.hpp, reversal.hpp) says which part d of
// the relative velocity v is reversed; this file shares it out so that momentum and energy are kept to rounding with
// no bias, for any ratio of masses. With v and d of light relative to heavy and k = 2 m_light / (m_light + m_heavy) < 1,
//
//     v_heavy' = v_heavy + k d,    v_light' = v_heavy' + (v - 2 d).
//
// The relative velocity is reversed whatever the rounding of k, and k's error is that of the mass ratio alone. Shares
// 2 mu/m_i and 2 mu/m_j that are rounded one by one would heat or cool the gas by a fixed 1e-16 per collision.

#include "core/vec2.hpp"
#include "effects/vanishing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace carom {

template <class Real>
struct ImpactResult {
  Real virial = 0;  ///< the momentum that passed between the disks, as r . dp_i: mass length^2 / time
  Real energy = 0;  ///< that the two disks gained: negative where the collision is inelastic
};

/// The result of a collision of disks that may be inelastic, and grow.
template <class Real>
struct InelasticResult : ImpactResult<Real> {
  Real lost = 0;                    ///< what the collision took; energy + lost is the work of surfaces that grow
  Real smallness = infinity<Real>;  ///< of the speed of which it took a share (effects/vanishing.hpp); infinite where of none
};

/// The differences of a collision from that of elastic disks of constant size.
template <class Real>
struct Inelasticity {
  Real reflected_fraction = 1;  ///< (1 + e) / 2 for restitution e: the share of d that is reversed
  Real expansion = 0;           ///< of the contact distance: length / time, >= 0
};

namespace detail {

/// Makes a pair recede that rounding has left approaching by less than its velocities can resolve: equal and opposite
/// impulses that change velocities by an ulp or so, and energy by less than its own rounding. Without it a grazing pair
/// could collide for ever at one instant.
template <class Real>
[[gnu::noinline, gnu::cold]] void recede(const Vec2<Real>& r, Real m_i, Vec2<Real>& v_i, Real m_j, Vec2<Real>& v_j,
                                         Real least = 0) {
  using std::sqrt;
  const Real distance = sqrt(r.squaredNorm());
  // Squares of low speeds vanish: then the largest component will do, and where all is at rest the speed with which to part.
  Real speed =
      std::max<Real>({sqrt(v_i.squaredNorm()) + sqrt(v_j.squaredNorm()), v_i.cwiseAbs().maxCoeff(), v_j.cwiseAbs().maxCoeff()});
  if (!(speed > 0)) speed = least / distance;
  const Vec2<Real> n = (speed / distance) * r;
  for (Real push = epsilon<Real>; r.dot(v_i - v_j) < least; push *= 2) {
    if (push > 4) {  // more than any that is needed: n itself has vanished
      v_j = v_i;
      return;
    }
    v_i += (push * m_j / (m_i + m_j)) * n;
    v_j -= (push * m_i / (m_i + m_j)) * n;
  }
}

/// Gives the partners of a pair of relative velocity v their shares of -2 d.
template <class Real>
void apply_by_mass(const Vec2<Real>& v, const Vec2<Real>& d, Real m_i, Vec2<Real>& v_i, Real m_j, Vec2<Real>& v_j) {
  if (m_i == m_j) {
    v_i -= d;
    v_j += d;
    return;
  }
  const bool i_is_light = m_i < m_j;
  Vec2<Real>& light = i_is_light ? v_i : v_j;
  Vec2<Real>& heavy = i_is_light ? v_j : v_i;
  const Real k = 2 * (i_is_light ? m_i : m_j) / (m_i + m_j);
  const Vec2<Real> sent = i_is_light ? d : -d;  // d, light relative to heavy
  const Vec2<Real> kept = i_is_light ? Vec2<Real>(v - 2 * d) : Vec2<Real>(2 * d - v);
  heavy += k * sent;
  light = heavy + kept;
}

/// 2 mu = 2 m_i m_j / (m_i + m_j) times x; the ratio first, since the product might overflow.
template <class Real>
Real twice_reduced(Real x, Real m_i, Real m_j) {
  if (m_i == m_j) return x * m_i;
  const Real k = 2 * (m_i < m_j ? m_i : m_j) / (m_i + m_j);
  return x * k * (m_i < m_j ? m_j : m_i);
}

}  // namespace detail

/// Collides disks i and j at separation r = r_i - r_j under Rule. Requires contact (to rounding). Ensures that they do
/// not approach afterwards. A pair that rounding finds already receding exchanges nothing.
template <class Rule, class Real>
ImpactResult<Real> collide(const Vec2<Real>& r, Real m_i, Vec2<Real>& v_i, Real m_j, Vec2<Real>& v_j) {
  const Vec2<Real> v = v_i - v_j;
  const Real b = r.dot(v);
  if (!(b < 0)) return {};

  const ImpactResult<Real> result{detail::twice_reduced(-b, m_i, m_j), 0};
  if (Rule::exchanges_velocities && m_i == m_j) {
    std::swap(v_i, v_j);
    return result;
  }
  detail::apply_by_mass<Real>(v, Rule::reversed_part(r, v, b), m_i, v_i, m_j, v_j);
  if (r.dot(v_i - v_j) < 0) detail::recede(r, m_i, v_i, m_j, v_j);
  return result;
}

/// Collides disks that lose energy or grow: the rule acts on the velocity v - a n with which their surfaces approach, a the
/// expansion of the contact distance. With reflected_fraction 1 and expansion 0 the bits are those of the function above.
template <class Rule, class Real>
InelasticResult<Real> collide(const Vec2<Real>& r, Real m_i, Vec2<Real>& v_i, Real m_j, Vec2<Real>& v_j,
                              const Inelasticity<Real>& how) {
  if (how.reflected_fraction == 1 && how.expansion == 0) return {collide<Rule, Real>(r, m_i, v_i, m_j, v_j)};
  using std::sqrt;
  const Vec2<Real> v = v_i - v_j;
  const Real distance = sqrt(r.squaredNorm());
  const Real least = how.expansion * distance;  // of r . v, for surfaces that do not approach
  const Real b = r.dot(v) - least;
  if (!(b < 0)) return {};

  const Vec2<Real> surfaces = v - (how.expansion / distance) * r;
  const Vec2<Real> d = how.reflected_fraction * Rule::reversed_part(r, surfaces, b);
  // mu / 2 (|v - 2 d|^2 - v^2) = 2 mu (d^2 - d . v)
  const Real gained = detail::twice_reduced<Real>(d.dot(d - v), m_i, m_j);
  // In the frame of the surfaces, which leaves out the work that they do.
  const Real lost = how.reflected_fraction == 1 ? Real(0) : detail::twice_reduced<Real>(d.dot(surfaces - d), m_i, m_j);
  detail::apply_by_mass<Real>(v, d, m_i, v_i, m_j, v_j);
  if (r.dot(v_i - v_j) < least) detail::recede(r, m_i, v_i, m_j, v_j, least);
  return {{detail::twice_reduced<Real>(-b * how.reflected_fraction, m_i, m_j), gained},
          lost,
          how.reflected_fraction < 1 ? smallness<Real>(-b / distance, distance) : infinity<Real>};
}

}  // namespace carom
