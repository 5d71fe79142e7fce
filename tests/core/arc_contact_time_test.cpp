// The time at which a disk reaches the rim of a hollow circle, against 113-bit arithmetic; and parabolas through circles.

#include "core/arc_contact_time.hpp"

#include "core/unit_roundoff.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace carom::test {
namespace {

class ArcContactTime : public ::testing::Test {
 protected:
  std::mt19937_64 random{23};
  double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(random); }
  double between(double from, double to) { return from + (to - from) * unit(); }
  double power(double from, double to) { return std::pow(10.0, between(from, to)); }
};

Quad distance_at(const Vec2<double>& r, const Vec2<double>& v, const Vec2<double>& g, double t) {
  const Quad x = Quad(r.x()) + Quad(t) * (Quad(v.x()) + Quad(t) / 2 * Quad(g.x()));
  const Quad y = Quad(r.y()) + Quad(t) * (Quad(v.y()) + Quad(t) / 2 * Quad(g.y()));
  return sqrt(x * x + y * y);
}

// From the middle, from near the rim and on it, along chords down to 1e-8 of the radius.
TEST_F(ArcContactTime, ReachesTheRimWithinTheBound) {
  double worst = 0.0;
  for (int n = 0; n < 30'000; ++n) {
    const double sigma = power(-3.0, 3.0), growth = n % 3 == 0 ? power(-3.0, 1.0) : 0.0;
    const double place = between(0.0, 6.3), inside = n % 2 == 0 ? sigma * power(-16.0, 0.0) : 0.0;
    const double distance = std::max(0.0, sigma - inside);
    const Vec2<double> r(distance * std::cos(place), distance * std::sin(place));
    const double off = n % 4 == 0 ? between(0.0, 6.3) : (n % 4 == 1 ? 1.0 : -1.0) * power(-8.0, 0.0);  // from the tangent, inward
    const double heading = place + 1.5707963267948966 + off, speed = power(-2.0, 2.0);
    const Vec2<double> v(speed * std::cos(heading), speed * std::sin(heading));
    const double t = inner_contact_time<double>(r, v, sigma, growth);
    ASSERT_TRUE(t >= 0.0 && t < infinity<double>) << n;
    if (t == 0.0) continue;
    const Quad gap = Quad(sigma) - Quad(growth) * Quad(t) - distance_at(r, v, {0.0, 0.0}, t);
    const double h = r.norm() + sigma + (speed + growth) * t;
    worst = std::max(worst, std::abs(static_cast<double>(gap)) / (u * h));
  }
  EXPECT_LT(worst, 16.0);
}

TEST_F(ArcContactTime, ADiskOnTheRimThatMovesAlongItIsInContact) {
  EXPECT_EQ(inner_contact_time<double>({1.0, 0.0}, {0.0, 1.0}, 1.0, 0.0), 0.0);
  EXPECT_EQ(inner_contact_time<double>({1.0, 0.0}, {1.0, 1.0}, 1.0, 0.0), 0.0);
  EXPECT_EQ(inner_contact_time<double>({1.0, 0.0}, {0.0, 0.0}, 1.0, 0.0), infinity<double>);
  EXPECT_EQ(inner_contact_time<double>({1.0, 0.0}, {-1.0, 1.0}, 1.0, 0.0), 1.0);
  EXPECT_EQ(inner_contact_time<double>({0.0, 0.0}, {0.0, 0.0}, 1.0, 0.25), 4.0);
  // Beyond the rim by rounding, on a line that stays beyond it: it turns back when it is nearest.
  EXPECT_NEAR(inner_contact_time<double>({std::nextafter(1.0, 2.0), 0.0}, {-1e-10, 1.0}, 1.0, 0.0), 1e-10, 1e-20);
}

// Each crossing that is returned is one, and the path before it has crossed no other way: seen at 200 places.
TEST_F(ArcContactTime, ParabolasCrossACircleWhereTheyAreSaidTo) {
  int crossings = 0;
  for (int n = 0; n < 4'000; ++n) {
    const int sign = n % 2 == 0 ? 1 : -1;
    const double sigma = power(-1.0, 0.5), growth = n % 3 == 0 ? sign * power(-3.0, -0.5) : 0.0, until = 20.0;
    const Vec2<double> r(sigma * between(-1.5, 1.5), sigma * between(-1.5, 1.5)), v(between(-1.0, 1.0), between(-1.0, 1.0));
    const Vec2<double> g(between(-1.0, 1.0), between(-1.0, 1.0));
    const double start = sign * (r.norm() - sigma);
    if (start < 1e-3) continue;
    const auto gap = [&](double t) { return sign * (static_cast<double>(distance_at(r, v, g, t)) - (sigma + growth * t)); };
    const BallisticApproach<double> approach{r, v, g, sigma, growth};
    const auto any = [](double) { return true; };
    const double t = ballistic_crossing<double>(approach, sign, until, any);
    const double ever = ballistic_crossing<double>(approach, sign, infinity<double>, any);
    EXPECT_EQ(ever <= until ? ever : infinity<double>, t) << n;
    const double end = std::min({t, until, growth < 0.0 ? sigma / -growth : until});
    for (int k = 0; k < 200; ++k) ASSERT_GT(gap(end * k / 200.0), -1e-9) << n << ", " << k;
    if (!(t <= until)) continue;
    ++crossings;
    const double h = r.norm() + v.norm() * t + g.norm() * t * t / 2 + sigma + std::abs(growth) * t;
    EXPECT_NEAR(gap(t), 0.0, 16.0 * u * h) << n;
  }
  EXPECT_GT(crossings, 1000);
}

// A parabola enters and leaves a circle at most twice: each leaving is offered in turn.
TEST_F(ArcContactTime, EveryCrossingIsOffered) {
  const BallisticApproach<double> thrown{{-0.9, 0.2}, {0.9, 2.0}, {0.0, -2.0}, 1.0, 0.0};  // out at the top, back in, out below
  std::vector<double> offered;
  const double t = ballistic_crossing<double>(thrown, -1, infinity<double>, [&](double when) {
    offered.push_back(when);
    return false;
  });
  EXPECT_EQ(t, infinity<double>);
  ASSERT_EQ(offered.size(), 2U);
  for (const double when : offered) EXPECT_NEAR(thrown.separation(when).norm(), 1.0, 1e-14);
  EXPECT_GT(thrown.separation(offered[0]).y(), 0.0);
  EXPECT_LT(thrown.separation(offered[1]).y(), 0.0);
}

// It passes a circle on its way up, and falls onto it.
TEST_F(ArcContactTime, AnApproachThatMissesIsNotTheLast) {
  const BallisticApproach<double> thrown{{-2.5, -1.0}, {0.5, 3.0}, {0.0, -1.0}, 1.1, 0.0};
  std::vector<double> offered;
  const double t = ballistic_crossing<double>(thrown, 1, infinity<double>, [&](double when) {
    offered.push_back(when);
    return true;
  });
  ASSERT_EQ(offered.size(), 1U);
  EXPECT_EQ(t, offered[0]);
  EXPECT_NEAR(thrown.separation(t).norm(), 1.1, 1e-14);
  EXPECT_GT(thrown.separation(t).y(), 0.0);
}

}  // namespace
}  // namespace carom::test
