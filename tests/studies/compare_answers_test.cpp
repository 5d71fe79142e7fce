// The answers to a comparison made up of laws: an error of c dt, a cost of k / dt, a bias of s dt.

#include "studies/compare/answers.hpp"

#include "core/real.hpp"
#include "support/comparisons.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>

namespace carom::test {
namespace {

using ::testing::Contains;
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

Price price_of(const Answers& answers, const std::string& method, const std::string& target) {
  for (const Price& price : answers.prices)
    if (price.method == method && price.target == target) return price;
  throw std::runtime_error("there is no price of " + method + " for " + target);
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
  const Price price = price_of(answers, "grid", "error 1e-6");
  const double dt = 1e-6 / laws_.error_per_dt;  // a fifth of the smallest that was run
  ASSERT_TRUE(price.ratio && price.dt && price.seconds);
  EXPECT_NEAR(price.extrapolation, 5.0, 5.0 * rounding);
  EXPECT_NEAR(*price.dt / dt, 1.0, rounding);
  EXPECT_NEAR(*price.seconds / (laws_.step_seconds / dt), 1.0, rounding);
  EXPECT_NEAR(*price.ratio, 50.0, 50.0 * rounding);  // 0.05 s against a millisecond
  EXPECT_EQ(price.lowest, price.highest);            // every start is the same
  // A fifth is further than a headline goes.
  EXPECT_EQ(best_fixed_step(answers.prices, "error 1e-6"), nullptr);
  EXPECT_THAT(answers.sentences.front(), HasSubstr("No fixed step that was run comes within a factor of 3 in dt"));
}

TEST_F(KnownAnswers, TheHeadlineIsTheCheapestMethodWithItsSpreadAndTheMachine) {
  Comparison comparison = laws_.comparison({"grid", "guarded", "backtrack"});
  for (MethodRun& run : comparison.runs) {
    if (run.method.name == "guarded") run.seconds_early *= 10.0;
    if (run.method.name != "backtrack") continue;
    run.error[0] = run.method.dt <= 0.01 ? 1e-14 : 0.5;
    run.seconds_early = laws_.exact_seconds * (2.0 + 0.5 * static_cast<double>(run.seed)) * 0.01 / run.method.dt;
  }
  const Answers answers = answers_of(comparison);
  const Price* best = best_fixed_step(answers.prices, "error 1e-6");
  ASSERT_NE(best, nullptr);
  EXPECT_EQ(best->method, "backtrack");
  EXPECT_EQ(best->dt, 0.01);
  EXPECT_NEAR(*best->ratio, 3.25, rounding);  // of 2.5, 3, 3.5 and 4
  EXPECT_NEAR(best->lowest, 2.5, rounding);
  EXPECT_NEAR(best->highest, 4.0, rounding);
  EXPECT_FALSE(best->extrapolated());
  EXPECT_THAT(
      answers.sentences.front(),
      HasSubstr("the best fixed step (backtrack with dt = 0.02 mean free times) needs 3.2 times (2.5 to 4 over 4 starts) the "
                "processor time of the exact engine, both on one core of Some Processor"));
  EXPECT_THAT(answers.sentences[1], HasSubstr("(grid) still has an error of 5.0e-06 diameters there at 10 times"));
  EXPECT_THAT(answers.sentences, Contains(HasSubstr("On 4 cores that step would be as fast")));
}

TEST_F(KnownAnswers, APriceOfTheLongestStepThatWasRunIsAnUpperBound) {
  laws_.error_per_dt = 1e-12;  // right at every step
  laws_.starts = 1;
  laws_.dts = {0.01};
  const Answers alone = answers_of(laws_.comparison({"backtrack"}));
  EXPECT_TRUE(price_of(alone, "backtrack", "error 1e-6").at_most);
  EXPECT_FALSE(price_of(alone, "fast", "error 1e-6").at_most);
  EXPECT_THAT(alone.sentences.front(), AllOf(HasSubstr("(backtrack with dt = 0.02 mean free times, the longest that was run) "
                                                       "needs at most 0.1 times the processor time of the exact engine"),
                                             HasSubstr("A longer one may need less.")));
  laws_.dts = {0.1, 0.01};
  Comparison both = laws_.comparison({"backtrack"});
  EXPECT_TRUE(price_of(answers_of(both), "backtrack", "error 1e-6").at_most);
  for (MethodRun& run : both.runs)
    if (run.method.dt == 0.1) run.error[0] = 0.5;
  EXPECT_FALSE(price_of(answers_of(both), "backtrack", "error 1e-6").at_most);
  laws_.dts = {KnownLaws::early_time, 0.01};  // one step, and none can be longer
  EXPECT_FALSE(price_of(answers_of(laws_.comparison({"backtrack"})), "backtrack", "error 1e-6").at_most);
}

TEST_F(KnownAnswers, AStepIsRightOnlyWhereEveryShorterOneIsToo) {
  Comparison comparison = laws_.comparison({"backtrack"});
  for (MethodRun& run : comparison.runs)
    if (!run.method.exact()) run.error[0] = run.method.dt == 0.001 ? 0.2 : 1e-14;  // a mistake in the middle of the ladder
  const Answers answers = answers_of(comparison);
  for (const char* target : {"error 1e-6", "error 1e-10"}) {
    const Price price = price_of(answers, "backtrack", target);
    EXPECT_EQ(price.dt, 0.0003);
    EXPECT_FALSE(price.extrapolated());
  }
}

TEST_F(KnownAnswers, RoundingOfShorterStepsSpoilsNoLongerOne) {
  Comparison comparison = laws_.comparison({"backtrack"});
  for (MethodRun& run : comparison.runs)
    if (!run.method.exact()) run.error[0] = run.method.dt <= 0.01 ? 1e-13 / run.method.dt : 0.5;  // 1e-9 at the shortest
  const Price price = price_of(answers_of(comparison), "backtrack", "error 1e-10");
  EXPECT_EQ(price.dt, 0.01);
  EXPECT_FALSE(price.extrapolated());
}

TEST_F(KnownAnswers, AMethodThatFindsContactsIsNotExtrapolated) {
  const Answers answers = answers_of(laws_.comparison({"backtrack", "guarded"}));  // wrong at every step, as by a law
  EXPECT_FALSE(price_of(answers, "backtrack", "error 1e-6").ratio);
  EXPECT_TRUE(price_of(answers, "guarded", "error 1e-6").extrapolated());
}

TEST_F(KnownAnswers, TheCheapestOfTheRightStepsCounts) {
  Comparison comparison = laws_.comparison({"swept"});
  for (MethodRun& run : comparison.runs) {
    if (run.method.exact()) continue;
    run.error[0] = 1e-14;
    if (run.method.dt == 0.1) run.seconds_early = 1.0;  // so many contacts in a step that it takes longest
  }
  const Price price = price_of(answers_of(comparison), "swept", "error 1e-10");
  EXPECT_EQ(price.dt, 0.03);
  EXPECT_NEAR(*price.ratio, laws_.step_seconds / 0.03 / laws_.exact_seconds, rounding);
}

TEST_F(KnownAnswers, AStartWithoutAPriceMakesTheSpreadInfiniteAndMostOfThemLeaveNone) {
  Comparison comparison = laws_.comparison({"backtrack"});
  const auto spoil = [&](std::uint64_t from) {
    for (MethodRun& run : comparison.runs)
      if (!run.method.exact()) run.error[0] = run.seed >= from ? 0.7 : 1e-14;
  };
  spoil(4);
  Price price = price_of(answers_of(comparison), "backtrack", "error 1e-6");
  EXPECT_TRUE(price.ratio);
  EXPECT_EQ(price.highest, infinity<double>);
  spoil(2);
  price = price_of(answers_of(comparison), "backtrack", "error 1e-6");
  EXPECT_FALSE(price.ratio);
  EXPECT_THAT(price.remark, HasSubstr("not reached: the error is 7.0e-01 with the shortest step that was run"));
}

TEST_F(KnownAnswers, ThePriceOfAnErrorAmongThoseThatWereRunLiesOnTheLawToo) {
  laws_.error_per_dt = 2e-3;  // 1e-6 takes a step between 3e-4 and 1e-3
  const Price price = price_of(answers_of(laws_.comparison()), "grid", "error 1e-6");
  EXPECT_FALSE(price.extrapolated());
  ASSERT_TRUE(price.dt && price.ratio);
  EXPECT_NEAR(*price.dt / 5e-4, 1.0, rounding);
  EXPECT_NEAR(*price.ratio / (laws_.step_seconds / 5e-4 / laws_.exact_seconds), 1.0, rounding);
}

TEST_F(KnownAnswers, AnExactEngineIsPricedWhereItsPrecisionSuffices) {
  Comparison comparison = laws_.comparison();
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    MethodRun run = laws_.run({"textbook-float"}, seed);
    run.error[0] = 1e-7;
    run.seconds_early = 3.0 * laws_.exact_seconds;
    comparison.runs.push_back(run);
  }
  const Answers answers = answers_of(comparison);
  EXPECT_EQ(price_of(answers, "fast", "error 1e-6").ratio, 1.0);
  EXPECT_NEAR(*price_of(answers, "textbook-float", "error 1e-6").ratio, 3.0, rounding);
  const Price finer = price_of(answers, "textbook-float", "error 1e-10");
  EXPECT_FALSE(finer.ratio);
  EXPECT_EQ(finer.remark, "not reached: the error is 1.0e-07 in this precision");
}

TEST_F(KnownAnswers, ErrorsThatFollowNoLawHaveNoPriceAndNoOrder) {
  laws_.error_per_dt = 1e9;
  const Answers answers = answers_of(laws_.comparison());
  EXPECT_FALSE(answers.order);
  EXPECT_FALSE(price_of(answers, "grid", "error 1e-6").ratio);
  ASSERT_FALSE(answers.sentences.empty());
  EXPECT_THAT(answers.sentences.front(), HasSubstr("No fixed step that was run is right to 1e-6 diameters"));
}

TEST_F(KnownAnswers, MethodsCrossWhereTheStepCostsWhatTheEventsDo) {
  const Answers answers = answers_of(laws_.comparison());
  ASSERT_TRUE(answers.crossover);
  EXPECT_EQ(answers.crossover->method, "grid");
  EXPECT_NEAR(answers.crossover->dt / (laws_.step_seconds / laws_.exact_seconds), 1.0, rounding);
  EXPECT_NEAR(answers.crossover->error / (laws_.error_per_dt * answers.crossover->dt), 1.0, rounding);
}

TEST_F(KnownAnswers, TheCrossoverIsThatOfTheMethodThatIsCheaperForTheSmallestErrors) {
  Comparison comparison = laws_.comparison({"grid", "backtrack"});
  for (MethodRun& run : comparison.runs)
    if (run.method.name == "backtrack") run.error[0] /= 100.0;
  const Answers answers = answers_of(comparison);
  ASSERT_TRUE(answers.crossover);
  EXPECT_EQ(answers.crossover->method, "backtrack");
  EXPECT_THAT(answers.sentences, Contains(HasSubstr("A fixed step is the better choice for errors above")));
}

/// Of a method that is wrong with one step and right to rounding with the next there is no error in between.
TEST_F(KnownAnswers, NothingIsBetweenAStepThatIsWrongAndOneThatIsRight) {
  Comparison comparison = laws_.comparison({"backtrack"});
  for (MethodRun& run : comparison.runs)
    if (run.method.name == "backtrack") run.error[0] = run.seconds_early < laws_.exact_seconds ? 0.6 : 1e-14;
  const Answers answers = answers_of(comparison);
  ASSERT_TRUE(answers.crossover);
  EXPECT_EQ(answers.crossover->error, 0.6);
}

/// The bias of backtrack is that of its mistakes: no line through its steps makes a price of noise.
TEST_F(KnownAnswers, ThePressureOfMethodsThatFindContactsIsPricedByStepsThatWereRun) {
  const Comparison comparison = laws_.comparison({"backtrack"});
  const Price price = price_of(answers_of(comparison), "backtrack", "Z 1 %");
  ASSERT_TRUE(price.dt) << price.remark;
  EXPECT_TRUE(std::any_of(comparison.runs.begin(), comparison.runs.end(),
                          [&](const MethodRun& run) { return run.method.dt == *price.dt; }));
}

TEST_F(KnownAnswers, MethodsThatNeverCrossAreSaidNotTo) {
  laws_.step_seconds = 1.0;
  Answers answers = answers_of(laws_.comparison());
  EXPECT_FALSE(answers.crossover);
  EXPECT_THAT(answers.sentences, Contains(HasSubstr("The exact engine is cheaper than every fixed step that was run")));
  laws_.step_seconds = 1e-12;
  answers = answers_of(laws_.comparison());
  EXPECT_FALSE(answers.crossover);
  EXPECT_THAT(answers.sentences, Contains(HasSubstr("Every fixed step that was run is cheaper than the exact engine")));
}

TEST_F(KnownAnswers, SetUpPaysOffAfterTheCollisionsThatTheCheaperLoopTakes) {
  // The exact loop takes 5e-4 s per time. Grid needs 1e-6 diameters with dt = 1e-3 at the price of the exact engine's loop; made
  // three times as dear it loses 1e-3 s per time, and 4e-3 s of set-up are made up after 4 times, which are 8 mean free times.
  laws_.error_per_dt = 1e-3;
  laws_.step_seconds = 3.0 * 1e-3 * laws_.exact_seconds;
  laws_.exact_setup = 5e-3;
  laws_.step_setup = 1e-3;
  const Answers answers = answers_of(laws_.comparison());
  ASSERT_TRUE(answers.break_even);
  EXPECT_EQ(answers.break_even->method, "grid");
  EXPECT_EQ(answers.break_even->exact_setup, 5e-3);
  EXPECT_EQ(answers.break_even->method_setup, 1e-3);
  EXPECT_NEAR(answers.break_even->collisions_per_disk, 8.0, 8.0 * rounding);
  laws_.exact_setup = 0.0;
  EXPECT_EQ(answers_of(laws_.comparison()).break_even->collisions_per_disk, 0.0);
}

TEST_F(KnownAnswers, TheHorizonIsWhereTheErrorPassesTheTolerance) {
  const Comparison comparison = laws_.comparison();
  // Errors of 5e-4, 1e-3, 2e-3, 4e-3 at times 2, 4, 6, 8: at 4, where it is the tolerance. The mean free time is 0.5.
  const std::optional<double> at_a_sample = horizon_of(comparison.plan, laws_.run({"grid", 0.01}, 1));
  ASSERT_TRUE(at_a_sample);
  EXPECT_NEAR(*at_a_sample, 4.0 / 0.5, rounding);
  // Errors of 3e-4, 6e-4, 1.2e-3: log2(1 / 0.6) of the way from time 4 to 6.
  laws_.error_per_dt = 0.03;
  EXPECT_NEAR(*horizon_of(comparison.plan, laws_.run({"grid", 0.01}, 1)), (4.0 + 2.0 * std::log2(1.0 / 0.6)) / 0.5, rounding);
  EXPECT_FALSE(horizon_of(comparison.plan, laws_.run({"grid", 0.1}, 1))) << "lost before the first sample";
  EXPECT_FALSE(horizon_of(comparison.plan, laws_.run({"fast"}, 1))) << "never lost";
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

TEST_F(KnownAnswers, RichardsonTakesTheStepWhereItsBiasOfSecondOrderAndChanceTogetherAreCheapest) {
  // A parabola of bias a dt + b dt^2 leaves B = b dt^2 / 2. Costs of k / dt make the time proportional to
  // 1 / ((A^2 - B^2) sqrt(B)), least at B = A / sqrt(5); the search goes in steps of 2 %.
  laws_.bias_per_square = -2.0;
  const Answers answers = answers_of(laws_.comparison());
  const double accuracy = 0.001;
  const TimeToZ row = row_of(answers, "richardson", accuracy);
  ASSERT_TRUE(row.dt && row.seconds);
  const double best = std::sqrt(2.0 * accuracy / std::sqrt(5.0) / 2.0);
  EXPECT_NEAR(*row.dt / best, 1.0, 0.0101);
  const double deviation = laws_.d * std::sqrt(4.0 / 3.0) / 2.0;
  const double time = KnownLaws::end * std::pow(deviation / accuracy, 2) * 1.25;  // A^2 / (A^2 - B^2) = 5 / 4
  const double price = laws_.step_seconds / best / KnownLaws::early_time * std::pow(2.0 * std::numbers::sqrt2 + 1.0, 2);
  EXPECT_NEAR(*row.seconds / (time * price), 1.0, 1e-3);
}

TEST_F(KnownAnswers, APriceOfZHasAStandardErrorFromLeavingOutOneStartAfterAnother) {
  EXPECT_TRUE(std::isnan(price_of(answers_of(laws_.comparison()), "grid", "Z 1 %").lowest)) << "three starts know no scatter";
  laws_.starts = 8;
  laws_.bias_per_dt = 0.0;
  laws_.e = 0.0;
  Comparison comparison = laws_.comparison();
  Price price = price_of(answers_of(comparison), "grid", "Z 1 %");
  // Without bias both wait for the same chance, whatever it is: the ratio is that of the loops, in every start.
  const double loops = laws_.step_seconds / 0.1 / laws_.exact_seconds;
  ASSERT_TRUE(price.ratio);
  EXPECT_NEAR(*price.ratio / loops, 1.0, rounding);
  EXPECT_NEAR(price.highest - price.lowest, 0.0, rounding);
  // One start that takes longer moves no median, left out or not, but half of them do: medians of 1.5 out of eight, and of 1 or 2
  // out of the seven others. Their mean is 1.5, and 7/8 of the sum of squares, 8 / 4, is 7/4.
  for (MethodRun& run : comparison.runs)
    if (!run.method.exact() && run.seed > 4) run.seconds *= 2.0, run.seconds_early *= 2.0;
  price = price_of(answers_of(comparison), "grid", "Z 1 %");
  EXPECT_NEAR(*price.ratio / loops, 1.5, rounding);
  EXPECT_NEAR((price.highest - price.lowest) / loops, 2.0 * std::sqrt(1.75), rounding);
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
  EXPECT_TRUE(answers.prices.empty());
  EXPECT_FALSE(answers.order || answers.crossover || answers.break_even);
}

}  // namespace
}  // namespace carom::test
