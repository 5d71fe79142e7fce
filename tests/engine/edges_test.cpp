// Images and edges as the textbook engine asks for them.

#include "engine/edges.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace carom::test {
namespace {

using V = Vec2<double>;

Box box() {
  Box box;
  box.lower = {-3.0, 1.0};
  box.upper = {7.0, 5.0};
  box.boundary = {Boundary::periodic, Boundary::periodic};
  return box;
}

/// Images above slide at 2 to the right.
Effects sheared() {
  Effects effects;
  effects.shear.emplace().rate = 0.5;
  return effects;
}

V separation(const Edges<double>& edges, V r, const Winding& shift, double t) {
  edges.take_image(shift, t, r);
  return r;
}
V relative_velocity(const Edges<double>& edges, V v, const Winding& shift) {
  edges.take_image_velocity(shift, v);
  return v;
}

/// Images one by one: the displacement and speed of those `shift` boxes away, by definition.
V image_of(const V& r, const Winding& shift, double displacement, double t) {
  return r + V(10.0 * static_cast<double>(shift[0]) + (displacement + 2.0 * t) * static_cast<double>(shift[1]),
               4.0 * static_cast<double>(shift[1]));
}

TEST(Edges, SeparationsAndVelocitiesAreThoseOfTheImageByDefinition) {
  const Edges<double> edges(box(), sheared(), 3.0);
  const V a(-2.0, 1.5), b(6.0, 4.5);
  for (const std::int64_t x : {-1, 0, 1})
    for (const std::int64_t y : {-1, 0, 1})
      for (const double t : {0.0, 0.25, 2.0}) {
        const Winding shift(x, y);
        EXPECT_EQ(separation(edges, a - b, shift, t), a - image_of(b, shift, 3.0, t));
        EXPECT_EQ(relative_velocity(edges, V(1.0, 2.0), shift), V(1.0 - 2.0 * static_cast<double>(y), 2.0));
      }
}

TEST(Edges, TheNearestImageIsTheNearestOfAll) {
  for (const Effects& effects : {Effects{}, sheared()}) {
    const Edges<double> edges(box(), effects, effects.shear ? 3.0 : 0.0);
    for (int k = 0; k < 200; ++k) {
      const V apart(std::fmod(7.77 * k, 10.0) - 5.0, std::fmod(3.21 * k, 4.0) - 2.0);
      const double t = 0.01 * k, found = separation(edges, apart, edges.nearest_image(apart, t), t).norm();
      if (found > 1.9) continue;  // farther apart than half the box is high, images may be as near in the one way as in the other
      for (const std::int64_t x : {-2, -1, 0, 1, 2})
        for (const std::int64_t y : {-1, 0, 1}) EXPECT_LE(found, separation(edges, apart, Winding(x, y), t).norm() + 1e-14);
    }
  }
}

TEST(Edges, ADiskThatCrossesGoesOnAsItsImageAndTheWorkIsCounted) {
  const Edges<double> edges(box(), sheared(), 3.0);
  RunningTotals totals;
  const double now = 0.5, mass = 3.0;
  V r(1.0, 5.0), v(4.0, 1.0);
  EXPECT_EQ(edges.time_to_edge(true, V(1.0, 4.5), 1.0), 0.5);
  const Winding passed = edges.cross(true, mass, r, v, now, totals);
  EXPECT_EQ(r, V(1.0 - 3.0 - 2.0 * now, 1.0));
  EXPECT_EQ(v, V(2.0, 1.0));
  EXPECT_EQ(passed, Winding(0, 1));
  EXPECT_EQ(totals.rounded().shear_energy, mass * (4.0 - 16.0) / 2.0);
  const Winding back = edges.cross(false, mass, r, v, now, totals);
  EXPECT_EQ(r, V(1.0, 5.0));
  EXPECT_EQ(v, V(4.0, 1.0));
  EXPECT_EQ(back, Winding(0, -1));
  EXPECT_EQ(totals.rounded().shear_energy, 0.0);
}

TEST(Edges, WorkOnAnImageIsItsSpeedTimesTheMomentumThatItLost) {
  const Edges<double> edges(box(), sheared(), 3.0);
  for (const std::int64_t above : {-1, 0, 1}) {
    RunningTotals totals;
    V v(1.0, 2.0);
    const double before = edges.enter_image(Winding(0, above), v), speed = 2.0 * static_cast<double>(above);
    EXPECT_EQ(v, V(1.0 + speed, 2.0));
    v[0] -= 0.5;  // a collision
    edges.leave_image(Winding(0, above), 3.0, before, v, totals);
    EXPECT_EQ(v, V(0.5, 2.0));
    EXPECT_EQ(totals.rounded().shear_energy, 3.0 * 0.5 * speed);
  }
}

TEST(Edges, WithoutShearNothingSlides) {
  const Edges<double> edges(box(), Effects{}, 0.0);
  EXPECT_FALSE(edges.sheared());
  EXPECT_FALSE(edges.walled(0));
  EXPECT_EQ(edges.flow(2.0), 0.0);
  EXPECT_EQ(edges.time_to_slide(1.0, 7.0), 7.0);
  EXPECT_EQ(Edges<double>(box(), sheared(), 0.0).time_to_slide(1.0, 7.0), 0.5);
  Box walls = box();
  walls.boundary[1] = Boundary::walls;
  EXPECT_TRUE(Edges<double>(walls, Effects{}, 0.0).walled(1));
}

}  // namespace
}  // namespace carom::test
