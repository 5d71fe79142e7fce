// The tuner of neighbourhood widths on curves of cost that are known.

#include "neighbours/neighbourhood_tuning.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

namespace carom::test {
namespace {

constexpr double step = 1.25;  // from one width tried to the next
constexpr int patience = 10;   // judgements between two doubts

/// The width at which the tuner stays for some judgements.
template <class Cost>
double settled(HalfWidthSearch& tuner, double width, const Cost& cost) {
  for (int k = 0, stayed = 0; k < 400 && stayed < patience / 2; ++k) {
    const double next = tuner.next(width, cost(width));
    stayed = next == width ? stayed + 1 : 0;
    width = next;
  }
  return width;
}

/// One minimum, at `best`; rises with the square of the way in the logarithm of the width.
double bowl(double width, double best, double depth) { return depth * (1.0 + std::pow(std::log(width / best), 2)); }

TEST(HalfWidthSearch, FindsTheBestWidthWithinAStepAndComesBackToItFromEveryDoubt) {
  for (const double best : {0.01, 0.3, 1.0, 7.0}) {
    for (const double first : {0.3 * best, 0.95 * best, best, 1.05 * best, 4.0 * best}) {
      HalfWidthSearch tuner;
      double width = first;
      width = settled(tuner, width, [&](double w) { return bowl(w, best, 5.0); });
      // It stops where a step gains less than 2 %, which in this bowl is no farther than one step from the best.
      EXPECT_LE(std::abs(std::log(width / best)), std::log(step) * 1.001) << first << " " << best;
      int away = 0;
      double now = width;
      for (int k = 0; k < 140; ++k) {
        now = tuner.next(now, bowl(now, best, 5.0));
        EXPECT_LE(std::abs(std::log(now / width)), std::log(step) * 1.001);
        away += now != width ? 1 : 0;
      }
      EXPECT_LE(away, 2 * 140 / patience) << "a trial wider and one narrower for each doubt";
    }
  }
}

TEST(HalfWidthSearch, TakesASystemThatChangesByItselfForNoGainOfItsOwn) {
  // The work falls by 5 per cent from one judgement to the next whatever the width, as in a gas that spreads.
  HalfWidthSearch tuner;
  double width = 1.0, work = 1.0;
  for (int k = 0; k < 200; ++k) width = tuner.next(width, (work *= 0.95) * bowl(width, 1.0, 1.0));
  EXPECT_LE(std::abs(std::log(width)), 2.0 * std::log(step) * 1.001);
}

TEST(NeighbourhoodTuning, JudgesAWidthAfterFourSpacingsAndFourThousandCountsAndNotBefore) {
  constexpr double half_width = 0.5, widest = 10.0, spacing = 1.0;
  NeighbourhoodTuning tuning;
  // All neighbourhoods are new: the first four half-widths of the way are not counted.
  EXPECT_EQ(tuning.next(half_width, widest, 1.9, spacing, 0), half_width);
  EXPECT_EQ(tuning.next(half_width, widest, 0.2, spacing, 0), half_width);
  for (int n = 0; n < 3999; ++n) tuning.count_left();
  EXPECT_EQ(tuning.next(half_width, widest, 5.0, spacing, 0), half_width) << "too few counts";
  tuning.count_left();
  EXPECT_EQ(tuning.next(half_width, widest, 0.0, spacing, 0), half_width * step);
  // The same anew, for the trial: the way is too short at first.
  const double trial = half_width * step;
  EXPECT_EQ(tuning.next(trial, widest, 4.0 * trial, spacing, 0), trial);
  for (int n = 0; n < 2000; ++n) tuning.count_examined(13, 9);  // of four neighbours each, two groups and one
  EXPECT_EQ(tuning.next(trial, widest, 3.9, spacing, 0), trial);
  EXPECT_EQ(tuning.next(trial, widest, 0.2, spacing, 0), half_width) << "back, to measure the first width again";
}

TEST(NeighbourhoodTuning, ChoosesWhatASearchWithTheWorkOfAllCountsChooses) {
  constexpr double widest = 1.6, path = 8.0, spacing = 1.0;
  NeighbourhoodTuning tuning;
  HalfWidthSearch search;
  double width = 1.0;
  std::uint64_t changes = 0;
  bool settling = true;
  for (int round = 0; round < 60; ++round) {
    if (settling) {
      tuning.count_left();  // which is forgotten
      EXPECT_EQ(tuning.next(width, widest, 4.0 * width, spacing, ++changes), width);
    }
    const auto left = static_cast<std::uint64_t>(4000.0 / width), gone = 3 * left,
               pairs = static_cast<std::uint64_t>(3000.0 * width);
    for (std::uint64_t n = 0; n < left; ++n) tuning.count_left();
    for (std::uint64_t n = 0; n < pairs; ++n) tuning.count_examined(13, 9);  // of four neighbours each, two groups and one
    changes += gone;
    const double expected = std::min(search.next(width, HalfWidthSearch::work(left, gone, 3 * pairs) / path), widest);
    const double next = tuning.next(width, widest, path, spacing, changes);
    ASSERT_EQ(next, expected) << round;
    settling = next != width;
    width = next;
    if (round == 30) {  // as after disks have grown
      tuning.restart();
      settling = true;
    }
  }
}

TEST(HalfWidthSearch, MovesByOneStepAtATime) {
  HalfWidthSearch tuner;
  double width = 10.0;
  for (int k = 0; k < 40; ++k) {
    const double next = tuner.next(width, bowl(width, 0.1, 1.0));
    // From above the best to below it on the way back: two steps.
    EXPECT_LE(std::abs(std::log(next / width)), 2.001 * std::log(step));
    width = next;
  }
}

TEST(HalfWidthSearch, StaysThroughNoiseOnceSettled) {
  HalfWidthSearch tuner;
  const double width = settled(tuner, 1.0, [](double w) { return bowl(w, 1.0, 1.0); });
  for (int k = 0; k < patience / 2 - 1; ++k)
    EXPECT_EQ(tuner.next(width, (1.0 + 0.1 * std::sin(k)) * bowl(width, 1.0, 1.0)), width);
}

TEST(HalfWidthSearch, StartsAgainWhereTheCostHasChanged) {
  HalfWidthSearch tuner;
  double width = settled(tuner, 1.0, [](double w) { return bowl(w, 1.0, 1.0); });
  for (const double best : {3.0, 0.2, 1.0}) {  // each at once more than a fifth dearer where it stands
    width = settled(tuner, width, [&](double w) { return bowl(w, best, 1.0); });
    EXPECT_LE(std::abs(std::log(width / best)), std::log(step) * 1.001) << best;
  }
}

TEST(HalfWidthSearch, SettlesAtABoundThatItsOwnerKeeps) {
  HalfWidthSearch tuner;
  double width = 0.5;
  for (int k = 0; k < 200; ++k) {
    width = std::min(tuner.next(width, bowl(width, 100.0, 1.0)), 2.0);  // wider would be better
    EXPECT_GT(width, 0.0);
  }
  for (int k = 0; k < 100; ++k) {  // and doubts it now and then
    width = std::min(tuner.next(width, bowl(width, 100.0, 1.0)), 2.0);
    EXPECT_GE(width, 2.0 / step / step * 0.999);
  }
}

TEST(HalfWidthSearch, SettlesWhereNothingCostsAnything) {
  HalfWidthSearch tuner;
  double width = 1.0;
  EXPECT_EQ(settled(tuner, width, [](double) { return 0.0; }), 1.0);
}

RC_GTEST_PROP(PropertyHalfWidthSearch, ItsWidthsArePositiveAndFiniteWhateverTheyCost, ()) {
  HalfWidthSearch tuner;
  double width = std::pow(10.0, *rc::gen::inRange(-6, 7));
  const double first = width;
  for (int k = 0; k < 100; ++k) {
    width = tuner.next(width, *rc::gen::inRange(0, 1'000'000) * 1e-3);
    RC_ASSERT(width > 0.0 && std::isfinite(width));
    // At most one step farther than the cheapest yet for each try.
    RC_ASSERT(std::abs(std::log(width / first)) <= (k + 2) * std::log(step));
  }
}

TEST(HalfWidthSearch, FirstWidthsArePositiveForAnyDensity) {
  double last = 0.0;
  for (const double area : {1e-3, 0.5, 0.87, 1.0, 2.0, 10.0, 1e6}) {  // per disk of diameter 1; below 0.87 they do not fit
    const double width = HalfWidthSearch::first_half_width(1.0, area);
    EXPECT_GE(width, last) << "more room, wider neighbourhoods";
    EXPECT_GT(width, 0.0);
    EXPECT_NEAR(HalfWidthSearch::first_half_width(1e-3, area * 1e-6), 1e-3 * width, 1e-15) << "lengths scale";
    last = width;
  }
}

TEST(HalfWidthSearch, FirstWidthsGiveEightPlacesOfAListToTheDisksOfAGas) {
  // The formula itself: neighbourhoods come within contact over 16 h^2 + 16 h sigma + pi sigma^2, eight times the area per disk.
  for (const double area : {1.2, 2.0, 10.0, 1e6}) {
    const double h = HalfWidthSearch::first_half_width(1.0, area);
    EXPECT_NEAR((16.0 * h * h + 16.0 * h + 3.14159) / area, 8.0, 1e-9);
  }
}

}  // namespace
}  // namespace carom::test
