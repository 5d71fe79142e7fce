// What is the calendar's own: spans, and what happens where they end. That it serves events in order is shown for all lists at
// once (future_event_list_test.cpp).

#include "queue/calendar_queue.hpp"

#include "support/event_trial.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace carom::test {
namespace {

using Queue = CalendarQueue<Events>;

TEST(CalendarQueue, KeepsADiskThatIsRescheduledToTheSameSpanOrTimeAgainAndAgain) {
  for (const bool same_time : {false, true}) {
    Events events(8);
    Queue queue;
    queue.start(1.0, 8, infinity<double>);
    for (int k = 0; k < 1000; ++k) {
      events.set(3, 5.0 + (same_time ? 0.5 : 0.9 * (k % 7) / 7.0), 3);
      queue.push(events, {events.time(3), 3, events.other(3)});
    }
    events.set(4, 5.95, 4);
    queue.push(events, {5.95, 4, events.other(4)});
    const auto* next = queue.next(events, no_look);
    ASSERT_NE(next, nullptr);
    EXPECT_EQ(next->disk, 3);
    EXPECT_EQ(next->time, events.time(3));
    queue.pop(events);
    events.set(3, infinity<double>, 3);
    next = queue.next(events, no_look);
    ASSERT_NE(next, nullptr);
    EXPECT_EQ(next->disk, 4);
    queue.pop(events);
    events.set(4, infinity<double>, 4);
    EXPECT_EQ(queue.next(events, no_look), nullptr);
  }
}

TEST(CalendarQueue, ServesAnEventAtTheTimeJustTaken) {
  Events events(3);
  Queue queue;
  queue.start(0.1, 3, infinity<double>);
  for (std::int32_t i = 0; i < 3; ++i) {
    events.set(i, 2.0, i);
    queue.push(events, {2.0, i, events.other(i)});
  }
  for (int k = 0; k < 100; ++k) {  // disk 0 goes on for ever at this instant: no other disk gets a turn
    ASSERT_EQ(queue.next(events, no_look)->disk, 0);
    queue.pop(events);
    queue.push(events, {2.0, 0, events.other(0)});
  }
  queue.next(events, no_look);
  queue.pop(events);
  events.set(0, 2.0, 5);  // now it ranks last
  queue.push(events, {2.0, 0, events.other(0)});
  for (const std::int32_t disk : {1, 2, 0}) {
    ASSERT_EQ(queue.next(events, no_look)->disk, disk);
    queue.pop(events);
    events.set(disk, infinity<double>, 0);
  }
  EXPECT_EQ(queue.next(events, no_look), nullptr);
}

TEST(CalendarQueue, TakesAnEventEarlierThanOneThatWasOnlyLookedAt) {
  Events events(2);
  Queue queue;
  queue.start(1e-3, 2, infinity<double>);
  events.set(0, 1e6, 0);
  queue.push(events, {1e6, 0, events.other(0)});
  EXPECT_EQ(queue.next(events, no_look)->disk, 0);
  events.set(1, 0.5, 1);
  queue.push(events, {0.5, 1, events.other(1)});
  EXPECT_EQ(queue.next(events, no_look)->disk, 1);
  EXPECT_TRUE(queue.holds(events, 0));
}

TEST(CalendarQueue, EventsAtInfinityAreNotKeptEvenAfterTheLastSpanOfAll) {
  Events events(2);
  Queue queue;
  queue.start(1.0, 2, infinity<double>);
  events.set(0, 1e300, 0);
  queue.push(events, {1e300, 0, events.other(0)});
  ASSERT_NE(queue.next(events, no_look), nullptr);
  queue.pop(events);
  events.set(0, infinity<double>, 0);
  queue.push(events, {infinity<double>, 0, events.other(0)});
  EXPECT_EQ(queue.next(events, no_look), nullptr);
}

TEST(CalendarQueue, StartForgetsWhatWasThere) {
  Random random(13);
  Events events(500);
  Queue queue;
  for (const double span : {1.0, 1e-3, 10.0}) {
    queue.start(span, 500, infinity<double>, span > 1.0);
    EXPECT_EQ(queue.pushed(), 0u);
    for (std::int32_t i = 0; i < 500; ++i) {
      events.set(i, 100.0 + unit(random), i);
      queue.push(events, {events.time(i), i, events.other(i)});
    }
    EXPECT_EQ(queue.pushed(), 500u);
    for (int k = 0; k < 100; ++k) {  // leaves the rest at hand, in spans and in those behind them
      queue.next(events, no_look);
      queue.pop(events);
    }
  }
  queue.start(1.0, 2, infinity<double>);
  EXPECT_EQ(queue.next(events, no_look), nullptr);
  events.set(1, 0.25, 0);
  queue.push(events, {0.25, 1, events.other(1)});
  EXPECT_EQ(queue.next(events, no_look)->disk, 1);
}

TEST(CalendarQueue, AnnouncesEverySpanBeforeItsEventsInOrder) {
  Random random(14);
  Events events(100);
  Queue queue;
  queue.start(0.1, 100, infinity<double>);
  for (std::int32_t i = 0; i < 100; ++i) {
    events.set(i, 30.0 * unit(random), i);
    queue.push(events, {events.time(i), i, events.other(i)});
  }
  std::int64_t turn = -1;
  for (int k = 0; k < 100; ++k) {
    const auto* next = queue.next(events, [&](std::int64_t span) {
      EXPECT_GT(span, turn);
      turn = span;
    });
    ASSERT_EQ(turn, queue.span_of(next->time));
    queue.pop(events);
  }
}

}  // namespace
}  // namespace carom::test
