// How wide the calendar's spans become.

#include "queue/queue_pacing.hpp"

#include <gtest/gtest.h>

namespace carom::test {
namespace {

TEST(QueuePacing, ASpanIsAsLongAsSixEventsTake) {
  QueuePacing pacing;
  EXPECT_EQ(pacing.span(), 0.0);
  pacing.set_span(3.0);
  pacing.begin(1000);
  pacing.judge(12.0, 1000 + 400, 100);
  EXPECT_EQ(pacing.span(), 6.0 * 12.0 / 400.0);
  EXPECT_TRUE(pacing.busy());
}

TEST(QueuePacing, TooFewEventsChangeNoSpanAndMeanThatFewAreToBeExpected) {
  QueuePacing pacing;
  pacing.set_span(3.0);
  pacing.begin(1000);
  pacing.judge(12.0, 1000 + 100 / 4 + 16, 100);
  EXPECT_EQ(pacing.span(), 3.0);
  EXPECT_FALSE(pacing.busy());
  pacing.judge(12.0, 1000 + 100 / 4 + 17, 100);
  EXPECT_EQ(pacing.span(), 6.0 * 12.0 / (100 / 4 + 17));
  EXPECT_TRUE(pacing.busy());
}

TEST(QueuePacing, AnEpochWithoutTimeSaysNothingOfWhatIsToBeExpected) {
  QueuePacing pacing;
  pacing.begin(0);
  pacing.judge(0.0, 0, 100);
  EXPECT_TRUE(pacing.busy());
}

}  // namespace
}  // namespace carom::test
