// Contact times of growing disks, and escape times, in double precision against 113 bits, within the bounds that
// core/contact_time.hpp states and docs/numerics.md derives.

#include "core/contact_time.hpp"

#include "core/unit_roundoff.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

namespace carom::test {
namespace {

struct GrowingPair {
  Vec2<double> r;
  Vec2<double> v;
  double sigma;
  double growth;
};

/// |r + v t| - sigma - growth t, exact to 113 bits.
double gap_at(const GrowingPair& pair, Quad t) {
  using std::sqrt;
  const Vec2<Quad> at = pair.r.cast<Quad>() + pair.v.cast<Quad>() * t;
  return static_cast<double>(sqrt(at.squaredNorm()) - Quad(pair.sigma) - Quad(pair.growth) * t);
}

/// |v| / sqrt(v^2 - growth^2)
double conditioning(const GrowingPair& pair) {
  const Quad square = pair.v.cast<Quad>().squaredNorm();
  const Quad a = square - Quad(pair.growth) * Quad(pair.growth);
  return a > 0 ? std::sqrt(static_cast<double>(square / a)) : 1.0;
}

/// When the gap is smallest: f = a t^2 + 2 b t + c says how |.|^2 - (.)^2 goes, and f is smallest where the gap over the contact
/// distance is, which for a grazing pass is the same place.
Quad closest(const GrowingPair& pair) {
  const Vec2<Quad> v = pair.v.cast<Quad>();
  const Quad growth(pair.growth);
  const Quad b = pair.r.cast<Quad>().dot(v) - Quad(pair.sigma) * growth;
  return -b / (v.squaredNorm() - growth * growth);
}

double scale(const GrowingPair& pair, double t) { return pair.r.norm() + pair.sigma + (pair.v.norm() + pair.growth) * t; }

void check(const GrowingPair& pair) {
  SCOPED_TRACE(::testing::Message() << "r = " << pair.r.transpose() << ", v = " << pair.v.transpose()
                                    << ", sigma = " << pair.sigma << ", growth = " << pair.growth);
  const double k = conditioning(pair);
  const double t = contact_time<double>(pair.r, pair.v, pair.sigma, pair.growth);
  if (t < infinity<double>) {
    ASSERT_GE(t, 0.0);
    EXPECT_LE(std::abs(gap_at(pair, Quad(t))), 16 * u * k * scale(pair, t));
  }
  if (pair.growth >= pair.v.norm()) return;
  const Quad turn = closest(pair);
  const double bound = 8 * u * k * scale(pair, static_cast<double>(turn));
  if (t == infinity<double>)
    EXPECT_TRUE(!(turn > 0) || gap_at(pair, turn) > -bound) << "a hit was missed";
  else
    EXPECT_TRUE(turn > 0 && gap_at(pair, turn) < bound) << "a miss was taken for a hit";
}

/// A pair at a given distance and impact parameter (in units of sigma), seen from an arbitrary direction.
GrowingPair aimed(double distance, double impact, double angle, double speed, double sigma, double growth) {
  const double along = std::sqrt(std::max(0.0, distance * distance - impact * impact));
  const Vec2<double> e(std::cos(angle), std::sin(angle));
  const Vec2<double> n(-e.y(), e.x());
  return {sigma * (-along * e + impact * n), speed * e, sigma, growth};
}

class GrowingContactTime : public ::testing::Test {
 protected:
  std::mt19937_64 random{7};
  double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(random); }
  double between(double from, double to) { return from + (to - from) * unit(); }
  double decades(double from, double to) { return std::pow(10.0, between(from, to)); }
  double coordinate() {
    const double special[] = {0.0, -0.0, 1.0, -1.0};
    return unit() < 0.2 ? special[random() % 4] : between(-3.0, 3.0);
  }
};

TEST_F(GrowingContactTime, GrowthZeroLeavesTheBitsOfDisksThatDoNotGrow) {
  for (int n = 0; n < 1'000'000; ++n) {
    const Vec2<double> r(coordinate(), coordinate());
    const Vec2<double> v(coordinate(), coordinate());
    const double sigma = n % 3 == 0 ? r.norm() + 1e-300 : between(0.1, 2.0);
    const double expected = contact_time<double>(r, v, sigma);
    ASSERT_EQ(std::bit_cast<std::uint64_t>(contact_time<double>(r, v, sigma, 0.0)), std::bit_cast<std::uint64_t>(expected));
    ASSERT_EQ(std::bit_cast<std::uint64_t>(contact_time<double>(r, v, sigma, -0.0)), std::bit_cast<std::uint64_t>(expected));
  }
}

TEST_F(GrowingContactTime, StaysWithinItsBoundsForAnyDistanceImpactParameterAndGrowth) {
  for (int n = 0; n < 40'000; ++n) {
    const double distance = 1.0 + decades(-14.0, 4.0);
    const double speed = decades(-3.0, 3.0);
    const double sigma = decades(-2.0, 2.0);
    const double growth = speed * (n % 2 == 0 ? decades(-6.0, 1.0) : 1.0 + (n % 4 == 1 ? -1.0 : 1.0) * decades(-8.0, -0.3));
    check(aimed(distance, std::min(distance, between(0.0, 3.0)), between(0.0, 6.28), speed, sigma, growth));
  }
}

TEST_F(GrowingContactTime, StaysWithinItsBoundsForGrazingPasses) {
  for (int n = 0; n < 40'000; ++n) {
    // At the moment T of a grazing pass r = (1 + growth T) n, and v has the component growth along n.
    const double growth = n % 2 == 0 ? between(0.0, 0.99) : 1.0 - decades(-6.0, -1.0);
    const double turn = between(0.0, 6.28);
    const Vec2<double> e(std::cos(turn), std::sin(turn));
    const Vec2<double> across(-e.y(), e.x());
    const Vec2<double> v = growth * e + std::sqrt((1.0 - growth) * (1.0 + growth)) * across;
    const double time = n % 3 == 0 ? decades(-3.0, 3.0) : between(0.1, 4.0);
    const double offset = double(n % 3 - 1) * decades(-17.0, -6.0);
    const GrowingPair pair{(1.0 + growth * time) * (1.0 + offset) * e - time * v, v, 1.0, growth};
    if (gap_at(pair, Quad(0)) > 0.0) check(pair);
  }
}

TEST_F(GrowingContactTime, DisksAtRestMeetWhenTheGapHasGrownShut) {
  EXPECT_EQ(contact_time<double>({3.0, 4.0}, {0.0, 0.0}, 1.0, 0.5), 8.0);
  EXPECT_EQ(contact_time<double>({3.0, 4.0}, {0.0, 0.0}, 1.0, 0.0), infinity<double>);
}

TEST_F(GrowingContactTime, RecedingDisksMeetOnlyWhereGrowthIsFaster) {
  EXPECT_EQ(contact_time<double>({3.0, 0.0}, {0.5, 0.0}, 1.0, 1.0), 4.0);
  EXPECT_EQ(contact_time<double>({3.0, 0.0}, {1.0, 0.0}, 1.0, 1.0), infinity<double>);
  EXPECT_EQ(contact_time<double>({3.0, 0.0}, {2.0, 0.0}, 1.0, 1.0), infinity<double>);
}

TEST_F(GrowingContactTime, TouchingIsAnEventOnlyWhereTheGapShrinks) {
  EXPECT_EQ(contact_time<double>({1.0, 0.0}, {0.25, 0.0}, 1.0, 0.5), 0.0);
  EXPECT_EQ(contact_time<double>({1.0, 0.0}, {0.5, 1.0}, 1.0, 0.5), infinity<double>);
  EXPECT_EQ(contact_time<double>({1.0, 0.0}, {2.0, 1.0}, 1.0, 0.5), infinity<double>);
  EXPECT_EQ(contact_time<double>({0.875, 0.0}, {0.25, 0.0}, 1.0, 0.5), 0.0);
}

TEST_F(GrowingContactTime, DisksThatPartSidewaysMeetAgainWhenGrowthCatchesUp) {
  // The gap opens at first: r.v > sigma growth. (13/16 - 1) t^2 + 2 (1.5 - 1) t + 3 = 0
  EXPECT_NEAR(contact_time<double>({2.0, 0.0}, {0.75, 0.5}, 1.0, 1.0), (1.0 + std::sqrt(1.0 + 0.75 * 3.0)) / 0.375, 1e-14);
}

TEST_F(GrowingContactTime, TouchingDisksWhoseGapOpensArePartedForGood) {
  // r.v > sigma growth at |r| <= sigma needs |v| > growth.
  for (int n = 0; n < 10'000; ++n) {
    const Vec2<double> r(coordinate(), coordinate());
    const Vec2<double> v(coordinate(), coordinate());
    const double sigma = r.norm() * (1.0 + (n % 2) * 1e-15);
    if (!(r.dot(v) > 0.0)) continue;
    ASSERT_EQ(contact_time<double>(r, v, sigma, r.dot(v) / sigma * (1.0 - 1e-14)), infinity<double>);
  }
}

RC_GTEST_PROP(PropertyGrowingContactTime, ScalingLengthsAndTimesByPowersOfTwoCommutesBitForBit, ()) {
  const auto number = [] { return *rc::gen::inRange(-1'000'000, 1'000'000) / 65536.0; };
  const Vec2<double> r(number(), number());
  const Vec2<double> v(number(), number());
  const double growth = std::abs(number());
  const int lengths = *rc::gen::inRange(-20, 21);
  const int times = *rc::gen::inRange(-20, 21);
  const double length = std::ldexp(1.0, lengths);
  const double speed = std::ldexp(1.0, lengths - times);
  const double t = contact_time<double>(r, v, 1.0, growth);
  RC_ASSERT(contact_time<double>(length * r, speed * v, length, speed * growth) == std::ldexp(t, times));
}

RC_GTEST_PROP(PropertyGrowingContactTime, FasterGrowthNeverMeetsLater, ()) {
  const auto number = [] { return *rc::gen::inRange(-1'000'000, 1'000'000) / 65536.0; };
  const Vec2<double> r(number(), number());
  const Vec2<double> v(number(), number());
  RC_PRE(r.norm() > 1.01);
  const double growth = std::abs(number());
  RC_ASSERT(contact_time<double>(r, v, 1.0, growth + 0.5) <= contact_time<double>(r, v, 1.0, growth) * (1 + 1e-9));
}

class EscapeTime : public GrowingContactTime {};

TEST_F(EscapeTime, StaysWithinItsBoundsAnywhereInside) {
  for (int n = 0; n < 40'000; ++n) {
    const double distance = n % 2 == 0 ? unit() : 1.0 - decades(-15.0, 0.0);
    const double impact = n % 3 == 0 ? distance : distance * unit();
    GrowingPair pair = aimed(distance, impact, between(0.0, 6.28), decades(-3.0, 3.0), decades(-2.0, 2.0), 0.0);
    if (random() % 2 == 0) pair.v = -pair.v;
    if (gap_at(pair, Quad(0)) > 0.0) continue;
    const double t = escape_time<double>(pair.r, pair.v, pair.sigma);
    ASSERT_GE(t, 0.0);
    ASSERT_LE(std::abs(gap_at(pair, Quad(t))), 16 * u * (pair.r.norm() + pair.sigma))
        << pair.r.transpose() << ", " << pair.v.transpose() << ", " << pair.sigma;
  }
}

TEST_F(EscapeTime, IsZeroAtOrBeyondTheEdgeForDisksThatRecede) {
  EXPECT_EQ(escape_time<double>({1.0, 0.0}, {1.0, 3.0}, 1.0), 0.0);
  EXPECT_EQ(escape_time<double>({1.5, 0.0}, {1.0, 3.0}, 1.0), 0.0);
  EXPECT_EQ(escape_time<double>({1.0, 0.0}, {0.0, 3.0}, 1.0), 0.0);
}

TEST_F(EscapeTime, CrossesTheWholeDisk) {
  EXPECT_EQ(escape_time<double>({1.0, 0.0}, {-0.5, 0.0}, 1.0), 4.0);
  EXPECT_EQ(escape_time<double>({0.0, 0.0}, {0.6, 0.8}, 3.0), 3.0);
  EXPECT_EQ(escape_time<double>({0.0, 3.0}, {0.5, 0.0}, 5.0), 8.0);
}

TEST_F(EscapeTime, IsInfiniteAtRelativeRest) { EXPECT_EQ(escape_time<double>({0.5, 0.0}, {0.0, 0.0}, 1.0), infinity<double>); }

}  // namespace
}  // namespace carom::test
