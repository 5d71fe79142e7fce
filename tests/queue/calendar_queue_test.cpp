// The calendar queue against its obvious twin, a list that is searched from end to end for the earliest event, under times
// that no calendar likes.

#include "queue/calendar_queue.hpp"

#include "core/real.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <tuple>
#include <vector>

namespace carom::test {
namespace {

/// The owner of the events, and the twin.
class Events {
 public:
  explicit Events(std::size_t disks) : events_(disks, Event{infinity<double>, 0}) {}

  [[nodiscard]] double time(std::int32_t disk) const { return at(disk).time; }
  [[nodiscard]] std::int32_t other(std::int32_t disk) const { return at(disk).rank; }
  [[nodiscard]] bool precedes(const CalendarEntry& a, const CalendarEntry& b) const { return a.other < b.other; }

  void set(std::int32_t disk, double time, std::int32_t rank) { events_[static_cast<std::size_t>(disk)] = {time, rank}; }
  [[nodiscard]] std::int32_t rank(std::int32_t disk) const { return at(disk).rank; }
  [[nodiscard]] std::int32_t count() const { return static_cast<std::int32_t>(events_.size()); }

  /// -1 where nothing is to come.
  [[nodiscard]] std::int32_t earliest() const {
    std::int32_t first = -1;
    for (std::int32_t i = 0; i < count(); ++i)
      if (time(i) < infinity<double> && (first < 0 || std::tuple(time(i), rank(i)) < std::tuple(time(first), rank(first))))
        first = i;
    return first;
  }

 private:
  struct Event {
    double time;
    std::int32_t rank;
  };
  [[nodiscard]] const Event& at(std::int32_t disk) const { return events_[static_cast<std::size_t>(disk)]; }
  std::vector<Event> events_;
};

using Queue = CalendarQueue<Events>;
using Random = std::mt19937_64;

const auto no_look = [](std::int64_t) {};

double unit(Random& random) { return std::uniform_real_distribution<double>(0.0, 1.0)(random); }
std::int32_t below(Random& random, std::int32_t n) { return std::uniform_int_distribution<std::int32_t>(0, n - 1)(random); }

/// Draws the time of a disk's next event, not before `now`.
using Draw = std::function<double(Random& random, double now)>;

/// What orders events at one time: who they belong to, or something that changes with every event, as the ids of two
/// partners do.
enum class Ranks { of_disks, of_events };

struct Trial {
  std::int32_t disks;
  double span;
  int events;
  Draw draw;
  int partners = 1;  ///< others that get a new event with each one taken
  Ranks ranks = Ranks::of_disks;
};

/// What a loop does: takes the next event, gives its disk and some others new ones, and so on. `far`: ids wait for their spans.
void expect_as_twin(const Trial& trial, std::uint64_t seed, bool far) {
  Random random(seed);
  Events events(static_cast<std::size_t>(trial.disks));
  Queue queue;
  const auto schedule = [&](std::int32_t disk, double now) {
    events.set(disk, trial.draw(random, now), trial.ranks == Ranks::of_disks ? disk : below(random, trial.disks));
    if (events.time(disk) < infinity<double>) queue.push(events, {events.time(disk), disk, events.other(disk)});
  };
  const auto start = [&] {
    queue.start(trial.span, static_cast<std::size_t>(trial.disks), far);
    for (std::int32_t i = 0; i < trial.disks; ++i) schedule(i, 0.0);
  };
  start();
  double last = 0.0;
  for (int k = 0; k < trial.events; ++k) {
    const std::int32_t expected = events.earliest();
    const auto* next = queue.next(events, no_look);
    ASSERT_EQ(next != nullptr, expected >= 0) << "event " << k;
    if (next == nullptr) {
      last = 0.0;
      start();
      continue;
    }
    ASSERT_EQ(next->time, events.time(expected)) << "event " << k;
    ASSERT_EQ(events.rank(next->disk), events.rank(expected)) << "event " << k << " at time " << next->time;
    ASSERT_EQ(next, queue.next(events, no_look)) << "asked again";
    last = next->time;
    const std::int32_t disk = next->disk;
    queue.pop(events);
    schedule(disk, last);
    for (int n = 0; n < trial.partners; ++n) schedule(below(random, trial.disks), last);
    if (k % 64 == 0) {
      for (std::int32_t i = 0; i < trial.disks; ++i)
        if (events.time(i) < infinity<double>) {
          ASSERT_TRUE(queue.holds(events, i)) << "disk " << i << " at time " << events.time(i) << ", event " << k;
        }
    }
  }
}

void expect_as_twin(const Trial& trial, std::uint64_t seed) {
  for (const bool far : {false, true}) expect_as_twin(trial, seed, far);
}

double exponential(Random& random) { return -std::log(1.0 - unit(random)); }

TEST(CalendarQueue, ServesExponentialWaitsInOrderWhateverItsSpan) {
  const Draw draw = [](Random& random, double now) { return now + exponential(random); };
  for (const std::int32_t disks : {1, 2, 3, 17, 100, 700})
    for (const double span : {6.0 / disks, 1e-4, 1.0, 1e6}) expect_as_twin({disks, span, 2000, draw}, 1);
}

TEST(CalendarQueue, ServesThousandsOfDisksInOrder) {
  const Draw draw = [](Random& random, double now) { return now + exponential(random); };
  expect_as_twin({5000, 1e-3, 4000, draw}, 2);
}

void expect_ties_in_order(Ranks ranks) {
  for (const std::int32_t disks : {2, 5, 16, 40, 300}) {
    expect_as_twin({disks, 1.0, 300, [](Random&, double) { return 0.0; }, 1, ranks}, 3);
    expect_as_twin({disks, 1.0, 300, [](Random&, double) { return 7.25; }, 1, ranks}, 4);
    // Some now, some at the next instants: stale ids keep lying among those that count.
    const Draw soon = [](Random& random, double now) { return std::floor(now) + below(random, 3); };
    const Draw later = [](Random& random, double now) { return std::floor(now) + 5 * below(random, 3); };
    expect_as_twin({disks, 1.0, 3000, soon, 1, ranks}, 5);
    expect_as_twin({disks, 100.0, 3000, soon, 1, ranks}, 6);
    expect_as_twin({disks, 0.01, 3000, later, 3, ranks}, 7);
  }
}

TEST(CalendarQueue, ServesEventsAtOneInstantByTheRankOfTheirDisks) { expect_ties_in_order(Ranks::of_disks); }

TEST(CalendarQueue, ServesEventsAtOneInstantByTheirOwnRank) { expect_ties_in_order(Ranks::of_events); }

TEST(CalendarQueue, ServesWaitsThatDifferByTwentyFourDecadesInOrder) {
  const Draw draw = [](Random& random, double now) { return now + std::pow(10.0, -12.0 + 24.0 * unit(random)); };
  for (const double span : {1e-12, 1e-6, 1.0, 1e6}) expect_as_twin({60, span, 1500, draw}, 8);
}

TEST(CalendarQueue, ServesTimesUpToTheLargestNumberInOrder) {
  const Draw far = [](Random& random, double now) {
    const double kind = unit(random);
    if (kind < 0.3) return infinity<double>;
    if (kind < 0.5) return std::max(now, 1e300 * unit(random));
    if (kind < 0.55) return std::numeric_limits<double>::max();
    if (kind < 0.6) return std::max(now, std::ldexp(1.0, below(random, 1023)));
    return now + exponential(random);
  };
  for (const double span : {1e-300, 1e-6, 1.0, 1e300}) expect_as_twin({40, span, 3000, far}, 9);
}

TEST(CalendarQueue, ServesAnyNumberOfEventsFromOneSpan) {
  // All within one span, or all in the same few: 16 ids find room in a span, the others spill.
  const Draw near = [](Random& random, double now) { return now + 1e-9 * unit(random); };
  const Draw crowded = [](Random& random, double now) { return std::floor(now / 10.0) * 10.0 + 10.0 * (1 + below(random, 2)); };
  const Draw crowds = [](Random& random, double now) { return std::floor(now) + 1.0 + 1e-3 * unit(random) + below(random, 5); };
  for (const std::int32_t disks : {15, 16, 17, 33, 49, 200, 1000}) {
    expect_as_twin({disks, 1e9, 1500, near}, 10);
    expect_as_twin({disks, 1.0, 1500, crowded, 3}, 11);
    expect_as_twin({disks, 0.5, 1500, crowds, 3}, 12);
  }
}

TEST(CalendarQueue, KeepsADiskThatIsRescheduledToTheSameSpanOrTimeAgainAndAgain) {
  for (const bool same_time : {false, true}) {
    Events events(8);
    Queue queue;
    queue.start(1.0, 8);
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
  queue.start(0.1, 3);
  for (std::int32_t i = 0; i < 3; ++i) {
    events.set(i, 2.0, i);
    queue.push(events, {2.0, i, events.other(i)});
  }
  for (int k = 0; k < 100; ++k) {  // disk 0 goes on for ever at this instant: nobody else gets a turn
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
  queue.start(1e-3, 2);
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
  queue.start(1.0, 2);
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
    queue.start(span, 500, span > 1.0);
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
  queue.start(1.0, 2);
  EXPECT_EQ(queue.next(events, no_look), nullptr);
  events.set(1, 0.25, 0);
  queue.push(events, {0.25, 1, events.other(1)});
  EXPECT_EQ(queue.next(events, no_look)->disk, 1);
}

TEST(CalendarQueue, AnnouncesEverySpanBeforeItsEventsInOrder) {
  Random random(14);
  Events events(100);
  Queue queue;
  queue.start(0.1, 100);
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

RC_GTEST_PROP(PropertyCalendarQueue, AnyMixtureOfWaitsIsServedInOrder, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  const int lowest = *rc::gen::inRange(-14, 3), range = *rc::gen::inRange(0, 16);
  const double ties = *rc::gen::element(0.0, 0.1, 0.9), none = *rc::gen::element(0.0, 0.1, 0.5);
  const double grid = *rc::gen::element(0.0, 0.25, 1.0, 64.0);
  const Draw draw = [=](Random& random, double now) {
    if (unit(random) < none) return infinity<double>;
    if (unit(random) < ties) return now;
    const double time = now + std::pow(10.0, lowest + range * unit(random));
    return grid > 0.0 ? std::max(now, std::floor(time / grid) * grid) : time;
  };
  const Trial trial{*rc::gen::element(1, 2, 10, 60, 250), std::pow(10.0, *rc::gen::inRange(-15, 10)), 600, draw,
                    *rc::gen::inRange(0, 4)};
  expect_as_twin(trial, seed);
  RC_ASSERT(!::testing::Test::HasFatalFailure());
}

}  // namespace
}  // namespace carom::test
