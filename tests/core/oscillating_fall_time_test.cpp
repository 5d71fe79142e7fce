// Contact times with a floor that moves up and down, in double precision against a slow twin in 113 bits, within the bounds that
// core/oscillating_fall_time.hpp states; and the sine that it stands on.

#include "core/oscillating_fall_time.hpp"

#include "core/unit_roundoff.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <boost/math/constants/constants.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>
#include <random>

namespace carom::test {
namespace {

/// A body that falls towards a floor which oscillates.
struct FallOntoOscillation {
  double h, w, a;
  OscillatingFloor<double> floor;

  [[nodiscard]] double contact(double until = infinity<double>) const {
    return oscillating_fall_time<double>(h, w, a, floor, until);
  }
  [[nodiscard]] Quad gap(Quad t) const {
    const OscillatingFloor<Quad> exact{Quad(floor.amplitude), Quad(floor.frequency), Quad(floor.phase), floor.sawtooth};
    return Quad(h) + t * (Quad(w) + Quad(a) * t / 2) - exact.height(t);
  }
  /// What is left of the gap at a contact. Within rounding of its drop a sawtooth may still be up.
  [[nodiscard]] double left_at_contact(double t) const {
    const double gap_then = std::abs(static_cast<double>(gap(Quad(t))));
    return floor.sawtooth ? std::min(gap_then, std::abs(static_cast<double>(gap(Quad(t) * Quad(1.0 - 16 * u))))) : gap_then;
  }
  /// The greatest speed at which the gap can change up to time t.
  [[nodiscard]] double fastest(double t) const { return std::abs(w) + std::abs(a) * t + floor.fastest(); }
  /// H of the header.
  [[nodiscard]] double scale(double t) const {
    return std::abs(h) + std::abs(w) * t + std::abs(a) * t * t / 2 +
           floor.amplitude * (1.0 + 2.0 * std::numbers::pi * (1.0 + floor.frequency * t));
  }
};

std::ostream& operator<<(std::ostream& out, const FallOntoOscillation& fall) {
  out.precision(17);
  return out << "h = " << fall.h << ", w = " << fall.w << ", a = " << fall.a << ", amplitude = " << fall.floor.amplitude
             << ", frequency = " << fall.floor.frequency << ", phase = " << fall.floor.phase
             << (fall.floor.sawtooth ? ", sawtooth" : ", sine");
}

/// The slow twin goes from gap to gap: the body cannot come to the floor sooner than at the greatest speed of all. It returns the
/// first time at which the gap is closed, by halving the step in which that happened; infinity where none is up to `until`.
/// `floor_of_steps` bounds the steps from below, lest it never passes a place where the two nearly touch.
Quad first_closed(const FallOntoOscillation& fall, double until, double least_step) {
  Quad t = 0;
  while (t < Quad(until)) {
    const Quad gap = fall.gap(t);
    Quad step = gap / Quad(fall.fastest(until));
    if (step < Quad(least_step)) step = Quad(least_step);
    Quad next = t + step;
    if (!(fall.gap(next) > 0)) {
      for (int k = 0; k < 120; ++k) {
        const Quad middle = t + (next - t) / 2;
        (fall.gap(middle) > 0 ? t : next) = middle;
      }
      return next;
    }
    t = next;
  }
  return infinity<Quad>;
}

class OscillatingFall : public ::testing::Test {
 protected:
  std::mt19937_64 random{17};
  double within(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); }
  double decades(double from, double to) { return std::pow(10.0, within(from, to)); }

  FallOntoOscillation draw(bool sawtooth) {
    FallOntoOscillation fall{};
    fall.floor = {decades(-3.0, 1.0), decades(-2.0, 2.0), within(0.0, 1.0), sawtooth};
    const double speed = fall.floor.fastest();
    fall.h = fall.floor.height(0.0) + fall.floor.amplitude * decades(-4.0, 2.0);
    fall.w = speed * decades(-2.0, 1.0) * (random() % 4 == 0 ? 1.0 : -1.0);
    // Weaker and stronger than the floor's own acceleration, towards it and away.
    const double strength = fall.floor.strongest() * decades(-3.0, 1.0);
    fall.a = random() % 4 == 0 ? 0.0 : random() % 3 == 0 ? strength : -strength;
    return fall;
  }
};

/// Holds a contact against the twin.
void check(const FallOntoOscillation& fall) {
  SCOPED_TRACE(::testing::Message() << fall);
  const double t = fall.contact(), period = 1.0 / fall.floor.frequency;
  const bool hit = t < infinity<double>;
  // A body that goes away is not followed for longer than it takes to be above the floor.
  const double until = hit ? t * (1.0 + 1e-9) + 1e-9 * period : 20.0 * period;
  if (hit) {
    ASSERT_GE(t, 0.0);
    ASSERT_LE(fall.left_at_contact(t), 64 * u * fall.scale(t)) << "t = " << t;
  }
  const Quad twin = first_closed(fall, until, 1e-7 * until);
  const double bound = 32 * u * fall.scale(std::min(until, 100.0 * period));
  if (twin < infinity<Quad>) {
    ASSERT_TRUE(hit) << "missed at " << twin;
    // Before the time found the gap may be closed by rounding alone.
    const double early = t - static_cast<double>(twin);
    const double rate =
        std::abs(static_cast<double>((fall.gap(twin) - fall.gap(twin - Quad(1e-10 * period))) / Quad(1e-10 * period)));
    const double bends = std::abs(fall.a) + (fall.floor.sawtooth ? 0.0 : fall.floor.strongest());
    if (std::abs(early) * rate > 8 * bound + 4 * u * t * rate) {
      ASSERT_LE(rate * rate, 8 * bound * bends) << "found at " << t << ", the first is at " << twin;
    }
  }
}

TEST_F(OscillatingFall, OnASineIsTheFirstContactOfAll) {
  for (int n = 0; n < 300; ++n) check(draw(false));
}

TEST_F(OscillatingFall, OnASawtoothIsTheFirstContactOfAll) {
  for (int n = 0; n < 300; ++n) check(draw(true));
}

TEST_F(OscillatingFall, DoesNotDependOnHowFarIsLooked) {
  for (int n = 0; n < 20'000; ++n) {
    const FallOntoOscillation fall = draw(n % 2 == 0);
    const double t = fall.contact();
    for (const double until : {0.0, 0.5 * t, t, 2.0 * t}) {
      const double found = fall.contact(until);
      ASSERT_TRUE(found == t || (found == infinity<double> && until < t)) << fall << ", until " << until;
    }
  }
}

TEST_F(OscillatingFall, ShiftedByAWholePeriodIsTheSame) {
  for (int n = 0; n < 20'000; ++n) {
    FallOntoOscillation fall = draw(n % 2 == 0);
    fall.h -= fall.floor.height(0.0);
    fall.floor.phase = static_cast<double>(random() >> 33) * 0x1p-31;  // exact with the 1 below
    fall.h += fall.floor.height(0.0);
    const double t = fall.contact();
    FallOntoOscillation shifted = fall;
    shifted.floor.phase += 1.0;
    const double other = shifted.contact();
    if (t == infinity<double>) {
      ASSERT_EQ(other, t) << fall;
    } else {
      ASSERT_LE(fall.left_at_contact(other), 64 * u * fall.scale(t)) << fall;
    }
  }
}

TEST_F(OscillatingFall, WithoutMotionOfTheBodyIsWhereTheFloorIsHighEnough) {
  // A body at rest at half the amplitude: the sine reaches it a twelfth of a period after its middle.
  const FallOntoOscillation rests{0.5, 0.0, 0.0, {1.0, 2.0, 0.0, false}};
  EXPECT_NEAR(rests.contact(), 1.0 / 24.0, 2 * u);
  // The sawtooth comes from -1 and is at 1/2 after three quarters of a period.
  const FallOntoOscillation tooth{0.5, 0.0, 0.0, {1.0, 2.0, 0.0, true}};
  EXPECT_EQ(tooth.contact(), 0.375);
  // Above the highest position nothing ever happens.
  EXPECT_EQ((FallOntoOscillation{1.5, 0.0, 0.0, {1.0, 2.0, 0.3, false}}.contact()), infinity<double>);
  EXPECT_EQ((FallOntoOscillation{1.5, 0.0, 0.0, {1.0, 2.0, 0.3, true}}.contact()), infinity<double>);
  EXPECT_EQ((FallOntoOscillation{1.5, 1.0, 0.5, {1.0, 2.0, 0.3, false}}.contact()), infinity<double>);
}

TEST_F(OscillatingFall, ComesBackToTheFloorThatItHasLeft) {
  // From contact, faster than the floor: the next contact is a later one, and the gap is open before it.
  for (int n = 0; n < 20'000; ++n) {
    const bool sawtooth = n % 2 == 0;
    FallOntoOscillation fall = draw(sawtooth);
    fall.h = fall.floor.height(0.0);
    fall.w = fall.floor.velocity(0.0) + fall.floor.fastest() * decades(-2.0, 1.0);
    fall.a = -fall.floor.strongest() * decades(-2.0, 1.0);
    const double t = fall.contact();
    ASSERT_GT(t, 0.0) << fall;
    ASSERT_LT(t, infinity<double>) << fall;
    ASSERT_LE(fall.left_at_contact(t), 64 * u * fall.scale(t)) << fall;
    for (const double part : {0.1, 0.3, 0.5, 0.7, 0.9})
      ASSERT_GT(static_cast<double>(fall.gap(Quad(part * t))), -32 * u * fall.scale(t)) << fall << " at " << part;
  }
}

TEST_F(OscillatingFall, IsFoundAtOnceHoweverFastTheFloorIs) {
  // A million million periods before the body arrives: it is met in the first in which it is low enough.
  const FallOntoOscillation far{1e3, -1.0, 0.0, {1e-3, 1e9, 0.25, false}};
  const double t = far.contact();
  EXPECT_GE(t, 1e3 - 1e-3);
  EXPECT_LE(t, 1e3 - 1e-3 + 1e-9 + 1e3 * 4 * u);
}

TEST_F(OscillatingFall, EndsHoweverSlowTheBodyIs) {
  // When such a body arrives, a period is less than the last digits of the time: the contact is where the body is as high as the
  // floor can be, within the bound of the header. A search for the period once had no end.
  for (const bool sawtooth : {false, true})
    for (const FallOntoOscillation& fall : {FallOntoOscillation{6049.0, -7.4e-11, 0.0, {5.5e-8, 292.0, 0.4, sawtooth}},
                                            FallOntoOscillation{3.0, -1e-16, 0.0, {0.5, 0.25, 0.0, sawtooth}},
                                            FallOntoOscillation{3.0, -5e-324, 0.0, {0.5, 0.25, 0.0, sawtooth}},
                                            FallOntoOscillation{4e4, -7e-12, -1e-30, {0.4, 2.7, 0.25, sawtooth}}}) {
      const double t = fall.contact();
      if (fall.w == -5e-324) {
        EXPECT_GT(t, 1e300) << fall;  // later than numbers go, perhaps
        continue;
      }
      EXPECT_LE(std::abs(static_cast<double>(fall.gap(Quad(t)))), 64 * u * fall.scale(t)) << fall;
    }
}

TEST(SineOfTurns, HasAllItsDigitsInEveryType) {
  std::mt19937_64 random(3);
  for (int n = 0; n < 20'000; ++n) {
    const double turns = std::uniform_real_distribution<double>(-2.0, 2.0)(random);
    using std::cos;
    using std::sin;
    const Quad angle = 2 * boost::math::constants::pi<Quad>() * Quad(turns);
    const auto in_double = sine_and_cosine<double>(turns);
    ASSERT_LE(abs(Quad(in_double.sine) - sin(angle)), Quad(8 * u)) << turns;
    ASSERT_LE(abs(Quad(in_double.cosine) - cos(angle)), Quad(8 * u)) << turns;
    const auto exact = sine_and_cosine<Quad>(Quad(turns));
    ASSERT_LE(abs(exact.sine - sin(angle)), 8 * epsilon<Quad>) << turns;
    ASSERT_LE(abs(exact.cosine - cos(angle)), 8 * epsilon<Quad>) << turns;
  }
  EXPECT_EQ(sine_and_cosine(0.25).sine, 1.0);
  EXPECT_EQ(sine_and_cosine(0.25).cosine, 0.0);
  EXPECT_EQ(sine_and_cosine(0.5).sine, 0.0);
  EXPECT_EQ(sine_and_cosine(-0.25).sine, -1.0);
}

}  // namespace
}  // namespace carom::test
