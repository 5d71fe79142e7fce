#pragma once
// One disk among obstacles: the smallest loop that bounces, to test obstacles without an engine.

#include "core/simulation_box.hpp"
#include "effects/obstacles.hpp"
#include "support/scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace carom::test {

inline Obstacle fixed_disk(double x, double y, double radius) { return DiskObstacle{{x, y}, radius}; }

inline Obstacle fixed_segment(Eigen::Vector2d from, Eigen::Vector2d to) { return SegmentObstacle{from, to}; }

/// An arc that spans an angle in degrees from the direction `from` on.
inline Obstacle fixed_arc(Eigen::Vector2d centre, double radius, double from, double span) {
  return ArcObstacle{centre, radius, from, from + span};
}

inline std::vector<Obstacle> polygon(const std::vector<Eigen::Vector2d>& corners) {
  std::vector<Obstacle> sides;
  for (std::size_t k = 0; k < corners.size(); ++k) sides.push_back(fixed_segment(corners[k], corners[(k + 1) % corners.size()]));
  return sides;
}

struct Billiard {
  Box box;
  Obstacles<double> obstacles;
  Vec2<double> r;
  Vec2<double> v;
  Vec2<double> g = Vec2<double>::Zero();
  double radius = 0.5;
  double growth = 0.0;
  double path = 0.0;  ///< length of the straight paths so far

  Billiard(const Box& room, const std::vector<Obstacle>& list, const Vec2<double>& place, const Vec2<double>& velocity,
           double size)
      : box(room), obstacles(room, list), r(place), v(velocity), radius(size) {}

  [[nodiscard]] Obstacles<double>::Meeting next(double until = infinity<double>) const {
    return obstacles.next(r, v, g, radius, growth, until);
  }
  void fly(double t) {
    path += t * v.norm();
    r += t * (v + t / 2 * g);
    v += t * g;
    static_cast<void>(SimulationBox<double>(box).wrap(r));
  }
  void bounce(std::int32_t obstacle) {
    const Vec2<double> n = obstacles.from_nearest_point(obstacle, r);
    v -= 2 * (v.dot(n) / n.squaredNorm()) * n;
  }
  /// As engines do it, where it may skim along an arc.
  void bounce_and_leave(std::int32_t obstacle) {
    static_cast<void>(obstacles.bounce(obstacle, r, v, g, 1.0, radius, radius * growth));
  }
  /// To the next obstacle and off it.
  Obstacles<double>::Meeting step(double until = infinity<double>) {
    const auto meeting = next(until);
    if (meeting.obstacle < 0) return meeting;
    fly(meeting.time);
    bounce(meeting.obstacle);
    return meeting;
  }
  /// From the nearest obstacle's edge to the disk's, of `list`; negative where they overlap.
  [[nodiscard]] double clearance(const std::vector<Obstacle>& list) const {
    double least = infinity<double>;
    for (std::size_t o = 0; o < list.size(); ++o) {
      const auto* disk = std::get_if<DiskObstacle>(&list[o]);
      const double apart = obstacles.from_nearest_point(static_cast<std::int32_t>(o), r).norm();
      least = std::min(least, apart - radius - (disk ? disk->radius : 0.0));
    }
    return least;
  }
  [[nodiscard]] double energy() const { return v.squaredNorm() / 2 - g.dot(r); }
};

/// A disk bounces in a closed room within a box of 10 times 10: it never gets out nor into a side, and keeps its energy.
inline void holds_its_disk(const std::vector<Obstacle>& sides, const Vec2<double>& start, double radius,
                           const Vec2<double>& g = Vec2<double>::Zero()) {
  Billiard disk(box_of(10.0, 10.0, Boundary::walls), sides, start, {0.6, 0.8}, radius);
  disk.g = g;
  const double energy = disk.energy();
  for (int k = 0; k < 100'000; ++k) {
    const auto meeting = disk.next(100.0);
    ASSERT_GE(meeting.obstacle, 0) << "got out at bounce " << k;
    for (const double part : {meeting.time / 2, meeting.time - meeting.time / 2}) {
      disk.fly(part);
      ASSERT_GT(disk.clearance(sides), -2e-12) << "bounce " << k << ", " << disk.r.transpose();
    }
    disk.bounce(meeting.obstacle);
  }
  EXPECT_NEAR(disk.energy(), energy, 1e-11 * (1.0 + std::abs(energy)));
}

}  // namespace carom::test
