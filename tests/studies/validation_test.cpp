// carom validate from the inside: verdicts, and what is kept in files. The trials themselves are run by the physics tests.

#include "studies/validate/validation.hpp"

#include "studies/validate/files.hpp"
#include "studies/validate/gas.hpp"
#include "studies/validate/speed_law.hpp"
#include "support/child_process.hpp"
#include "support/refusal.hpp"
#include "support/scenes.hpp"
#include "theory/goodness_of_fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <mutex>
#include <numbers>
#include <random>
#include <set>
#include <thread>

namespace carom::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Check check(double expected, double measured, double error, double allowance = 0.0, Judged judged = Judged::agrees) {
  return {.name = "a number",
          .theory = "one",
          .source = "us",
          .expected = expected,
          .measured = {measured, error},
          .allowance = allowance,
          .allowance_for = allowance > 0.0 ? "a reason" : "",
          .judged = judged};
}

TEST(ValidationCheck, HoldsWithinFiveStandardErrorsBeyondTheAllowance) {
  EXPECT_TRUE(check(1.0, 1.49, 0.1).holds());
  EXPECT_FALSE(check(1.0, 1.51, 0.1).holds());
  EXPECT_FALSE(check(1.0, 0.49, 0.1).holds());
  EXPECT_TRUE(check(1.0, 1.69, 0.1, 0.2).holds());
  EXPECT_FALSE(check(1.0, 1.71, 0.1, 0.2).holds());
  EXPECT_NEAR(check(1.0, 0.5, 0.1, 0.2).deviation(), -3.0, 1e-12);
  EXPECT_EQ(check(1.0, 1.1, 0.1, 0.2).deviation(), 0.0);
}

TEST(ValidationCheck, FailsWithAnErrorTooLargeForItsClaim) {
  Check wide = check(1.0, 1.01, 0.02);
  EXPECT_TRUE(wide.holds());
  wide.largest_error = 0.01;
  EXPECT_FALSE(wide.holds());
  EXPECT_EQ(row_of(wide).verdict, "TOO UNCERTAIN");
  wide.measured.error = 0.01;
  EXPECT_TRUE(wide.holds());
  wide.measured.error = nan;
  EXPECT_FALSE(wide.holds());
}

TEST(ValidationCheck, WithoutAnErrorOnlyTheAllowanceCounts) {
  EXPECT_TRUE(check(1.0, 1.0, 0.0).holds());
  EXPECT_FALSE(check(1.0, 1.0 + 1e-15, 0.0).holds());
  EXPECT_TRUE(check(1.0, 1.0 + 1e-15, 0.0, 1e-12).holds());
}

TEST(ValidationCheck, WhatIsNoNumberNeverAgrees) {
  EXPECT_FALSE(check(1.0, nan, 0.1).holds());
  EXPECT_FALSE(check(1.0, 1.0, nan).holds());
  EXPECT_FALSE(check(nan, 1.0, 0.1, 1e9).holds());
}

TEST(ValidationCheck, ANegativeControlMustNotFit) {
  EXPECT_TRUE(check(1.0, 2.0, 0.1, 0.0, Judged::disagrees).holds());
  EXPECT_FALSE(check(1.0, 1.1, 0.1, 0.0, Judged::disagrees).holds());
  EXPECT_EQ(row_of(check(1.0, 1.1, 0.1, 0.0, Judged::disagrees)).verdict, "FITS, and must not");
}

TEST(ValidationCheck, WhatIsShownNeverFails) {
  EXPECT_TRUE(check(1.0, 2.0, 0.1, 0.0, Judged::shown).holds());
  EXPECT_EQ(row_of(check(1.0, 2.0, 0.1, 0.0, Judged::shown)).verdict, "differs (not judged)");
  EXPECT_EQ(row_of(check(1.0, 1.1, 0.1, 0.0, Judged::shown)).verdict, "consistent (not judged)");
}

TEST(ValidationCheck, ZKnowsNoAllowance) {
  EXPECT_NEAR(check(1.0, 1.3, 0.1, 1.0).z(), 3.0, 1e-12);
  EXPECT_EQ(check(1.0, 1.3, 0.1, 1.0).deviation(), 0.0);
  EXPECT_TRUE(std::isinf(check(1.0, nan, 0.1, 1.0).z()));
  Check statistic = check(0.0, 9.0, 0.0);
  statistic.equivalent = 1.5;
  EXPECT_EQ(statistic.z(), 1.5);
}

TEST(ValidationCheck, TheErrorOfAReferenceCountsLikeThatOfTheMeasurement) {
  Check both = check(1.0, 1.5, 0.3);
  both.reference_error = 0.4;
  EXPECT_NEAR(both.z(), 1.0, 1e-12);
  EXPECT_NEAR(both.deviation(), 1.0, 1e-12);
}

TEST(ValidationCheck, OnlyNormalStatisticsAgainstExactTheoryCalibrate) {
  EXPECT_TRUE(check(1.0, 1.1, 0.1).calibrates());
  EXPECT_TRUE(check(1.0, 1.1, 0.1, 0.01).calibrates());
  EXPECT_FALSE(check(1.0, 1.1, 0.1, 0.03).calibrates());
  EXPECT_FALSE(check(1.0, 1.1, 0.0).calibrates());
  Check bound = check(1.0, 1.1, 0.1);
  bound.error_is_bound = true;
  EXPECT_FALSE(bound.calibrates());
  EXPECT_FALSE(check(1.0, 1.1, 0.1, 0.0, Judged::disagrees).calibrates());
  EXPECT_FALSE(check(1.0, 1.1, 0.1, 0.0, Judged::shown).calibrates());
  Check statistic = check(0.0, 9.0, 1.0);
  statistic.equivalent = 1.5;
  EXPECT_FALSE(statistic.calibrates());
}

TEST(ValidationCheck, SentencesSayWhatCanBeConcluded) {
  EXPECT_EQ(sentence_of(check(2.0, 2.2, 0.1)), "a number: 2.20 ± 0.10, expected 2.00; z = +2.0 (+10 %)");
  EXPECT_EQ(sentence_of(check(2.0, 2.2, 0.1, 0.15)),
            "a number: 2.20 ± 0.10, expected 2.00; z = +2.0 (+10 %), +0.5 beyond the allowance of 0.15");
  EXPECT_EQ(sentence_of(check(0.0, 0.0, 0.0)), "a number: 0, expected 0; exactly equal");
  EXPECT_EQ(sentence_of(check(0.0, 0.25, 0.0, 1e-12)), "a number: 0.25, expected 0; not equal, beyond the allowance of 1e-12");
  EXPECT_EQ(sentence_of(check(1.0, 1.0 + 1e-14, 0.0, 1e-12)),
            "a number: 1, expected 1; not equal (+1e-12 %), within the allowance of 1e-12");
  EXPECT_EQ(sentence_of(check(1.0, nan, 0.1)), "a number: no number, expected 1.00; z = unknown");
  Check measured_reference = check(2.0, 2.2, 0.03);
  measured_reference.reference_error = 0.04;
  EXPECT_EQ(sentence_of(measured_reference), "a number: 2.200 ± 0.030, expected 2.000 ± 0.040; z = +4.0 (+10 %)");
  Check statistic = check(0.0, 0.8, 0.0);
  statistic.equivalent = 1.25;
  EXPECT_EQ(sentence_of(statistic), "a number: 0.8, theory: one; z = +1.2");
}

TEST(ValidationCheck, RowsHaveAsManyDigitsAsTheErrorTells) {
  const CheckRow row = row_of(check(2.0602345, 2.0599123, 0.00097, 0.0021));
  EXPECT_EQ(row.measured, "2.05991 ± 0.00097");
  EXPECT_EQ(row.expected, "2.06023");
  EXPECT_EQ(row.z, "-0.3");
  EXPECT_EQ(row.per_cent, "-0.016 %");
  EXPECT_EQ(row.beyond, "+0.0");
  EXPECT_EQ(row.allowance, "0.0021: a reason");
}

TEST(ValidationMean, IsThatOfTheValuesWithItsStandardError) {
  const Measured mean = validation::mean_of({1.0, 2.0, 3.0, 6.0});
  EXPECT_EQ(mean.value, 3.0);
  EXPECT_NEAR(mean.error, std::sqrt(14.0 / 12.0), 1e-15);
}

TEST(ValidationTrials, HaveNamesOfTheirOwnAndCoverEveryGroup) {
  std::set<std::string> names, groups;
  for (const validation::Trial& trial : validation::all_trials()) {
    EXPECT_TRUE(names.insert(trial.name).second) << trial.name;
    groups.insert(trial.group);
  }
  EXPECT_EQ(groups.size(), 10U);
}

TEST(ValidationTrials, OfAQuickValidationAreThoseThatAreNotForTheFullOneAlone) {
  const auto quick = chosen_trials({}), full = chosen_trials({.full = true});
  EXPECT_LT(quick.size(), full.size());
  EXPECT_EQ(full.size(), validation::all_trials().size());
  EXPECT_EQ(chosen_trials({.only = {"transition-0.708"}}).size(), 1U) << "one that is named runs in any case";
  EXPECT_EQ(chosen_trials({.only = {"equation-of-state"}}).size(), chosen_trials({.only = {"equation of state"}}).size());
  EXPECT_THROW((void)chosen_trials({.only = {"no-such"}}), std::invalid_argument);
}

TEST(ValidationStart, ACompressedLiquidFillsItsBoxWithoutOverlap) {
  constexpr std::int64_t disks = 64;
  constexpr double eta = 0.7;
  const State state = validation::compressed_liquid(disks, eta, {}, 3);
  ASSERT_EQ(state.positions.cols(), disks);
  const double side = std::sqrt(std::numbers::pi * disks / (4.0 * eta));
  const double nearest = smallest_distance(box_of(side, side, Boundary::periodic), state.positions);
  EXPECT_GE(nearest, 1.0 - 1e-12);
  EXPECT_LT(nearest, 1.01) << "at this density some pair is about to touch";
  EXPECT_NEAR(state.velocities.rowwise().sum().norm(), 0.0, 1e-10);
}

/// Speeds of snapshots with fixed energy, drawn by hand.
validation::SpeedCounts drawn(int disks, int snapshots, bool equally_fast) {
  std::mt19937_64 bits(5);
  std::normal_distribution<double> gauss;
  validation::SpeedCounts counts(theory::Microcanonical(disks, true));
  for (int k = 0; k < snapshots; ++k) {
    Eigen::Matrix2Xd v(2, disks);
    for (Eigen::Index i = 0; i < disks; ++i) {
      v.col(i) = Eigen::Vector2d(gauss(bits), gauss(bits));
      if (equally_fast) v.col(i).normalize();
    }
    v.colwise() -= v.rowwise().mean().eval();
    counts.add(v);
  }
  return counts;
}

TEST(ValidationSpeeds, OfTheLawFitAndOthersDoNot) {
  EXPECT_TRUE(speed_check("drawn", drawn(64, 1000, false)).fits());
  EXPECT_FALSE(speed_check("drawn", drawn(64, 100, true)).fits());
}

TEST(ValidationSpeeds, DistanceIsThatOfTheSortedSpeedsUpToABin) {
  const auto counts = drawn(64, 30, true);
  std::mt19937_64 bits(5);
  std::normal_distribution<double> gauss;
  const theory::Microcanonical law(64, true);
  std::vector<double> shares;
  for (int k = 0; k < 30; ++k) {
    Eigen::Matrix2Xd v(2, 64);
    for (Eigen::Index i = 0; i < 64; ++i) v.col(i) = Eigen::Vector2d(gauss(bits), gauss(bits)).normalized();
    v.colwise() -= v.rowwise().mean().eval();
    const Eigen::VectorXd squares = v.colwise().squaredNorm().transpose();
    for (const double square : squares) shares.push_back(law.speeds_below(square / squares.mean()));
  }
  std::sort(shares.begin(), shares.end());
  const auto n = static_cast<double>(shares.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < shares.size(); ++i)
    largest = std::max(
        {largest, std::abs(shares[i] - static_cast<double>(i) / n), std::abs(static_cast<double>(i + 1) / n - shares[i])});
  EXPECT_NEAR(counts.distance(), largest * std::sqrt(n), 2.0 * std::sqrt(n) / (1 << 20));
}

TrialResult awkward_result() {
  TrialResult result{.trial = "awkward", .scenes = {"[box]\n\"quoted\" = 1\n"}, .seconds = 0.1 + 0.2};
  result.checks = {check(1.0 / 3.0, 0.1, 5e-324), check(0.0, nan, nan, 0.5, Judged::disagrees),
                   check(1e300, 2.0, 0.0, 0.0, Judged::shown)};
  result.checks[1].equivalent = 3.25;
  result.checks[0].reference_error = 0.1;
  result.checks[0].measured.freedom = 7.0;
  result.checks[2].error_is_bound = true;
  result.curves = {{.plot = "p", .name = "measured | by us", .x = {1.0, nan}, .y = {2.0, -0.0}, .error = {}},
                   {.plot = "p", .name = "theory", .theory = true, .x = {0.1}, .y = {0.2}, .error = {0.3}}};
  return result;
}

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

TEST(ValidationFiles, GiveBackWhatWasWritten) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "trials.jsonl";
  TrialsFile file(path, "key", {});
  file.add(awkward_result());
  const Validation read = load_trials(path, "key");
  ASSERT_EQ(read.results.size(), 1U);
  const TrialResult &result = read.results[0], wanted = awkward_result();
  EXPECT_EQ(result.trial, wanted.trial);
  EXPECT_EQ(result.seconds, wanted.seconds);
  EXPECT_EQ(result.scenes, wanted.scenes);
  ASSERT_EQ(result.checks.size(), wanted.checks.size());
  for (std::size_t k = 0; k < wanted.checks.size(); ++k) {
    const Check &a = result.checks[k], &b = wanted.checks[k];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.judged, b.judged);
    EXPECT_EQ(a.equivalent, b.equivalent);
    EXPECT_EQ(a.allowance_for, b.allowance_for);
    EXPECT_EQ(a.reference_error, b.reference_error);
    EXPECT_EQ(a.error_is_bound, b.error_is_bound);
    EXPECT_EQ(a.measured.freedom, b.measured.freedom);
    EXPECT_TRUE(same(a.expected, b.expected) && same(a.measured.value, b.measured.value) &&
                same(a.measured.error, b.measured.error) && same(a.allowance, b.allowance));
    EXPECT_EQ(a.holds(), b.holds());
  }
  ASSERT_EQ(result.curves.size(), 2U);
  EXPECT_EQ(result.curves[0].name, "measured | by us");
  EXPECT_TRUE(std::isnan(result.curves[0].x[1]));
  EXPECT_TRUE(result.curves[1].theory);
  EXPECT_EQ(result.curves[1].error, std::vector<double>{0.3});
}

TEST(ValidationFiles, LeaveOutALineThatWasNotFinishedAndRefuseWhatIsNotTheirs) {
  const TemporaryDirectory directory;
  const auto path = directory.path() / "trials.jsonl";
  { TrialsFile(path, "key", {}).add(awkward_result()); }
  std::ofstream(path, std::ios::app) << "{\"trial\": \"half";
  EXPECT_EQ(load_trials(path, "key").results.size(), 1U);
  EXPECT_THROW((void)load_trials(path, "other"), OutputError);
  std::ofstream(path, std::ios::app) << "\n{\"trial\": 3}\n";
  EXPECT_THAT(refusal<OutputError>([&] { return load_trials(path, "key"); }), HasSubstr("trials.jsonl:4: this is no trial"));
  EXPECT_THROW((void)load_trials(directory.path() / "none", "key"), OutputError);
}

TEST(ValidationFiles, KeyTellsSeedsAndModesApart) {
  std::set<std::string> keys = {validation_key({}), validation_key({.full = true}), validation_key({.seed = 2})};
  EXPECT_EQ(keys.size(), 3U);
}

TEST(ValidationCheck, OfFewValuesIsStudentsT) {
  // Percentage points of t: Abramowitz & Stegun, table 26.10; of the normal distribution 1.959964 and 2.575829.
  Check few = check(0.0, 2.262157, 1.0);
  few.measured.freedom = 9.0;
  EXPECT_NEAR(few.z(), 1.959964, 1e-6);
  EXPECT_NEAR(few.deviation(), 1.959964, 1e-6);
  few.measured = {-6.405e-3, 1e-3, 7.0};
  few.allowance = 2.905541e-3;
  EXPECT_NEAR(few.deviation(), -2.5758, 1e-3) << "3.499 standard errors beyond the allowance";
  EXPECT_TRUE(few.fits());
  few.measured.value = 1e9;
  EXPECT_FALSE(few.fits());
  few.measured = {0.0, 0.0, 7.0};
  EXPECT_EQ(few.z(), 0.0);
  // As large an error of the reference: the sum of both has four times the degrees of freedom.
  few = check(0.0, 2.028094, std::sqrt(0.5));
  few.measured.freedom = 9.0;
  few.reference_error = std::sqrt(0.5);
  EXPECT_NEAR(few.freedom(), 36.0, 1e-12);
  EXPECT_NEAR(few.z(), 1.959964, 1e-6);
}

TEST(Validation, AGroupStandsForItsTrials) {
  const auto names = [](const ValidateOptions& options) {
    std::vector<std::string> list;
    for (const validation::Trial& trial : chosen_trials(options)) list.push_back(trial.name);
    return list;
  };
  EXPECT_THAT(names({.only = {"single file"}}),
              ElementsAre("single-file-1.8-1", "single-file-1.8-2", "single-file-1.5-0.95", "single-file-1.2-1.2",
                          "single-file-steps-1.5-1.2", "single-file-steps-1.8-1.1", "single-file-well-1.5-1.3",
                          "single-file-shoulder-1.3-1.2"));
  const std::vector<std::string> quick = names({.only = {"equation of state"}});
  EXPECT_THAT(quick, Not(Contains("transition-0.708")));
  EXPECT_THAT(names({.full = true, .only = {"equation of state"}}), Contains("transition-0.708"));
  EXPECT_THAT(names({.only = {"equation of state", "transition-0.708"}}), SizeIs(quick.size() + 1));
  EXPECT_THROW((void)chosen_trials({.only = {"equation of states"}}), std::invalid_argument);
}

TEST(Validation, AGroupFitsByTheFirstCheckOfEachTrialThatCalibrates) {
  Check statistic = check(0.0, 3.0, 0.0);
  statistic.equivalent = 3.0;
  Validation found;
  for (const char* trial : {"pressure-0.01", "pressure-0.05", "pressure-0.10", "pressure-0.20", "pressure-0.30"})
    found.results.push_back({.trial = trial, .checks = {statistic, check(1.0, 1.2, 0.1), check(1.0, 9.0, 0.1)}});
  found.results.push_back({.trial = "pressure-0.40", .checks = {check(1.0, 9.0, 0.1, 0.5)}});  // its allowance hides a part
  Check crystal = check(1.0, 1.0, 0.1);
  crystal.reference_error = 1.0;  // hides what is measured
  found.results.push_back({.trial = "crystal-0.01", .checks = {crystal}});
  found.results.push_back({.trial = "single-file-1.8-1", .checks = {check(1.0, 9.0, 0.1)}});  // one trial says little
  const std::vector<GroupFit> fits = group_fits(found);
  ASSERT_THAT(fits, SizeIs(1));
  EXPECT_EQ(fits[0].group, "equation of state");
  EXPECT_EQ(fits[0].trials, 5U);
  EXPECT_NEAR(fits[0].mean_square, 4.0, 1e-12);
  // Percentage points of chi squared with 5 degrees of freedom: Abramowitz & Stegun, table 26.8.
  EXPECT_NEAR(fits[0].least, 0.831211 / 5.0, 1e-6);
  EXPECT_NEAR(fits[0].most, 12.8325 / 5.0, 1e-5);
  EXPECT_THAT(validation_markdown(found), HasSubstr("equation of state: chi squared per trial 4.00 (5 trials; 0.17 to 2.57 in"));
}

TEST(Validation, TakesWhatIsKnownAndStopsWhereItIsTold) {
  Validation before;
  before.results.push_back({.trial = "equipartition-walls", .checks = {check(1.0, 9.0, 0.1)}});
  const ValidateOptions options{.only = {"equipartition-walls"}};
  const Validation known = validate(options, {}, before);
  EXPECT_TRUE(known.complete);
  EXPECT_EQ(known.checks(), 1U);
  EXPECT_EQ(known.failed(), 1U);
  EXPECT_THAT(summary_of(known), HasSubstr("1 FAIL"));
  ValidateHooks hooks;
  hooks.proceed = [](const std::string&, double) { return false; };
  const Validation stopped = validate(options, hooks);
  EXPECT_FALSE(stopped.complete);
  EXPECT_TRUE(stopped.results.empty());
}

TEST(Validation, FindsTheSameOnAnyNumberOfThreadsInTheOrderOfTheTrials) {
  const auto found_by = [](int threads) {
    std::mutex mutex;
    std::size_t ended = 0;
    ValidateHooks hooks;
    const std::thread::id caller = std::this_thread::get_id();
    hooks.proceed = [&](const std::string&, double fraction) {
      EXPECT_EQ(std::this_thread::get_id(), caller);
      EXPECT_LE(fraction, 1.0);
      return true;
    };
    hooks.done = [&](const TrialResult&) {
      EXPECT_TRUE(mutex.try_lock()) << "two calls at once";
      ++ended;
      mutex.unlock();
    };
    Validation found = validate({.only = {"equipartition-walls", "contact-values", "h-theorem"}, .threads = threads}, hooks);
    EXPECT_TRUE(found.complete);
    EXPECT_EQ(ended, 3U);
    for (TrialResult& result : found.results) result.seconds = 0.0;
    return found;
  };
  const Validation one = found_by(1), three = found_by(3);
  ASSERT_THAT(one.results, SizeIs(3));
  EXPECT_EQ(one.results.front().trial, "h-theorem");
  EXPECT_EQ(one.results.back().trial, "contact-values");
  EXPECT_EQ(validation_json(one, ""), validation_json(three, ""));
}

TEST(Validation, MarkdownKeepsItsColumnsWhateverTheText) {
  Validation validation;
  validation.results.push_back({.trial = "h-theorem", .checks = {check(1.0, 1.0, 0.1)}});
  validation.results[0].checks[0].name = "a | b";
  const std::string text = validation_markdown(validation);
  EXPECT_THAT(text, HasSubstr("| a \\| b |"));
  EXPECT_THAT(text, HasSubstr("### Maxwell and Boltzmann"));
}

}  // namespace
}  // namespace carom::test
