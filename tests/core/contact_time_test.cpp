// Contact times in double precision against 113 bits, within the bounds that core/contact_time.hpp states and
// docs/numerics.md derives.

#include "core/contact_time.hpp"

#include "core/unit_roundoff.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <random>

namespace carom::test {
namespace {

struct Pair {
  Vec2<double> r;
  Vec2<double> v;
  double sigma;
};

Quad closest_approach(const Pair& pair) {
  using std::abs;
  using std::sqrt;
  const Vec2<Quad> r = pair.r.cast<Quad>();
  const Vec2<Quad> v = pair.v.cast<Quad>();
  return abs(cross<Quad>(r, v)) / sqrt(v.squaredNorm());
}

double gap_at(const Pair& pair, double t) {
  using std::sqrt;
  const Vec2<Quad> at = pair.r.cast<Quad>() + pair.v.cast<Quad>() * Quad(t);
  return static_cast<double>(sqrt(at.squaredNorm()) - Quad(pair.sigma));
}

/// Both bounds, for a pair that is apart. Returns |gap| at the time found, in units of u h (0 for a miss).
double check(const Pair& pair) {
  const double h = pair.r.norm() + pair.sigma;
  const Quad margin = closest_approach(pair) - Quad(pair.sigma);
  const double t = contact_time<double>(pair.r, pair.v, pair.sigma);
  const bool approaching = pair.r.cast<Quad>().dot(pair.v.cast<Quad>()) < 0;
  if (t == infinity<double>) {
    EXPECT_TRUE(!approaching || margin > Quad(-4 * u * h)) << "a hit was missed";
    return 0.0;
  }
  EXPECT_TRUE(approaching);
  EXPECT_LT(margin, Quad(4 * u * h)) << "a miss was taken for a hit";
  EXPECT_GE(t, 0.0);
  const double gap = std::abs(gap_at(pair, t));
  EXPECT_LE(gap, 16 * u * h) << "r = " << pair.r.transpose() << ", v = " << pair.v.transpose() << ", sigma = " << pair.sigma;
  return gap / (u * h);
}

/// A pair at a given distance and impact parameter (in units of sigma), seen from an arbitrary direction.
Pair aimed(double distance, double impact, double angle, double speed, double sigma) {
  const double along = std::sqrt(std::max(0.0, distance * distance - impact * impact));
  const Vec2<double> e(std::cos(angle), std::sin(angle));
  const Vec2<double> n(-e.y(), e.x());
  return {sigma * (-along * e + impact * n), speed * e, sigma};
}

TEST(ContactTime, StaysWithinItsBoundsForAnyDistanceAndImpactParameter) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int k = 0; k < 20'000; ++k) {
    const double distance = 1.0 + std::pow(10.0, -15.0 + 21.0 * unit(random));  // gaps of 1e-15 to 1e6 sigma
    const double impact = std::min(distance, 1.2 * unit(random));
    check(aimed(distance, impact, 6.28 * unit(random), std::pow(10.0, -3.0 + 6.0 * unit(random)),
                std::pow(10.0, -2.0 + 4.0 * unit(random))));
  }
}

TEST(ContactTime, StaysWithinItsBoundsForGrazingPasses) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int k = 0; k < 20'000; ++k) {
    const double impact = 1.0 + (unit(random) < 0.5 ? -1.0 : 1.0) * std::pow(10.0, -16.0 + 10.0 * unit(random));
    check(aimed(1.0 + 3.0 * unit(random), impact, 6.28 * unit(random), 1.0, 1.0));
  }
}

TEST(ContactTime, DecidesGrazingHitsWithin1e15OfSigma) {
  // On the axes the pair itself is exact, so the decision can be: only sigma^2 v^2 and (r x v)^2 are rounded.
  for (const double offset : {1e-15, 2e-15, 1e-14, 1e-10}) {
    EXPECT_EQ(contact_time<double>({-1.5, 1.0 + offset}, {1.0, 0.0}, 1.0), infinity<double>) << offset;
    EXPECT_LT(contact_time<double>({-1.5, 1.0 - offset}, {1.0, 0.0}, 1.0), 1.5) << offset;
  }
}

TEST(ContactTime, GrazingPassAtExactlySigmaTouchesOnce) { EXPECT_EQ(contact_time<double>({-4.0, 3.0}, {1.0, 0.0}, 3.0), 4.0); }

TEST(ContactTime, HeadOnApproachTakesGapOverSpeed) {
  EXPECT_EQ(contact_time<double>({3.0, 0.0}, {-0.5, 0.0}, 1.0), 4.0);
  // A gap of 2^-40 next to a diameter of 1: the textbook root would keep 12 bits of it.
  EXPECT_EQ(contact_time<double>({1.0 + 0x1p-40, 0.0}, {-1.0, 0.0}, 1.0), 0x1p-40);
}

TEST(ContactTime, TouchingIsAnEventOnlyForDisksThatApproach) {
  EXPECT_EQ(contact_time<double>({1.0, 0.0}, {-1.0, 0.3}, 1.0), 0.0);
  EXPECT_EQ(contact_time<double>({1.0, 0.0}, {1.0, 0.3}, 1.0), infinity<double>);
  EXPECT_EQ(contact_time<double>({1.0, 0.0}, {0.0, 0.3}, 1.0), infinity<double>);
  EXPECT_EQ(contact_time<double>({1.0, 0.0}, {0.0, 0.0}, 1.0), infinity<double>);
}

TEST(ContactTime, OverlappingDisksThatApproachCollideNowAndOthersNever) {
  EXPECT_EQ(contact_time<double>({0.999, 0.0}, {-1.0, 0.0}, 1.0), 0.0);
  EXPECT_EQ(contact_time<double>({0.999, 0.0}, {1.0, 0.0}, 1.0), infinity<double>);
}

TEST(ContactTime, IsTheSameBitsFromEitherDisk) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 10'000; ++k) {
    const Vec2<double> r(3 * normal(random), 3 * normal(random));
    const Vec2<double> v(normal(random), normal(random));
    EXPECT_EQ(contact_time<double>(r, v, 1.0), contact_time<double>(-r, -v, 1.0));
  }
}

RC_GTEST_PROP(PropertyContactTime, ScalingLengthsAndTimesByPowersOfTwoCommutesBitForBit, ()) {
  const auto number = [] { return *rc::gen::inRange(-1'000'000, 1'000'000) / 65536.0; };
  const Vec2<double> r(number(), number());
  const Vec2<double> v(number(), number());
  const int lengths = *rc::gen::inRange(-20, 21);
  const int times = *rc::gen::inRange(-20, 21);
  const double t = contact_time<double>(r, v, 1.0);
  const Vec2<double> scaled_r = std::ldexp(1.0, lengths) * r;
  const Vec2<double> scaled_v = std::ldexp(1.0, lengths - times) * v;
  RC_ASSERT(contact_time<double>(scaled_r, scaled_v, std::ldexp(1.0, lengths)) == std::ldexp(t, times));
}

}  // namespace
}  // namespace carom::test
