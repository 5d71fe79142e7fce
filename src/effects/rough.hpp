#pragma once
// Rough disks: contact also changes the tangential velocity at the point of contact, and the spins, by tangential restitution
// beta: g_t' = -beta g_t with g_t = v . t - (r_i w_i + r_j w_j), t = n turned by a right angle, n from j to i.
// Uniform disks, I = m r^2 / 2, so that the tangential reduced mass is mu / 3. Energy lost: mu (1 - beta^2) g_t^2 / 6.
// beta = -1: smooth, nothing happens here; +1: perfectly rough, nothing is lost.

#include "core/reduced_mass.hpp"
#include "core/vec2.hpp"

#include <cmath>

namespace carom {

/// The energy gained (<= 0). `r` is r_i - r_j at contact, radii the distances of the centres to the point of contact.
template <class Real>
Real roughen(const Vec2<Real>& r, Real roughness, Real m_i, Real radius_i, Vec2<Real>& v_i, Real& w_i, Real m_j, Real radius_j,
             Vec2<Real>& v_j, Real& w_j) {
  using std::sqrt;
  const Vec2<Real> n = r / sqrt(r.squaredNorm());
  const Vec2<Real> t(-n.y(), n.x());
  const Real g = t.dot(v_i - v_j) - (radius_i * w_i + radius_j * w_j);
  const Real reduced = reduced_mass_by_product(m_i, m_j) / 3;
  const Real impulse = -(1 + roughness) * reduced * g;
  v_i += (impulse / m_i) * t;
  v_j -= (impulse / m_j) * t;
  w_i -= 2 * impulse / (m_i * radius_i);
  w_j -= 2 * impulse / (m_j * radius_j);
  return -reduced * (1 - roughness * roughness) * g * g / 2;
}

}  // namespace carom
