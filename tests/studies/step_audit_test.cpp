// What the audit calls found, missed, repeated and spurious: pairs made by hand, in closed form, and isolated pairs of a gas,
// advanced by the methods themselves, against the derivation of theory/fixed_step.hpp.

#include "studies/step_audit.hpp"

#include "support/scenes.hpp"
#include "support/systems.hpp"
#include "theory/fixed_step.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace carom::test {
namespace {

/// Two disks of diameter 1 under audit with dt = 1, the first at rest at the origin at the beginning.
class Audit : public ::testing::Test {
 protected:
  struct Disk {
    Eigen::Vector2d r;
    Eigen::Vector2d v;
  };

  static State state_of(const Disk& a, const Disk& b) {
    State state;
    state.positions.resize(2, 2);
    state.velocities.resize(2, 2);
    state.positions << a.r, b.r;
    state.velocities << a.v, b.v;
    return state;
  }

  /// A reversal after which the disks have the velocities of the state.
  static Event reversal(const Disk& a, const Disk& b) { return {0.0, 0.0, 0, 1, a.v, b.v}; }

  void quiet_step(const Disk& a, const Disk& b) { audit_.step(state_of(a, b), {}); }
  void quiet_step(const Disk& b) { quiet_step(rest_, b); }
  void step_with_reversal(const Disk& a, const Disk& b) { audit_.step(state_of(a, b), std::vector{reversal(a, b)}); }

  void expect_counts(std::uint64_t found, std::uint64_t missed, std::uint64_t repeated, std::uint64_t spurious) {
    EXPECT_EQ(audit_.counts().found, found);
    EXPECT_EQ(audit_.counts().missed, missed);
    EXPECT_EQ(audit_.counts().repeated, repeated);
    EXPECT_EQ(audit_.counts().spurious, spurious);
  }

  const Disk rest_{{0.0, 0.0}, {0.0, 0.0}};
  Box box_{{-8.0, -8.0}, {8.0, 8.0}, {Boundary::walls, Boundary::periodic}};
  Disks disks_{{0.5, 0.5}, {1.0, 1.0}, {0, 0}};
  StepAudit audit_{box_, disks_, 1.0};
};

TEST_F(Audit, APairThatIsTurnedRoundWhileItApproachesIsFound) {
  quiet_step({{1.25, 0.0}, {-0.5, 0.0}});
  step_with_reversal({{0.0, 0.0}, {-0.5, 0.0}}, {{0.75, 0.0}, {0.0, 0.0}});
  quiet_step({{-0.5, 0.0}, {-0.5, 0.0}}, {{0.75, 0.0}, {0.0, 0.0}});
  quiet_step({{-1.0, 0.0}, {-0.5, 0.0}}, {{0.75, 0.0}, {0.0, 0.0}});
  expect_counts(1, 0, 0, 0);
  EXPECT_EQ(audit_.counts().mean_depth(), 0.25);
  EXPECT_EQ(audit_.counts().deepest, 0.25);
  EXPECT_EQ(audit_.counts().steps, 4U);
  EXPECT_EQ(audit_.counts().time, 4.0);
}

TEST_F(Audit, APairThatFliesThroughBetweenTwoStepsIsMissed) {
  quiet_step({{1.25, 0.0}, {-3.0, 0.0}});
  quiet_step({{-1.75, 0.0}, {-3.0, 0.0}});
  expect_counts(0, 1, 0, 0);
  EXPECT_EQ(audit_.counts().deepest, 0.0);  // at a step it never was
}

TEST_F(Audit, APairThatPassesBesideOrTurnsBackIsNotMissed) {
  quiet_step({{1.25, 1.0}, {-3.0, 0.0}});  // the closest approach is sigma itself
  quiet_step({{-1.75, 1.0}, {-3.0, 0.0}});
  quiet_step({{1.25, 0.0}, {3.0, 0.0}});   // parts
  quiet_step({{4.25, 0.0}, {-3.0, 0.0}});  // is too far to meet within a step
  expect_counts(0, 0, 0, 0);
}

TEST_F(Audit, APairThatIsInContactAtAStepOnlyWhileItPartsIsMissed) {
  quiet_step({{1.25, 0.5}, {-2.0, 0.0}});
  quiet_step({{-0.75, 0.5}, {-2.0, 0.0}});  // in contact, beyond the closest approach
  expect_counts(0, 0, 0, 0);                // something may turn it back yet
  quiet_step({{-2.75, 0.5}, {-2.0, 0.0}});
  quiet_step({{-4.75, 0.5}, {-2.0, 0.0}});
  expect_counts(0, 1, 0, 0);
  EXPECT_EQ(audit_.counts().deepest, 1.0 - std::sqrt(0.8125));
}

TEST_F(Audit, APairThatStaysInContactWhileItPartsIsMissedOnce) {
  quiet_step({{1.25, 0.0}, {-1.5, 0.0}});
  for (int k = 1; k < 4; ++k) quiet_step({{-0.25 * k, 0.0}, {-0.25, 0.0}});  // a third disk has slowed it
  expect_counts(0, 0, 0, 0);
  for (int k = 4; k < 8; ++k) quiet_step({{-0.25 * k, 0.0}, {-0.25, 0.0}});
  expect_counts(0, 1, 0, 0);
}

TEST_F(Audit, APartingPairThatIsSentBackIsSpuriousAndNotMissed) {
  quiet_step({{1.25, 0.5}, {-2.0, 0.0}});
  step_with_reversal({{0.0, 0.0}, {-2.0, 0.0}}, {{-0.75, 0.5}, {0.0, 0.0}});
  quiet_step({{-2.0, 0.0}, {-2.0, 0.0}}, {{-0.75, 0.5}, {0.0, 0.0}});
  expect_counts(0, 0, 0, 1);
  EXPECT_EQ(audit_.counts().mean_depth(), 0.0);  // of what was found
}

TEST_F(Audit, APartingPairThatIsSentBackAStepLaterIsSpuriousAndNotMissed) {
  quiet_step({{0.25, 0.0}, {0.25, 0.0}});
  step_with_reversal({{0.0, 0.0}, {0.25, 0.0}}, {{0.5, 0.0}, {0.0, 0.0}});
  for (int k = 1; k < 8; ++k) quiet_step({{0.25 * k, 0.0}, {0.25, 0.0}}, {{0.5, 0.0}, {0.0, 0.0}});  // through each other
  expect_counts(0, 0, 0, 1);
}

TEST_F(Audit, ReversalsBeforeThePairIsApartAgainAreRepeats) {
  quiet_step({{1.25, 0.0}, {-0.75, 0.0}});
  step_with_reversal({{0.0, 0.0}, {-0.25, 0.0}}, {{0.5, 0.0}, {0.0, 0.0}});
  step_with_reversal({{-0.25, 0.0}, {0.0, 0.0}}, {{0.5, 0.0}, {-0.25, 0.0}});
  step_with_reversal({{-0.25, 0.0}, {-0.25, 0.0}}, {{0.25, 0.0}, {0.0, 0.0}});
  expect_counts(1, 0, 2, 0);
  EXPECT_EQ(audit_.counts().mean_depth(), 0.5);  // at the first of them
  EXPECT_EQ(audit_.counts().repeated_fraction(), 2.0 / 3.0);
}

TEST_F(Audit, TwoReversalsInOneStepAreOneFoundAndOneRepeated) {
  quiet_step({{1.25, 0.0}, {-0.75, 0.0}});
  const Disk a{{0.0, 0.0}, {0.0, 0.0}}, b{{0.5, 0.0}, {-0.75, 0.0}};
  audit_.step(state_of(a, b), std::vector{reversal({a.r, b.v}, {b.r, a.v}), reversal(a, b)});
  expect_counts(1, 0, 1, 0);
}

TEST_F(Audit, APairThatHasBeenApartAndQuietForAStepIsANewEncounter) {
  step_with_reversal({{0.0, 0.0}, {-1.0, 0.0}}, {{0.75, 0.0}, {0.0, 0.0}});
  quiet_step({{-1.0, 0.0}, {-1.0, 0.0}}, {{0.75, 0.0}, {0.0, 0.0}});
  quiet_step({{-2.0, 0.0}, {2.0, 0.0}}, {{0.75, 0.0}, {0.0, 0.0}});  // a third disk sends it back
  step_with_reversal({{0.0, 0.0}, {0.0, 0.0}}, {{0.75, 0.0}, {2.0, 0.0}});
  expect_counts(2, 0, 0, 0);
}

TEST_F(Audit, WallsAreNoPairs) {
  audit_.step(state_of(rest_, {{4.0, 0.0}, {1.0, 0.0}}), std::vector{Event{0.0, 0.0, 1, wall_right, {1.0, 0.0}, {0.0, 0.0}}});
  expect_counts(0, 0, 0, 0);
}

TEST_F(Audit, PairsMeetAcrossAPeriodicEdgeAndNotAcrossAWall) {
  quiet_step({{0.0, -7.75}, {0.0, 0.0}}, {{0.0, 7.0}, {0.0, 3.0}});  // 1.25 apart round the edge, and through
  quiet_step({{0.0, -7.75}, {0.0, 0.0}}, {{0.0, -6.0}, {0.0, 3.0}});
  expect_counts(0, 1, 0, 0);
  quiet_step({{0.0, -7.75}, {0.0, 0.0}}, {{0.0, 7.75}, {0.0, 0.0}});
  EXPECT_EQ(audit_.counts().deepest, 0.5);
  quiet_step({{-7.75, 0.0}, {0.0, 0.0}}, {{7.0, 0.0}, {3.0, 0.0}});
  expect_counts(0, 2, 0, 0);  // the pair at the edge has left it; through the wall no disk is missed
}

TEST_F(Audit, FractionsOfNothingAreZero) {
  EXPECT_EQ(audit_.counts().missed_fraction(), 0.0);
  EXPECT_EQ(audit_.counts().repeated_fraction(), 0.0);
  EXPECT_EQ(audit_.counts().spurious_fraction(), 0.0);
  EXPECT_EQ(audit_.counts().mean_depth(), 0.0);
}

/// Disks one by one in a box of walls wide enough that none is reached.
Scene scene_with(const std::vector<Placed>& placed) {
  Scene scene = scene_of({{-1e3, -1e3}, {1e3, 1e3}, {Boundary::walls, Boundary::walls}}, {});
  for (const Placed& disk : placed)
    scene.species.push_back(species_of(1, disk.radius, disk.mass, ListedPositions{{disk.r}}, ListedVelocities{{disk.v}}));
  return scene;
}

StepCounts audit_of(const std::vector<Placed>& placed, const FixedStep& method, double time,
                    CollisionRule rule = CollisionRule::specular, double pair_limit = 1e9,
                    const std::function<bool()>& proceed = {}) {
  Scene scene = scene_with(placed);
  scene.effects.collision.rule = rule;
  return audit(scene, system_of(scene.box, placed).state, method, time, pair_limit, proceed);
}

TEST(AuditOfAMethod, ALockedPairIsFoundOnceAndThenRepeatedInEveryStep) {
  // Disk 0 follows at 1, disk 1 flees at 0.5; naive steps lock them, with one reversal in each (naive_test.cpp).
  const std::vector<Placed> pair = {{{-6.0, 0.0}, {1.0, 0.0}}, {{-4.96875, 0.0}, {0.5, 0.0}}};
  const StepCounts counts = audit_of(pair, {"naive", 0.125}, 99 * 0.125, CollisionRule::reversal);
  EXPECT_EQ(counts.steps, 100U);
  EXPECT_EQ(counts.found, 1U);
  EXPECT_EQ(counts.repeated, 99U);
  EXPECT_EQ(counts.missed + counts.spurious, 0U);
  EXPECT_EQ(counts.mean_depth(), 0.0);  // they never were in contact
}

TEST(AuditOfAMethod, CoversAllStepsUntilTheTimeAndAtZero) {
  const std::vector<Placed> pair = {{{0.0, 0.0}, {0.0, 0.0}}, {{5.0, 0.0}, {0.0, 0.0}}};
  EXPECT_EQ(audit_of(pair, {"guarded", 0.25}, 2.0).steps, 9U);
  EXPECT_EQ(audit_of(pair, {"guarded", 0.25}, 2.0).time, 9 * 0.25);
  EXPECT_EQ(audit_of(pair, {"guarded", 0.25}, 0.0).steps, 1U);
  EXPECT_EQ(audit_of(pair, {"guarded", 0.25}, 2.0, CollisionRule::specular, 6.0).steps, 3U);  // 2 * 2 / 2 pairs a step
  EXPECT_EQ(audit_of(pair, {"guarded", 0.25}, 2.0, CollisionRule::specular, 0.0).steps, 1U);
  EXPECT_EQ(audit_of(pair, {"guarded", 0.25}, 2.0, CollisionRule::specular, 1e9, [] { return false; }).steps, 0U);
}

/// Isolated pairs as they meet in a dilute gas, each from a time of random phase before its contact, one after the other.
class PhysicsIsolatedPair : public ::testing::TestWithParam<double> {
 protected:
  static constexpr int trials = 40'000;

  struct Outcome {
    int missed = 0;
    std::vector<double> depths;  ///< of those that were found
  };

  static Outcome outcome_of(const std::string& method) {
    const double step = GetParam();  // sigma = v_T = 1, so it is dt
    const Scene scene = scene_with({{{0.0, 0.0}, {0.0, 0.0}}, {{5.0, 0.0}, {0.0, 0.0}}});
    std::mt19937_64 bits(20260101);
    std::uniform_real_distribution<double> even;
    std::normal_distribution<double> normal;
    Outcome outcome;
    for (int trial = 0; trial < trials; ++trial) {
      // g^2 exp(-g^2 / 4) is the length of a vector of three normal components, times sqrt(2).
      const double g = std::sqrt(2.0) * std::hypot(normal(bits), normal(bits), normal(bits));
      const double b = even(bits), c = std::sqrt(1.0 - b * b), until_contact = even(bits) * step;
      const State start = system_of(scene.box, {{{0.0, 0.0}, {0.0, 0.0}}, {{c + g * until_contact, b}, {-g, 0.0}}}).state;
      // The first step after contact is the only one that can find it: a disk that approaches no longer then is apart one step
      // later.
      const StepCounts counts = audit(scene, start, {method, step}, 3.0 * step, 1e9, {});
      EXPECT_EQ(counts.found + counts.spurious + counts.missed, 1U) << "g = " << g << ", b = " << b;
      if (counts.missed > 0) ++outcome.missed;
      if (counts.found > 0) outcome.depths.push_back(counts.mean_depth());
    }
    return outcome;
  }

  /// Within 5 standard errors of a binomial share.
  static void expect_missed(const Outcome& outcome, double p) {
    EXPECT_NEAR(outcome.missed / double{trials}, p, 5.0 * std::sqrt(p * (1.0 - p) / trials));
  }

  /// Within 5 standard errors of the sample's mean.
  static void expect_depth(const Outcome& outcome, double expected) {
    const auto n = static_cast<double>(outcome.depths.size());
    double mean = 0.0, squares = 0.0;
    for (const double depth : outcome.depths) mean += depth / n;
    for (const double depth : outcome.depths) squares += (depth - mean) * (depth - mean);
    EXPECT_NEAR(mean, expected, 5.0 * std::sqrt(squares / (n - 1.0) / n));
  }
};

TEST_P(PhysicsIsolatedPair, GuardedStepsMissAndFindItAsDerived) {
  const Outcome outcome = outcome_of("guarded");
  expect_missed(outcome, theory::missed_fraction(GetParam(), theory::Detects::approaching));
  expect_depth(outcome, theory::mean_depth(GetParam()));
}

TEST_P(PhysicsIsolatedPair, GridStepsDoWhatGuardedOnesDo) {
  const Outcome grid = outcome_of("grid"), guarded = outcome_of("guarded");
  EXPECT_EQ(grid.missed, guarded.missed);
  EXPECT_EQ(grid.depths, guarded.depths);
}

TEST_P(PhysicsIsolatedPair, NaiveStepsMissOnlyWhatIsNeverInContactAtAStep) {
  const Outcome outcome = outcome_of("naive-edge");
  expect_missed(outcome, theory::missed_fraction(GetParam(), theory::Detects::contact));
  expect_depth(outcome, theory::mean_depth(GetParam()));  // what it sends back while parting is not among the found
}

TEST_P(PhysicsIsolatedPair, BacktrackStepsMissOnlyWhatIsNeverInContactAtAStepAndTurnTheRestAtContact) {
  const Outcome outcome = outcome_of("backtrack");
  expect_missed(outcome, theory::missed_fraction(GetParam(), theory::Detects::contact));
  for (const double depth : outcome.depths) ASSERT_LT(depth, 1e-12);
}

TEST_P(PhysicsIsolatedPair, SweptStepsMissNoneAndTurnAllAtContact) {
  const Outcome outcome = outcome_of("swept");
  EXPECT_EQ(outcome.missed, 0);
  EXPECT_EQ(outcome.depths.size(), std::size_t{trials});
  for (const double depth : outcome.depths) ASSERT_LT(depth, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Steps, PhysicsIsolatedPair, ::testing::Values(0.1, 0.3, 1.0, 4.0), [](const auto& tested) {
  return "Step" + std::to_string(static_cast<int>(10.0 * tested.param)) + "Tenths";
});

}  // namespace
}  // namespace carom::test
