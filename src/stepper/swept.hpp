#pragma once
// The fixed-step method that looks for the earliest contact anywhere within each step, until none is left (continuous collision
// detection; the collision searches "line" of planetary codes). It is event-driven within a step, without a queue that outlives
// it, and right to rounding at any dt.
//
// With r and v the relative position and velocity at the end of the step and t <= 0 the time from there, a pair touches where
// |r + v t| = sigma. With b = r . v, c = r x v and gap = r^2 - sigma^2:
//
//     v^2 t^2 + 2 b t + gap = 0,   t = -(b + sqrt(d)) / v^2,   d = b^2 - v^2 gap = v^2 sigma^2 - c^2.
//
// Pairs that overlap at the end of the step have gap < 0, as in backtrack.hpp. Pairs that have met and parted within the step
// have gap > 0, b > 0 and d > 0: d in its second form, which keeps more digits where r is longer than sigma. What is too far
// apart to have met in the time h of the step is told without a root: they have been nearest to each other at -b / v^2, so b <=
// v^2 h.
//
// A listed pair is seen for as long as both disks are within half the list's margin of where they were when it was made, all
// along their flights. So the list is made before the move if a disk would leave that range in it, and disks that leave it
// nevertheless are held against all others. Images are told apart by the nearest one at the end of the step, which is the one
// that was met if disks go less than (L / 2 - sigma) / 2 along a periodic axis of length L. A step in which the fastest goes more
// than a third of that, or a quarter of the spacing of disks and half a diameter, beyond which lists become long, is taken in
// parts.

#include "core/vec2.hpp"
#include "stepper/bodies.hpp"
#include "stepper/contacts_in_step.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace carom {

/// Contacts of pairs anywhere within the step.
struct AnywhereWithin {
  static constexpr bool along_flights = true;
  static constexpr double least_margin = 2.5;

  [[nodiscard]] static bool meets(const Bodies& bodies, std::uint32_t i, std::uint32_t j, double sigma_squared, double span) {
    const Vec2<double> r = bodies.separation(bodies.r[i], bodies.r[j]);
    const double gap = r.squaredNorm() - sigma_squared;
    const Vec2<double> v = bodies.v[i] - bodies.v[j];
    const double b = r.dot(v), v_squared = v.squaredNorm();
    const bool within = (b > 0.0) & (b <= v_squared * span);  // one branch for all, since none of these can be foretold
    return (gap < 0.0) | (within & (b * b >= v_squared * gap * (1.0 - 1e-9)));
  }

  [[nodiscard]] static double entry(const Vec2<double>& r, const Vec2<double>& v, double sigma_squared, double begin) {
    const double gap = r.squaredNorm() - sigma_squared, b = r.dot(v), v_squared = v.squaredNorm();
    const double c = r[0] * v[1] - r[1] * v[0], d = v_squared * sigma_squared - c * c;
    if (gap >= 0.0 && !(d > 0.0)) return infinity<double>;
    const double root = std::sqrt(std::max(d, 0.0));
    const double time = b > 0.0 ? -(b + root) / v_squared : gap / (root - b);
    if (time >= begin) return time;
    return b + v_squared * begin < 0.0 ? begin : infinity<double>;
  }

  /// Returns how far the fastest disk may go in a part of a step.
  [[nodiscard]] static double farthest(const Bodies& bodies) {
    if (bodies.count() == 0) return infinity<double>;
    const double sigma = 2.0 * *std::max_element(bodies.radius.begin(), bodies.radius.end());
    const double spacing = std::sqrt(bodies.domain.length.prod() / static_cast<double>(bodies.count()));
    double most = std::max(0.25 * spacing, 0.5 * sigma);
    for (int axis = 0; axis < 2; ++axis)
      if (bodies.domain.periodic[axis]) most = std::min(most, (bodies.domain.length[axis] / 2.0 - sigma) / 6.0);
    return most;
  }
};

template <class Rule>
using SweptStep = ContactStep<Rule, AnywhereWithin>;

}  // namespace carom
