#pragma once
// The naive fixed-step method, to the letter. In each step, for every disk in order:
//
//   1. reverse vx if the disk is beyond a vertical wall, vy if beyond a horizontal one, the component across an obstacle if it
//      overlaps one;
//   2. for every other disk closer than the sum of the radii, give both their new velocities by the collision rule;
//   3. record the position;
//   4. move along the flight of bodies.hpp for a time dt.
//
// Its faults are what the exact engine is measured against, so they are kept. Nobody asks whether a pair approaches: the pair (i,
// j) is met again as (j, i) in the same step and turned back, and once more in the next step if it still overlaps. A disk that is
// still beyond a wall in the next step is turned outward again. Disk i has moved before disk i + 1 is looked at. A wall is met by
// the disk's centre, or, for a comparison of the time-stepping alone, by its edge. The rim of a circular box is such a wall: what
// is reversed there is the component along the radius. Obstacles are met by the edge, as other disks are, and in the same way
// reversed in every step in which the disk overlaps them.

#include "stepper/bodies.hpp"
#include "stepper/reflect_at_wall.hpp"
#include "stepper/tally.hpp"

#include <cstddef>
#include <vector>

namespace carom {

enum class WallMeets { centre, edge };

template <class Rule, WallMeets meets>
class NaiveStep {
 public:
  NaiveStep(const Bodies& bodies, double dt) : dt_(dt), flight_(bodies.v) {}

  /// Returns the number of disk pairs that a step examines.
  [[nodiscard]] static double work(double disks) { return disks * disks; }

  /// Moves the disks from the last step to this one, as step 4 of the last one decided.
  void advance(Bodies& bodies, Tally& /*tally*/) const { move_on(bodies, dt_); }

  void check(Bodies& bodies, Tally& tally) {
    place_ = bodies.r;
    for (std::size_t i = 0; i < bodies.count(); ++i) {
      reflect(bodies, i, tally);
      for (std::size_t j = 0; j < bodies.count(); ++j) {
        if (j == i) continue;
        const double sigma = bodies.radius[i] + bodies.radius[j];
        if (bodies.squared_distance(place_[i], place_[j]) < sigma * sigma)
          collide(bodies, i, j, bodies.separation(place_[i], place_[j]), tally);
      }
      flight_[i] = bodies.v[i];
      place_[i] += bodies.mean_velocity(flight_[i], dt_) * dt_;
      (void)bodies.domain.wrap(place_[i]);
    }
  }

  /// Moves disks from the last step to a time before the next one, each by the velocity with which it left the last step; a disk
  /// later in the order may since have given it another one.
  void move_on(Bodies& bodies, double time) const {
    for (std::size_t i = 0; i < bodies.count(); ++i) {
      bodies.move(i, bodies.mean_velocity(flight_[i], time), time);
      bodies.accelerate(i, time);
    }
  }
  [[nodiscard]] std::size_t bytes() const { return (flight_.capacity() + place_.capacity()) * sizeof(Vec2<double>); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(flight_, place_);
  }

 private:
  static void reflect(Bodies& bodies, std::size_t i, Tally& tally) {
    const double room = meets == WallMeets::edge ? bodies.radius[i] : 0.0;
    for (int axis = 0; axis < 2; ++axis) {
      if (!bodies.walled[axis]) continue;
      const bool below = bodies.r[i][axis] < bodies.domain.lower[axis] + room;
      const bool above = bodies.r[i][axis] > bodies.domain.upper[axis] - room;
      if (below || above) reflect_at_wall(bodies, i, axis, above, tally);
    }
    if (bodies.shapes != nullptr)
      bodies.shapes->for_overlaps(bodies.r[i], bodies.radius[i], room,
                                  [&](const StepShapes::Overlap& overlap) { reflect_at_shape(bodies, i, overlap, tally); });
  }

  /// The rule, whether or not the two approach: w = v - 2 (mu / m) d for one and + for the other, where d is the part of the
  /// relative velocity that the rule turns round, times (1 + e) / 2. Under the reversal rule of elastic disks this is
  /// w = -v + 2 V_cm.
  static void collide(Bodies& bodies, std::size_t i, std::size_t j, const Vec2<double>& r, Tally& tally) {
    const Vec2<double> v = bodies.v[i] - bodies.v[j];
    const double b = r.dot(v);
    const double fraction = bodies.impact.reflected_fraction;
    const Vec2<double> d = fraction * Rule::reversed_part(r, v, b);
    if (!d.allFinite()) return;  // centre upon centre: no direction to turn
    const double total = bodies.mass[i] + bodies.mass[j];
    bodies.v[i] -= (2 * bodies.mass[j] / total) * d;
    bodies.v[j] += (2 * bodies.mass[i] / total) * d;
    const double lost = fraction == 1.0 ? 0.0 : detail::twice_reduced<double>(d.dot(v - d), bodies.mass[i], bodies.mass[j]);
    tally.pair(i, j, -b * fraction * 2 * bodies.mass[i] * bodies.mass[j] / total, lost, bodies.v[i], bodies.v[j]);
  }

  double dt_;
  std::vector<Vec2<double>> flight_;
  std::vector<Vec2<double>> place_;  ///< this step's for disks still to be looked at, the next step's for the others
};

}  // namespace carom
