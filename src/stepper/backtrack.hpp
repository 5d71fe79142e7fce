#pragma once
// The fixed-step method that goes back to the moment of contact (engines of games call it the time of impact). A pair that
// overlaps at the end of a step met within it; both disks collide at that moment and fly on to the end of the step.
//
// With r and v the relative position and velocity at the end of the step, t <= 0 the time from there, and gap = r^2 - sigma^2 <
// 0, they touch where |r + v t|^2 = sigma^2:
//
//     v^2 t^2 + 2 b t + gap = 0,   b = r . v,   t = -(b + sqrt(b^2 - v^2 gap)) / v^2.
//
// Since gap < 0 there are two roots, one on each side of 0: the earlier is when they came into contact. Where b <= 0 the sum
// cancels, and t = gap / (sqrt(b^2 - v^2 gap) - b) is the same root.
//
// Where disks fall r and v are the same two numbers, since the acceleration is common to both disks; a wall is met where the
// parabola crosses it.
//
// Where t is earlier than the begin of the step, or than the last event of one of the two, they overlapped then already, and
// collide then if they approach.
//
// The method is exact to rounding as long as no step holds a mistake: a pair that touches and parts between two steps (a graze),
// which is not looked for. Two events of one disk in a step are found in their order, unless the disk that is met was not in the
// way at the end of the step.

#include "core/vec2.hpp"
#include "stepper/bodies.hpp"
#include "stepper/contacts_in_step.hpp"

#include <cmath>
#include <cstdint>

namespace carom {

/// Contacts of pairs that overlap at the end of the step.
struct OverlapAtTheEnd {
  static constexpr bool along_flights = false;

  /// A list for which few disks are turned out of reach within a step.
  static constexpr double least_margin = 1.0;

  /// Returns how far a disk may go in a part of a step: steps are not cut.
  [[nodiscard]] static double farthest(const Bodies& /*bodies*/) { return infinity<double>; }

  [[nodiscard]] static bool meets(const Bodies& bodies, std::uint32_t i, std::uint32_t j, double sigma_squared, double /*span*/) {
    return bodies.squared_distance(bodies.r[i], bodies.r[j]) < sigma_squared;
  }

  [[nodiscard]] static double entry(const Vec2<double>& r, const Vec2<double>& v, double sigma_squared, double begin) {
    const double gap = r.squaredNorm() - sigma_squared, b = r.dot(v), v_squared = v.squaredNorm();
    const double root = std::sqrt(b * b - v_squared * gap);
    const double time = b > 0.0 ? -(b + root) / v_squared : gap / (root - b);
    if (time >= begin) return time;
    return b + v_squared * begin < 0.0 ? begin : infinity<double>;
  }
};

template <class Rule>
using BacktrackStep = ContactStep<Rule, OverlapAtTheEnd>;

}  // namespace carom
