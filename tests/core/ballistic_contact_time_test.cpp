// Contact times of falling disks in double precision against a slow twin in 113 bits, within the bounds that
// core/ballistic_contact_time.hpp states.

#include "core/ballistic_contact_time.hpp"

#include "core/unit_roundoff.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <random>
#include <vector>

namespace carom::test {
namespace {

struct Approach {
  Vec2<double> r;
  Vec2<double> v;
  Vec2<double> g;
  double sigma;
  double growth;

  template <class Real = double>
  [[nodiscard]] Real contact(Real until) const {
    return ballistic_contact_time<Real>(r.cast<Real>(), v.cast<Real>(), g.cast<Real>(), Real(sigma), Real(growth), until);
  }
  [[nodiscard]] double gap(Quad t) const {
    using std::sqrt;
    const Vec2<Quad> at = r.cast<Quad>() + t * v.cast<Quad>() + (t * t / 2) * g.cast<Quad>();
    return static_cast<double>(sqrt(at.squaredNorm()) - Quad(sigma) - Quad(growth) * t);
  }
  /// H of the header.
  [[nodiscard]] double scale(double t) const { return r.norm() + v.norm() * t + g.norm() * t * t / 2 + sigma + growth * t; }
};

std::ostream& operator<<(std::ostream& out, const Approach& a) {
  out.precision(17);
  return out << "r = " << a.r.transpose() << ", v = " << a.v.transpose() << ", g = " << a.g.transpose() << ", sigma = " << a.sigma
             << ", growth = " << a.growth;
}

/// The slow twin: looks at the gap at many times, in 113 bits. Every sample before the contact must be apart, but for disks that
/// have not parted yet and recede.
void check(const Approach& a, double until, int samples) {
  SCOPED_TRACE(::testing::Message() << a << ", until = " << until);
  const double t = a.contact(until);
  const bool hit = t < infinity<double>;
  if (hit) {
    ASSERT_GE(t, 0.0);
    ASSERT_LE(t, until);
    ASSERT_LE(t > 0.0 ? std::abs(a.gap(Quad(t))) : 0.0, 16 * u * a.scale(t)) << "t = " << t;
  }
  double before = a.gap(Quad(0));
  bool apart = before > 0.0;
  for (int k = 1; k <= samples; ++k) {
    const double s = (hit ? t : until) * k / samples;
    const double gap = a.gap(Quad(s));
    const double bound = 16 * u * a.scale(s);
    ASSERT_GE(gap, (apart ? 0.0 : before) - bound) << "missed at " << s << ", found " << t;
    apart = apart || gap > bound;
    before = gap;
  }
}

class BallisticContactTime : public ::testing::Test {
 protected:
  std::mt19937_64 random{23};
  double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(random); }
  double between(double from, double to) { return from + (to - from) * unit(); }
  double decades(double from, double to) { return std::pow(10.0, between(from, to)); }
  double sign() { return random() % 2 == 0 ? 1.0 : -1.0; }
  Vec2<double> direction() {
    const double angle = between(0.0, 6.2831853);
    return {std::cos(angle), std::sin(angle)};
  }
  /// Of order one throughout: paths that meet the disk up to twice from outside.
  Approach ordinary() {
    const Vec2<double> r = between(1.0, 5.0) * direction();
    return {r, between(0.0, 3.0) * direction(), between(0.0, 2.0) * direction(), 1.0,
            random() % 2 == 0 ? 0.0 : between(0.0, 2.0)};
  }
};

TEST_F(BallisticContactTime, MissesNothingAndStaysWithinItsBound) {
  for (int n = 0; n < 3000; ++n) check(ordinary(), between(0.0, 10.0), 60);
}

TEST_F(BallisticContactTime, DecidesAndTimesAs113BitsDo) {
  int hits = 0;
  for (int n = 0; n < 100'000; ++n) {
    const Approach a = ordinary();
    const double until = n % 2 == 0 ? infinity<double> : between(0.0, 10.0);
    const double t = a.contact(until);
    const Quad exact = a.contact<Quad>(Quad(until));
    if ((t < infinity<double>) != (exact < infinity<Quad>)) {  // only where the contact grazes, or falls on `until`
      const double s = std::min(t, static_cast<double>(exact));
      EXPECT_LE(std::min(std::abs(s - until) / s, std::abs(a.gap(Quad(s)) / a.scale(s))), 1e-12) << a;
    } else if (t < infinity<double>) {
      ++hits;
      ASSERT_LE(std::abs(a.gap(Quad(t))), 16 * u * a.scale(t)) << a;
      ASSERT_NEAR(t, static_cast<double>(exact), 1e-6 * t) << a;  // grazing moves the time by the root of the rounding
    }
  }
  EXPECT_GT(hits, 20'000);
}

TEST_F(BallisticContactTime, StaysWithinItsBoundsOnAnyScale) {
  for (int n = 0; n < 3000; ++n) {
    const double length = decades(-6.0, 6.0);
    const double time = decades(-6.0, 6.0);
    Approach a = ordinary();
    a.r *= length * (n % 3 == 0 ? decades(0.0, 3.0) : 1.0);
    a.v *= length / time * decades(-3.0, 1.0);
    a.g *= length / (time * time) * decades(-12.0, 2.0);
    a.sigma = length;
    a.growth *= length / time * decades(-6.0, 0.0);
    check(a, time * decades(-2.0, 3.0), 40);
  }
}

TEST_F(BallisticContactTime, StaysWithinItsBoundsForGrazingPassesFromBothSides) {
  for (int n = 0; n < 10'000; ++n) {
    // At the moment T the path touches from outside or inside: r = sigma' n, velocity across n but for growth.
    const double growth = n % 2 == 0 ? 0.0 : between(0.0, 1.0);
    const double time = between(0.1, 3.0);
    const Vec2<double> e = direction();
    const Vec2<double> across(-e.y(), e.x());
    const Vec2<double> g = between(0.0, 3.0) * direction();
    const Vec2<double> at = (1.0 + growth * time + sign() * decades(-17.0, -8.0)) * e;
    const Vec2<double> speed = growth * e + between(0.5, 2.0) * across;
    const Approach a{at - time * speed + (time * time / 2) * g, speed - time * g, g, 1.0, growth};
    if (!(a.gap(Quad(0)) > 0.0)) continue;
    check(a, 1.5 * time, 24);
    // Within rounding of T the gap is smallest, or the path is inside: no miss unless it touches within rounding.
    ASSERT_TRUE(a.contact(2.0 * time) < infinity<double> || a.gap(Quad(time)) > -16 * u * a.scale(time)) << a;
  }
}

TEST_F(BallisticContactTime, TheApexExactlyAtContactTouchesOnce) {
  // Thrown up by v^2/2g = 2 to a disk of contact distance 1 straight above, or passing below its lowest point.
  // The time of a double zero is known to the root of the rounding.
  EXPECT_NEAR((Approach{{0.0, -3.0}, {0.0, 2.0}, {0.0, -1.0}, 1.0, 0.0}.contact(10.0)), 2.0, 3e-8);
  EXPECT_NEAR((Approach{{-2.0, -3.0}, {1.0, 2.0}, {0.0, -1.0}, 1.0, 0.0}.contact(10.0)), 2.0, 3e-8);
  EXPECT_EQ((Approach{{0.0, -3.0 - 0x1p-40}, {0.0, 2.0}, {0.0, -1.0}, 1.0, 0.0}.contact(10.0)), infinity<double>);
  EXPECT_LT((Approach{{0.0, -3.0 + 0x1p-40}, {0.0, 2.0}, {0.0, -1.0}, 1.0, 0.0}.contact(10.0)), 2.0);
}

TEST_F(BallisticContactTime, ADroppedDiskFallsAsTheClosedFormSays) {
  EXPECT_NEAR((Approach{{0.0, 9.0}, {0.0, 0.0}, {0.0, -1.0}, 1.0, 0.0}.contact(10.0)), 4.0, 4e-15);
  EXPECT_NEAR((Approach{{0.0, 3.0}, {0.0, 1.0}, {0.0, -2.0}, 1.0, 0.0}.contact(10.0)), 2.0, 4e-15);
  EXPECT_NEAR((Approach{{0.0, 3.0}, {0.0, 0.0}, {0.0, -1.0}, 1.0, 0.5}.contact(10.0)), std::sqrt(4.25) - 0.5, 4e-15);
}

TEST_F(BallisticContactTime, ThrownAwayAgainstGravityItComesBack) {
  // From contact upwards at 3: back after 6. Over the top of the disk and down on its far side: by symmetry.
  EXPECT_NEAR((Approach{{0.0, 1.0}, {0.0, 3.0}, {0.0, -1.0}, 1.0, 0.0}.contact(infinity<double>)), 6.0, 1e-14);
  const double c = std::sqrt(0.5);
  EXPECT_NEAR((Approach{{-c, c}, {c, 1.0}, {0.0, -1.0}, 1.0, 0.0}.contact(infinity<double>)), 2.0, 1e-14);
}

TEST_F(BallisticContactTime, TouchingIsNowWhereDisksApproachOrAreAboutTo) {
  const Vec2<double> top(0.0, 1.0);
  for (const double y : {1.0, 0.875}) {
    const Vec2<double> r(0.0, y);
    EXPECT_EQ((Approach{r, {1.0, -1e-9}, {0.0, 1.0}, 1.0, 0.0}.contact(1.0)), 0.0);
    EXPECT_EQ((Approach{r, {0.0, 0.0}, {0.0, -1.0}, 1.0, 0.0}.contact(1.0)), 0.0);
    EXPECT_EQ((Approach{r, {0.5, 0.0}, {0.0, -1.0}, 1.0, 0.0}.contact(1.0)), 0.0);
  }
  EXPECT_EQ((Approach{top, {0.0, 1e-9}, {0.0, 1.0}, 1.0, 0.0}.contact(1.0)), infinity<double>);
  EXPECT_EQ((Approach{top, {0.0, 0.0}, {0.0, 1.0}, 1.0, 0.0}.contact(1.0)), infinity<double>);
  EXPECT_EQ((Approach{top, {2.0, 0.0}, {0.0, -1.0}, 1.0, 0.0}.contact(1.0)), infinity<double>) << "faster than it falls";
}

TEST_F(BallisticContactTime, AnOverlapByRoundingThatNeverOpensIsAContactWhenItTurnsBack) {
  const Approach a{{0.0, 1.0 - 0x1p-50}, {0.0, 0x1p-30}, {0.0, -1.0}, 1.0, 0.0};
  EXPECT_NEAR(a.contact(1.0), 0x1p-30, 1e-24);
}

TEST_F(BallisticContactTime, UntilCutsButDoesNotMove) {
  for (int n = 0; n < 2000; ++n) {
    const Approach a = ordinary();
    const double t = a.contact(infinity<double>);
    if (!(t > 0.0 && t < infinity<double>)) continue;
    EXPECT_EQ(a.contact(t * (1.0 - 1e-7)), infinity<double>) << a;
    for (const double longer : {1.0, 1.0 + 1e-7, 1.5, 1e3}) EXPECT_EQ(a.contact(t * longer), t) << a;
  }
}

TEST_F(BallisticContactTime, WithoutGravityHasTheBitsOfStraightPaths) {
  for (int n = 0; n < 100'000; ++n) {
    const Approach a = ordinary();
    const double t = contact_time<double>(a.r, a.v, a.sigma, a.growth);
    const double until = between(0.0, 4.0);
    ASSERT_EQ((Approach{a.r, a.v, {0.0, -0.0}, a.sigma, a.growth}.contact(until)), t <= until ? t : infinity<double>);
  }
}

TEST_F(BallisticContactTime, NearlyStraightPathsMeetWhereStraightOnesDo) {
  for (int n = 0; n < 20'000; ++n) {
    Approach a = ordinary();
    a.g *= 1e-30;
    const double straight = contact_time<double>(a.r, a.v, a.sigma, a.growth);
    if (!(straight < 100.0)) continue;
    const double t = a.contact(n % 2 == 0 ? infinity<double> : 1000.0);
    ASSERT_LE(std::abs(a.gap(Quad(t))), 16 * u * a.scale(t)) << a;
    ASSERT_NEAR(t, straight, 1e-6 * straight) << a;
  }
}

template <class Real>
void every_precision_reaches_its_last_bits() {
  using std::abs;
  using std::sqrt;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int n = 0; n < 2000; ++n) {
    const Vec2<Real> r(Real(3 * unit(random)), Real(3 * unit(random)));
    const Vec2<Real> v(Real(unit(random)), Real(unit(random)));
    const Vec2<Real> g(Real(unit(random)), Real(unit(random)));
    if (!(r.squaredNorm() > 1)) continue;
    const Real t = ballistic_contact_time<Real>(r, v, g, Real(1), Real(0), Real(20));
    if (!(t < infinity<Real>)) continue;
    const Real scale = sqrt(r.squaredNorm()) + t * sqrt(v.squaredNorm()) + t * t / 2 * sqrt(g.squaredNorm()) + 1;
    const Vec2<Real> at = r + t * (v + (t / 2) * g);
    EXPECT_LE(abs(sqrt(at.squaredNorm()) - 1), 12 * epsilon<Real> * scale);  // 16 u H, and the rounding of the check
  }
}

TEST_F(BallisticContactTime, FloatReachesItsLastBits) { every_precision_reaches_its_last_bits<float>(); }
TEST_F(BallisticContactTime, LongDoubleReachesItsLastBits) { every_precision_reaches_its_last_bits<long double>(); }
TEST_F(BallisticContactTime, QuadReachesItsLastBits) { every_precision_reaches_its_last_bits<Quad>(); }

RC_GTEST_PROP(PropertyBallisticContactTime, ScalingLengthsAndTimesByPowersOfTwoCommutesBitForBit, ()) {
  const auto number = [] { return *rc::gen::inRange(-1'000'000, 1'000'000) / 65536.0; };
  const Approach a{{number(), number()}, {number(), number()}, {number(), number()}, 1.0, std::abs(number())};
  const int lengths = *rc::gen::inRange(-20, 21);
  const int times = 2 * *rc::gen::inRange(-10, 11);
  const double length = std::ldexp(1.0, lengths);
  const double speed = std::ldexp(1.0, lengths - times);
  const Approach scaled{length * a.r, speed * a.v, std::ldexp(speed, -times) * a.g, length, speed * a.growth};
  RC_ASSERT(scaled.contact(std::ldexp(8.0, times)) == std::ldexp(a.contact(8.0), times));
}

RC_GTEST_PROP(PropertyBallisticContactTime, AMirrorImageMeetsAtTheSameTime, ()) {
  const auto number = [] { return *rc::gen::inRange(-1'000'000, 1'000'000) / 65536.0; };
  const Approach a{{number(), number()}, {number(), number()}, {number(), number()}, 1.0, 0.0};
  const Approach turned{-a.r, -a.v, -a.g, 1.0, 0.0};
  RC_ASSERT(turned.contact(50.0) == a.contact(50.0));
}

}  // namespace
}  // namespace carom::test
