// How wide the calendar's spans become.

#include "queue/queue_pacing.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace carom::test {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

TEST(QueuePacing, ASpanIsAsLongAsTwentyFourEventsTake) {
  QueuePacing pacing;
  EXPECT_EQ(pacing.span(), 0.0);
  pacing.begin(0.0, 1000);
  pacing.judge(12.0, 1000 + 400, 100);
  EXPECT_EQ(pacing.span(), 24.0 * 12.0 / 400.0);
  EXPECT_TRUE(pacing.busy());
}

TEST(QueuePacing, OfAnEpochThatItHasNotSeenTheBeginningOfItCountsTheTimeThatItHas) {
  QueuePacing pacing;
  pacing.begin(9.0, 1000);  // as where disks are shared out in the middle of an epoch
  pacing.judge(12.0, 1000 + 400, 100);
  EXPECT_EQ(pacing.span(), 24.0 * 3.0 / 400.0);
}

TEST(QueuePacing, TheRingIsThreeEventsOfEachDiskLong) {
  for (const std::size_t disks : {100'000U, 20'000U, 70'000U, 43'690U}) {
    const auto spans = static_cast<double>(calendar_spans(disks)), all = static_cast<double>(disks);
    EXPECT_GE(spans, 3.0 / 32.0 * all - 1.0);
    EXPECT_LE(spans, 6.0 / 32.0 * all);
    QueuePacing pacing;
    pacing.begin(0.0, 0);
    pacing.judge(1.0, 100'000, disks);
    EXPECT_GE(spans * pacing.span() * 100'000.0, 2.8 * all) << disks;
    EXPECT_LE(pacing.span() * 100'000.0, 30.0) << disks;
    EXPECT_DOUBLE_EQ(pacing.time_per_event(), 1e-5);
  }
}

TEST(QueuePacing, OfAPartOfTheDisksASpanIsLonger) {
  QueuePacing pacing;
  pacing.begin(0.0, 0);
  pacing.judge(12.0, 400, 100);
  pacing.lengthen_span(16.0);
  EXPECT_EQ(pacing.span(), 16.0 * (24.0 * 12.0 / 400.0));
}

TEST(QueuePacing, TheFirstSpanIsSixteenTimesTheMedianOfTheFirstEventsOverTheirNumber) {
  QueuePacing pacing;
  pacing.choose_span({8.0, 1.0, infinite, 2.0, 4.0}, 100.0);
  EXPECT_EQ(pacing.span(), 16.0 * 4.0 / 5.0);
}

TEST(QueuePacing, WhereMostDisksExpectNothingTheFirstSpanIsTheEpoch) {
  QueuePacing pacing;
  pacing.choose_span({1.0, infinite, infinite}, 100.0);
  EXPECT_EQ(pacing.span(), 100.0);
  pacing.choose_span({0.0, 0.0, 0.0}, 100.0);
  EXPECT_EQ(pacing.span(), 100.0);
  pacing.choose_span({infinite}, infinite);
  EXPECT_EQ(pacing.span(), 1.0);
  pacing.choose_span({}, 100.0);
  EXPECT_EQ(pacing.span(), 1.0);
}

TEST(QueuePacing, TooFewEventsChangeNoSpanAndMeanThatFewAreToBeExpected) {
  QueuePacing pacing;
  pacing.choose_span({0.75}, 10.0);
  ASSERT_EQ(pacing.span(), 12.0);
  pacing.begin(0.0, 1000);
  pacing.judge(12.0, 1000 + 100 / 4 + 16, 100);
  EXPECT_EQ(pacing.span(), 12.0);
  EXPECT_FALSE(pacing.busy());
  pacing.judge(12.0, 1000 + 100 / 4 + 17, 100);
  EXPECT_EQ(pacing.span(), 24.0 * 12.0 / (100 / 4 + 17));
  EXPECT_TRUE(pacing.busy());
}

TEST(QueuePacing, AnEpochWithoutTimeSaysNothingOfWhatIsToBeExpected) {
  QueuePacing pacing;
  pacing.begin(0.0, 0);
  pacing.judge(0.0, 0, 100);
  EXPECT_TRUE(pacing.busy());
}

}  // namespace
}  // namespace carom::test
