#pragma once
// The guarded fixed-step method, the best of the simple ones. In each step:
//
//   1. a disk whose edge is beyond a wall, or the rim of a circular box, and that moves outward is reflected, and so is one that
//      overlaps an obstacle and moves towards it;
//   2. each pair (i, j), i < j in order, that is closer than the sum of the radii and approaches collides by the rule;
//   3. record the positions; move along the flights of bodies.hpp for a time dt.
//
// The method does not determine when in the step disks met: they overlap by up to |v| dt before they are reflected, and a pair
// that enters and leaves contact within one step is missed. A disk of restitution e that has come to rest on a floor leaves it by
// e v in each step and comes back by v = g dt - e v, so it sinks: by (1 - e) / (2 (1 + e)) g dt^2 per step. This version examines
// all pairs; grid.hpp finds the same ones faster.

#include "effects/impact.hpp"
#include "stepper/bodies.hpp"
#include "stepper/reflect_at_wall.hpp"
#include "stepper/tally.hpp"

#include <cstddef>

namespace carom {

/// All pairs, one by one.
class AllPairs {
 public:
  AllPairs(const Bodies& /*bodies*/, double /*dt*/) {}

  /// Returns the number of disk pairs that a step examines.
  [[nodiscard]] static double work(double disks) { return disks * disks / 2; }

  void moved(const Bodies& /*bodies*/, double /*time*/) {}
  [[nodiscard]] static std::size_t bytes() { return 0; }

  /// Calls contact(i, j, r_i - r_j) for i < j closer than the sum of their radii, in the order of i, then of j. Requires that
  /// no call moves a disk.
  template <class Contact>
  void for_contacts(const Bodies& bodies, Contact contact) const {
    for (std::size_t i = 0; i < bodies.count(); ++i) {
      for (std::size_t j = i + 1; j < bodies.count(); ++j) {
        const double sigma = bodies.radius[i] + bodies.radius[j];
        if (bodies.squared_distance(bodies.r[i], bodies.r[j]) < sigma * sigma)
          contact(i, j, bodies.separation(bodies.r[i], bodies.r[j]));
      }
    }
  }
};

template <class Rule, class Pairs>
class GuardedStep {
 public:
  GuardedStep(const Bodies& bodies, double dt) : dt_(dt), pairs_(bodies, dt) {}

  [[nodiscard]] static double work(double disks) { return Pairs::work(disks); }

  void advance(Bodies& bodies, Tally& /*tally*/) {
    move_on(bodies, dt_);
    pairs_.moved(bodies, dt_);
  }

  void check(Bodies& bodies, Tally& tally) {
    if (bodies.bounded()) {
      for (std::size_t i = 0; i < bodies.count(); ++i) reflect(bodies, i, tally);
    }
    pairs_.for_contacts(bodies, [&](std::size_t i, std::size_t j, const Vec2<double>& r) {
      if (!(r.dot(bodies.v[i] - bodies.v[j]) < 0)) return;
      const auto impact = collide<Rule, double>(r, bodies.mass[i], bodies.v[i], bodies.mass[j], bodies.v[j], bodies.impact);
      tally.pair(i, j, impact.virial, impact.lost, bodies.v[i], bodies.v[j]);
    });
  }

  /// Moves disks from the last step to a time before the next one.
  static void move_on(Bodies& bodies, double time) { bodies.fly(time); }
  [[nodiscard]] std::size_t bytes() const { return pairs_.bytes(); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(pairs_);
  }

 private:
  static void reflect(Bodies& bodies, std::size_t i, Tally& tally) {
    for (int axis = 0; axis < 2; ++axis) {
      if (!bodies.walled[axis]) continue;
      const double across = bodies.v[i][axis];
      const bool below = across < 0 && bodies.r[i][axis] < bodies.domain.lower[axis] + bodies.radius[i];
      const bool above = across > 0 && bodies.r[i][axis] > bodies.domain.upper[axis] - bodies.radius[i];
      if (!below && !above) continue;
      reflect_at_wall(bodies, i, axis, above, tally);
    }
    if (bodies.shapes == nullptr) return;
    bodies.shapes->for_overlaps(bodies.r[i], bodies.radius[i], bodies.radius[i], [&](const StepShapes::Overlap& overlap) {
      if (overlap.normal.dot(bodies.v[i]) < 0) reflect_at_shape(bodies, i, overlap, tally);
    });
  }

  double dt_;
  Pairs pairs_;
};

}  // namespace carom
