// The answers to a comparison made up of laws: an error of c dt, a cost of k / dt, a bias of s dt.

#include "studies/compare/answers.hpp"

#include "core/real.hpp"
#include "support/comparisons.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace carom::test {
namespace {

using ::testing::HasSubstr;

/// What logarithms, sums over the points and powers of them may round.
constexpr double rounding = 1e-12;

const TimeToZ& row_of(const Answers& answers, const std::string& method, double accuracy) {
  for (const TimeToZ& row : answers.time_to_Z)
    if (row.method == method && row.accuracy == accuracy) return row;
  throw std::runtime_error("there is no row of " + method);
}

TEST(Spread, QuartilesLieBetweenTheValuesAndInfinitiesAreValues) {
  const Spread odd = spread_of({5.0, 1.0, 3.0, 2.0, 4.0});
  EXPECT_EQ(odd.lower, 2.0);
  EXPECT_EQ(odd.median, 3.0);
  EXPECT_EQ(odd.upper, 4.0);
  const Spread even = spread_of({1.0, 2.0, 3.0, 5.0});
  EXPECT_EQ(even.lower, 1.75);
  EXPECT_EQ(even.median, 2.5);
  EXPECT_EQ(even.upper, 3.5);
  const Spread lost = spread_of({1.0, infinity<double>, infinity<double>});
  EXPECT_EQ(lost.median, infinity<double>);
  EXPECT_EQ(lost.upper, infinity<double>);
  EXPECT_EQ(spread_of({7.0}).lower, 7.0);
  EXPECT_TRUE(std::isnan(spread_of({}).median));
}

TEST(Summaries, HoldMediansOfTheRunsOfEachMethodInTheirOrder) {
  const KnownLaws laws{.dts = {0.1, 0.01}};
  Comparison comparison = laws.comparison();
  comparison.runs[0].error[0] = 0.0;  // of one seed of the exact engine: the median stays
  comparison.runs[1].energy_drift = -1e-3;
  comparison.runs[1].worst_overlap = 0.25;
  comparison.runs[1].counts = StepCounts{.steps = 7};
  const std::vector<MethodSummary> summaries = summaries_of(comparison);
  ASSERT_EQ(summaries.size(), 3U);
  EXPECT_EQ(summaries[0].method.name, "fast");
  EXPECT_EQ(summaries[0].runs, 4U);
  EXPECT_EQ(summaries[1].method.dt, 0.1);
  EXPECT_EQ(summaries[1].error.median, laws.error_per_dt * 0.1);
  EXPECT_EQ(summaries[1].seconds_early, laws.step_seconds / 0.1);
  EXPECT_EQ(summaries[1].energy_drift, 1e-3);
  EXPECT_EQ(summaries[1].worst_overlap, 0.25);
  ASSERT_TRUE(summaries[1].counts);
  EXPECT_EQ(summaries[1].counts->steps, 7U);
  EXPECT_EQ(summaries[2].method.dt, 0.01);
  // Deviations -d, -d, d, d: a variance of 4 d^2 / 3, and half of its root for the mean of four.
  ASSERT_TRUE(summaries[0].Z);
  EXPECT_NEAR(summaries[0].Z->value, 2.0, rounding);
  EXPECT_NEAR(summaries[0].Z->error, laws.d / std::sqrt(3.0), rounding);
}

TEST(Summaries, ARunThatWasCutShortSaysNothingOfAverages) {
  Comparison comparison = KnownLaws{.dts = {0.1}}.comparison();
  for (MethodRun& run : comparison.runs)
    if (!run.method.exact()) run.error.resize(1);
  const std::vector<MethodSummary> summaries = summaries_of(comparison);
  EXPECT_TRUE(summaries[0].Z && summaries[0].collision_rate && summaries[0].mean_free_path);
  EXPECT_FALSE(summaries[1].Z || summaries[1].collision_rate || summaries[1].mean_free_path);
  EXPECT_EQ(summaries[1].error.median, 0.05 * 0.1);
}

class KnownAnswers : public ::testing::Test {
 protected:
  KnownLaws laws_;
};

TEST_F(KnownAnswers, TheOrderOfAFirstOrderMethodIsOne) {
  const Answers answers = answers_of(laws_.comparison());
  ASSERT_TRUE(answers.order);
  EXPECT_NEAR(answers.order->value, 1.0, rounding);
  EXPECT_NEAR(answers.order->error, 0.0, rounding);
  EXPECT_EQ(answers.exact, "fast");
  EXPECT_EQ(answers.exact_seconds, laws_.exact_seconds);
  EXPECT_EQ(answers.exact_error, 1e-15);
}

TEST_F(KnownAnswers, ThePriceOfAMillionthIsExtrapolatedByTheLaw) {
  const Answers answers = answers_of(laws_.comparison());
  ASSERT_TRUE(answers.to_millionth);
  const double dt = 1e-6 / laws_.error_per_dt;  // a fifth of the smallest that was run
  EXPECT_TRUE(answers.to_millionth->extrapolated);
  EXPECT_NEAR(answers.to_millionth->dt / dt, 1.0, rounding);
  EXPECT_NEAR(answers.to_millionth->seconds / (laws_.step_seconds / dt), 1.0, rounding);
  ASSERT_FALSE(answers.sentences.empty());
  EXPECT_THAT(answers.sentences.front(), HasSubstr(" 50 times "));  // 0.05 s against a millisecond
}

TEST_F(KnownAnswers, ThePriceOfAnErrorAmongThoseThatWereRunLiesOnTheLawToo) {
  const std::vector<MethodSummary> summaries = summaries_of(laws_.comparison());
  for (const double error : {1e-5, 7e-5, 1e-3, 4.9e-3, 0.1}) {
    const auto price = price_of_error(summaries, "grid", error);
    ASSERT_TRUE(price);
    EXPECT_FALSE(price->extrapolated);
    EXPECT_NEAR(price->dt / (error / laws_.error_per_dt), 1.0, rounding);
    EXPECT_NEAR(price->seconds / (laws_.step_seconds / price->dt), 1.0, rounding);
  }
  EXPECT_FALSE(price_of_error(summaries, "guarded", 1e-3));  // there are no points of it
}

TEST_F(KnownAnswers, ErrorsThatFollowNoLawHaveNoPriceAndNoOrder) {
  laws_.error_per_dt = 1e9;
  const Answers answers = answers_of(laws_.comparison());
  EXPECT_FALSE(answers.order);
  EXPECT_FALSE(answers.to_millionth);
  ASSERT_FALSE(answers.sentences.empty());
  EXPECT_THAT(answers.sentences.front(), HasSubstr("Too few of the steps"));
}

TEST_F(KnownAnswers, MethodsCrossWhereTheStepCostsWhatTheEventsDo) {
  const Answers answers = answers_of(laws_.comparison());
  ASSERT_TRUE(answers.crossover_dt && answers.crossover_error);
  EXPECT_NEAR(*answers.crossover_dt / (laws_.step_seconds / laws_.exact_seconds), 1.0, rounding);
  EXPECT_NEAR(*answers.crossover_error / (laws_.error_per_dt * *answers.crossover_dt), 1.0, rounding);
}

TEST_F(KnownAnswers, MethodsThatNeverCrossAreSaidNotTo) {
  laws_.step_seconds = 1.0;
  Answers answers = answers_of(laws_.comparison());
  EXPECT_FALSE(answers.crossover_dt || answers.crossover_error);
  ASSERT_GE(answers.sentences.size(), 2U);
  EXPECT_THAT(answers.sentences[1], HasSubstr("The exact engine is cheaper than the fixed step at every dt"));
  laws_.step_seconds = 1e-12;
  answers = answers_of(laws_.comparison());
  EXPECT_FALSE(answers.crossover_dt || answers.crossover_error);
  EXPECT_THAT(answers.sentences[1], HasSubstr("The fixed step is cheaper than the exact engine at every dt"));
}

TEST_F(KnownAnswers, ExactEventsKnowZWhenChanceIsSmallEnough) {
  // Z scatters by the relative deviation D = d / sqrt(3) of runs of time T; it is known to A after T (D / A)^2.
  const Answers answers = answers_of(laws_.comparison());
  const double deviation = laws_.d * std::sqrt(4.0 / 3.0) / 2.0;
  const double per_time = laws_.exact_seconds / KnownLaws::early_time;
  for (const double accuracy : {0.01, 0.001}) {
    const TimeToZ& row = row_of(answers, "fast", accuracy);
    EXPECT_FALSE(row.dt);
    ASSERT_TRUE(row.seconds);
    EXPECT_NEAR(*row.seconds / (KnownLaws::end * std::pow(deviation / accuracy, 2) * per_time), 1.0, rounding);
  }
}

TEST_F(KnownAnswers, FixedStepsKnowZAtTheStepWhereChanceAndBiasTogetherAreCheapest) {
  // With bias B = s dt and a cost of k / dt the time is proportional to 1 / ((A^2 - B^2) B), least at B = A / sqrt(3). The search
  // goes in steps of 2 %, so it ends within 1 % of that, where the time is higher by 1.5 (1 %)^2 at most.
  const Answers answers = answers_of(laws_.comparison());
  const double deviation = laws_.d * std::sqrt(4.0 / 3.0) / 2.0;
  for (const double accuracy : {0.01, 0.001}) {
    const TimeToZ& row = row_of(answers, "grid", accuracy);
    ASSERT_TRUE(row.dt && row.seconds);
    const double best = accuracy / std::sqrt(3.0) / laws_.bias_per_dt;
    EXPECT_NEAR(*row.dt / best, 1.0, 0.0101);
    const double time = KnownLaws::end * std::pow(deviation / accuracy, 2) * 1.5;  // A^2 / (A^2 - B^2) = 3 / 2
    EXPECT_NEAR(*row.seconds / (time * laws_.step_seconds / best / KnownLaws::early_time), 1.0, 1.6e-4);
  }
}

TEST_F(KnownAnswers, AMethodWithoutBiasTakesItsLargestStep) {
  laws_.bias_per_dt = 0.0;
  const TimeToZ row = row_of(answers_of(laws_.comparison()), "grid", 0.01);
  ASSERT_TRUE(row.dt);
  EXPECT_EQ(*row.dt, 0.1);
}

TEST_F(KnownAnswers, ANaiveMethodThatIsFarOffAtEveryStepNeverKnowsZ) {
  Comparison comparison = laws_.comparison({"grid", "naive"});
  for (MethodRun& run : comparison.runs)
    if (run.method.name == "naive") run.Z = 4.0;
  const TimeToZ never = row_of(answers_of(comparison), "naive", 0.01);
  EXPECT_FALSE(never.seconds || never.dt);
  EXPECT_THAT(never.remark, HasSubstr("never"));
  // Right on average at small steps, but scattered by more than the accuracy: these runs cannot tell.
  KnownLaws scattered = laws_;
  scattered.e = 0.05;
  const TimeToZ unknown = row_of(answers_of(scattered.comparison({"grid", "naive"})), "naive", 0.01);
  EXPECT_FALSE(unknown.seconds || unknown.dt);
  EXPECT_THAT(unknown.remark, HasSubstr("too short to tell bias from noise"));
  // And where it is seen to be right it is believed: 0.5 dt + e / sqrt(3) is below 1 % up to dt = 0.01.
  const TimeToZ known = row_of(answers_of(laws_.comparison({"grid", "naive"})), "naive", 0.01);
  EXPECT_EQ(known.dt, 0.01);
}

TEST_F(KnownAnswers, ABiasThatHasSaturatedDoesNotFlattenTheLaw) {
  // Steps from 0.03 on transfer no momentum at all: Z is 1. The law of the shorter ones stands, and ends with them.
  Comparison comparison = laws_.comparison();
  for (MethodRun& run : comparison.runs)
    if (run.method.dt >= 0.03) run.Z = 1.0;
  EXPECT_EQ(row_of(answers_of(comparison), "grid", 0.01).dt, 0.01);
}

TEST_F(KnownAnswers, OfFewerThanFourStartsNothingIsSaidOfTheTimeToKnowZ) {
  Comparison comparison = laws_.comparison();
  std::erase_if(comparison.runs, [](const MethodRun& run) { return run.seed > 3; });
  EXPECT_TRUE(answers_of(comparison).time_to_Z.empty());
}

TEST(Answers, OfNothingAreEmpty) {
  const Answers answers = answers_of(Comparison{});
  EXPECT_TRUE(answers.sentences.empty());
  EXPECT_TRUE(answers.time_to_Z.empty());
  EXPECT_FALSE(answers.order || answers.to_millionth || answers.crossover_dt);
}

}  // namespace
}  // namespace carom::test
