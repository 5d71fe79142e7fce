// The event queue against its obvious twin: a list that is searched from end to end for the earliest event.

#include "queue/event_queue.hpp"

#include "core/real.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

namespace carom::test {
namespace {

using Event = QueuedEvent<double>;

/// The tie rule in words: time, then lower id, then higher id (walls are negative).
bool earlier(const Event& a, const Event& b) { return std::tie(a.time, a.lower, a.higher) < std::tie(b.time, b.lower, b.higher); }

Event earliest(const std::vector<Event>& events) { return *std::min_element(events.begin(), events.end(), earlier); }

rc::Gen<double> extreme_time() {
  return rc::gen::weightedOneOf<double>(
      {{4, rc::gen::element(0.0, -0.0, 1.0, 1.0, std::nextafter(1.0, 2.0))},
       {2, rc::gen::element(infinity<double>, std::numeric_limits<double>::max(), 1e300)},
       {2, rc::gen::element(std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::min(), 1e-310)},
       {1, rc::gen::map(rc::gen::inRange(0, 4), [](int k) { return 1e16 * k; })},
       {2, rc::gen::map(rc::gen::inRange(0, 1'000'000), [](int k) { return 1e-3 * k; })}});
}

/// A plan of `disk`, with a partner, a wall or a cell crossing.
rc::Gen<Event> plan_of(std::int32_t disk, std::int32_t disks) {
  return rc::gen::map(rc::gen::pair(extreme_time(), rc::gen::inRange<std::int32_t>(-5, disks)),
                      [disk](const std::pair<double, std::int32_t>& drawn) {
                        const std::int32_t partner = drawn.second == -5 ? -100 : drawn.second == disk ? -1 : drawn.second;
                        return Event{drawn.first, partner < 0 ? disk : std::min(disk, partner),
                                     partner < 0 ? partner : std::max(disk, partner), disk};
                      });
}

/// The two may hold the same event twice, as plans of either partner; which of these is on top does not matter.
void require_same(const Event& got, const Event& expected) {
  RC_ASSERT(got.time == expected.time);
  RC_ASSERT(got.lower == expected.lower);
  RC_ASSERT(got.higher == expected.higher);
}

RC_GTEST_PROP(PropertyEventQueue, NextIsTheEarliestWhateverIsUpdated, ()) {
  const auto disks = *rc::gen::inRange<std::int32_t>(1, 40);
  std::vector<Event> model;
  for (std::int32_t i = 0; i < disks; ++i) model.push_back(*plan_of(i, disks));
  EventQueue<double> queue;
  queue.assign(model);
  require_same(queue.next(), earliest(model));
  const auto updates = *rc::gen::inRange(0, 200);
  for (int k = 0; k < updates; ++k) {
    // Mostly the event on top is replaced, as the loop does.
    const std::int32_t disk = *rc::gen::inRange(0, 3) > 0 ? queue.next().disk : *rc::gen::inRange<std::int32_t>(0, disks);
    const Event event = *plan_of(disk, disks);
    model[static_cast<std::size_t>(disk)] = event;
    queue.update(event);
    require_same(queue.next(), earliest(model));
    RC_ASSERT(model[static_cast<std::size_t>(queue.next().disk)].time == queue.next().time);
  }
}

RC_GTEST_PROP(PropertyEventQueue, ServesAllEventsInOrderWhenEachIsSentToInfinity, ()) {
  const auto disks = *rc::gen::inRange<std::int32_t>(1, 100);
  std::vector<Event> model;
  for (std::int32_t i = 0; i < disks; ++i) model.push_back(*plan_of(i, disks));
  EventQueue<double> queue;
  queue.assign(model);
  std::stable_sort(model.begin(), model.end(), earlier);
  for (const Event& expected : model) {
    if (expected.time == infinity<double>) break;
    require_same(queue.next(), expected);
    const std::int32_t disk = queue.next().disk;
    queue.update({infinity<double>, disk, std::numeric_limits<std::int32_t>::max(), disk});
  }
}

TEST(EventQueue, IsEmptyBeforeAndAfterNoEvents) {
  EventQueue<double> queue;
  EXPECT_TRUE(queue.empty());
  queue.assign({{1.0, 0, 1, 0}, {1.0, 0, 1, 1}});
  EXPECT_FALSE(queue.empty());
  queue.assign({});
  EXPECT_TRUE(queue.empty());
}

TEST(EventQueue, AssignForgetsWhatWasThere) {
  EventQueue<double> queue;
  queue.assign({{1.0, 0, 2, 0}, {2.0, 1, -1, 1}, {1.0, 0, 2, 2}});
  queue.assign({{7.0, 0, -1, 0}, {6.0, 1, -1, 1}});
  EXPECT_EQ(queue.next().disk, 1);
  queue.update({8.0, 1, -1, 1});
  EXPECT_EQ(queue.next().time, 7.0);
}

TEST(EventQueue, TiesGoToTheLowerIdThenToTheOtherIdWallsFirst) {
  const std::vector<Event> in_order = {{1.0, 2, -100, 2}, {1.0, 2, -4, 3}, {1.0, 2, -1, 4}, {1.0, 2, 5, 5},
                                       {1.0, 2, 9, 6},    {1.0, 3, -1, 1}, {1.0, 4, 5, 0}};
  for (std::size_t a = 0; a < in_order.size(); ++a) {
    for (std::size_t b = 0; b < in_order.size(); ++b) EXPECT_EQ(in_order[a].before(in_order[b]), a < b) << a << " " << b;
  }
}

TEST(EventQueue, ZeroAndNegativeZeroAreTheSameTime) {
  const Event low{0.0, 0, 1, 0};
  const Event high{-0.0, 0, 2, 2};
  EXPECT_TRUE(low.before(high));
  EXPECT_FALSE(high.before(low));
}

TEST(EventQueue, EarlierTimeWinsOverEveryTieRule) {
  const Event late{std::nextafter(1.0, 2.0), 0, -100, 0};
  const Event early{1.0, 7, 9, 7};
  EXPECT_TRUE(early.before(late));
  EXPECT_TRUE(late.before({infinity<double>, 0, -100, 0}));
}

}  // namespace
}  // namespace carom::test
