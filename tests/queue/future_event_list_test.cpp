// The engine's future event lists, with all instruction sets, against their obvious twin under times that none of them likes: the
// calendar, the tournament, and the one that chooses.

#include "queue/future_event_list.hpp"

#include "support/event_trial.hpp"
#include "support/instructions.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

namespace carom::test {
namespace {

constexpr double never = infinity<double>;

struct InCalendar {
  bool far;
  CalendarQueue<Events> queue;

  void start(const Trial& trial) { queue.start(trial.span, static_cast<std::size_t>(trial.disks), never, far); }
  Upcoming next(const Events& events) {
    const auto* next = queue.next(events, no_look);
    return next != nullptr ? Upcoming{next->time, next->disk} : Upcoming{never, 0};
  }
  void pop(const Events& events) { queue.pop(events); }
  void pop(const Events& events, std::int32_t /*other*/) { queue.pop(events); }
  void push(const Events& events, std::int32_t i) { queue.push(events, {events.time(i), i, events.other(i)}); }
  void push(const Events& events, std::int32_t i, std::int32_t j) { push(events, i), push(events, j); }
  bool holds(const Events& events, std::int32_t i) { return queue.holds(events, i); }
};

struct InTournament {
  TournamentQueue<Events> queue;

  void start(const Trial& trial) { queue.start(static_cast<std::size_t>(trial.disks)); }
  Upcoming next(const Events& events) { return queue.next(events); }
  void pop(const Events& events) { queue.pop(events); }
  void pop(const Events& events, std::int32_t other) { queue.pop(events, other); }
  void push(const Events& events, std::int32_t i) { queue.push(i, events.time(i)); }
  void push(const Events& events, std::int32_t i, std::int32_t j) { queue.push(i, events.time(i), j, events.time(j)); }
  bool holds(const Events& events, std::int32_t i) { return queue.holds(events, i); }
};

struct InEither {
  FutureEventList<Events> list;

  void start(const Trial& trial) { list.start(trial.span, static_cast<std::size_t>(trial.disks), never, false); }
  Upcoming next(const Events& events) { return list.next(events, no_look); }
  void pop(const Events& events) { list.pop(events); }
  void pop(const Events& events, std::int32_t other) { list.pop(events, other); }
  void push(const Events& events, std::int32_t i) { list.push(events, i, events.time(i)); }
  void push(const Events& events, std::int32_t i, std::int32_t j) { list.push(events, i, events.time(i), j, events.time(j)); }
  bool holds(const Events& events, std::int32_t i) { return list.holds(events, i); }
};

void expect_as_twin(const Trial& trial, std::uint64_t seed) {
  for (const std::string_view set : instruction_sets) {
    const WithInstructions asked(set);
    for (const bool far : {false, true}) expect_as_twin(trial, seed, InCalendar{far, {}});
    expect_as_twin(trial, seed, InTournament{});
    expect_as_twin(trial, seed, InEither{});
  }
}

TEST(FutureEventList, ServesExponentialWaitsInOrderWhateverItsSpan) {
  const Draw draw = [](Random& random, double now) { return now + exponential(random); };
  for (const std::int32_t disks : {1, 2, 3, 17, 100, 700})
    for (const double span : {6.0 / disks, 1e-4, 1.0, 1e6}) expect_as_twin({disks, span, 2000, draw}, 1);
}

TEST(FutureEventList, ServesAnyNumberOfDisksInOrder) {
  const Draw draw = [](Random& random, double now) { return now + exponential(random); };
  for (const std::int32_t disks : {31, 32, 33, 1023, 1024, 1025, 5000}) expect_as_twin({disks, 1e-3, 1500, draw}, 2);
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

TEST(FutureEventList, ServesEventsAtOneInstantByTheRankOfTheirDisks) { expect_ties_in_order(Ranks::of_disks); }

TEST(FutureEventList, ServesEventsAtOneInstantByTheirOwnRank) { expect_ties_in_order(Ranks::of_events); }

TEST(FutureEventList, ServesWaitsThatDifferByTwentyFourDecadesInOrder) {
  const Draw draw = [](Random& random, double now) { return now + std::pow(10.0, -12.0 + 24.0 * unit(random)); };
  for (const double span : {1e-12, 1e-6, 1.0, 1e6}) expect_as_twin({60, span, 1500, draw}, 8);
}

TEST(FutureEventList, ServesTimesUpToTheLargestNumberInOrder) {
  const Draw far = [](Random& random, double now) {
    const double kind = unit(random);
    if (kind < 0.3) return never;
    if (kind < 0.5) return std::max(now, 1e300 * unit(random));
    if (kind < 0.55) return std::numeric_limits<double>::max();
    if (kind < 0.6) return std::max(now, std::ldexp(1.0, below(random, 1023)));
    return now + exponential(random);
  };
  for (const double span : {1e-300, 1e-6, 1.0, 1e300}) expect_as_twin({40, span, 3000, far}, 9);
}

TEST(FutureEventList, ServesTwoEventsAtOneTimeInOrderWhereverTheyAre) {
  // A few have the same time: two of one group of a tournament now and then, and no others.
  const Draw dyadic = [](Random& random, double now) { return now + 0x1p-10 * (1 + below(random, 3000)); };
  for (const std::int32_t disks : {64, 1000, 1500})
    for (const Ranks ranks : {Ranks::of_disks, Ranks::of_disks_falling})
      expect_as_twin({disks, 0.01, 3000, dyadic, 1, ranks}, 13);
}

TEST(FutureEventList, ServesAnyNumberOfEventsFromOneSpan) {
  // All within one span, or all in the same few: 16 ids find room in a span, the others spill.
  const Draw near = [](Random& random, double now) { return now + 1e-9 * unit(random); };
  const Draw crowded = [](Random& random, double now) { return std::floor(now / 10.0) * 10.0 + 10.0 * (1 + below(random, 2)); };
  const Draw crowds = [](Random& random, double now) { return std::floor(now) + 1.0 + 1e-3 * unit(random) + below(random, 5); };
  for (const std::int32_t disks : {15, 16, 17, 33, 49, 200, 1000}) {
    expect_as_twin({disks, 1e9, 1000, near}, 10);
    expect_as_twin({disks, 1.0, 1000, crowded, 3}, 11);
    expect_as_twin({disks, 0.5, 1000, crowds, 3}, 12);
  }
}

RC_GTEST_PROP(PropertyFutureEventList, AnyMixtureOfWaitsIsServedInOrder, ()) {
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  const int lowest = *rc::gen::inRange(-14, 3), range = *rc::gen::inRange(0, 16);
  const double ties = *rc::gen::element(0.0, 0.1, 0.9), none = *rc::gen::element(0.0, 0.1, 0.5);
  const double grid = *rc::gen::element(0.0, 0.25, 1.0, 64.0);
  const Draw draw = [=](Random& random, double now) {
    if (unit(random) < none) return never;
    if (unit(random) < ties) return now;
    const double time = now + std::pow(10.0, lowest + range * unit(random));
    return grid > 0.0 ? std::max(now, std::floor(time / grid) * grid) : time;
  };
  const Trial trial{*rc::gen::element(1, 2, 10, 60, 250), std::pow(10.0, *rc::gen::inRange(-15, 10)), 600, draw,
                    *rc::gen::inRange(0, 4)};
  expect_as_twin(trial, seed);
  RC_ASSERT(!::testing::Test::HasFatalFailure());
}

TEST(FutureEventList, LeavesManyEventsAtOneTimeToTheCalendarUntilTheNextStart) {
  const std::int32_t disks = 1000;
  Events events(static_cast<std::size_t>(disks));
  FutureEventList<Events> list;
  const auto push_all = [&] {
    list.start(1.0, static_cast<std::size_t>(disks), never, false);
    for (std::int32_t i = 0; i < disks; ++i) {
      events.set(i, 3.0, i);
      list.push(events, i, 3.0);
    }
  };
  push_all();
  if (!list.predicts_next()) GTEST_SKIP() << "no vector instructions here, so a calendar in any case";
  const std::uint64_t pushed = list.pushed();
  for (std::int32_t i = 0; i < disks; ++i) {
    ASSERT_EQ(list.next(events, no_look).disk, i);
    EXPECT_FALSE(list.predicts_next());
    EXPECT_EQ(list.pushed(), pushed);
    list.pop(events);
    events.set(i, never, i);
    list.push(events, i, never);
  }
  EXPECT_EQ(list.next(events, no_look).time, never);
  push_all();
  EXPECT_TRUE(list.predicts_next());
}

TEST(FutureEventList, CountsEventsOnWhereTheyGoToTheCalendarAndSomeAreBeyondTheEnd) {
  Events events(100);
  FutureEventList<Events> list;
  list.start(1.0, 100, 10.0, false);
  if (!list.predicts_next()) GTEST_SKIP() << "no vector instructions here, so a calendar in any case";
  for (std::int32_t i = 0; i < 100; ++i) {
    events.set(i, i < 50 ? 3.0 : 20.0, i);
    list.push(events, i, events.time(i));
  }
  ASSERT_EQ(list.pushed(), 100u);
  ASSERT_EQ(list.next(events, no_look).disk, 0);
  ASSERT_FALSE(list.predicts_next());
  EXPECT_EQ(list.pushed(), 100u);
  list.pop(events);
  events.set(0, 4.0, 0);
  list.push(events, 0, 4.0);
  EXPECT_EQ(list.pushed(), 101u);
}

TEST(TournamentQueue, ServesInOrderAfterMostEventsHaveBeenReplacedAtOnce) {
  Random random(16);
  Events events(3000);
  TournamentQueue<Events> queue;
  queue.start(3000);
  const auto set_all = [&](double from) {
    for (std::int32_t i = 0; i < 3000; ++i) {
      events.set(i, from + unit(random), i);
      queue.push(i, events.time(i));
    }
  };
  set_all(0.0);
  for (int k = 0; k < 20; ++k) {
    const Upcoming next = queue.next(events);
    ASSERT_EQ(next.disk, events.earliest());
    queue.pop(events);
    events.set(next.disk, infinity<double>, next.disk);
    queue.push(next.disk, infinity<double>);
    if (k % 5 == 4) set_all(next.time);
  }
}

TEST(TournamentQueue, PredictsTheNextEventWhileTheOneBeforeIsHandled) {
  Events events(40);
  TournamentQueue<Events> queue;
  queue.start(40);
  for (std::int32_t i = 0; i < 40; ++i) {
    events.set(i, 1.0 + i, i);
    queue.push(i, events.time(i));
  }
  ASSERT_EQ(queue.next(events).disk, 0);
  queue.pop(events, 1);  // 0 meets 1: neither has an event now
  EXPECT_EQ(queue.predicted_next(), 2);
  events.set(0, 2.5, 0), events.set(1, 50.0, 1);
  queue.push(0, 2.5, 1, 50.0);
  EXPECT_EQ(queue.next(events).disk, 0) << "a new event that is earlier";
  queue.pop(events);
  EXPECT_EQ(queue.predicted_next(), 2);
  events.set(0, 60.0, 0);
  queue.push(0, 60.0);
  EXPECT_EQ(queue.next(events).disk, 2);
}

TEST(Tournament, FindsTheDiskOfAGroupThatHasATime) {
  for (const std::string_view set : instruction_sets) {
    const WithInstructions asked(set);
    const TournamentKernel& kernel = tournament_kernel(2);
    Random random(15);
    alignas(64) double group[tournament_group];
    for (int k = 0; k < 1000; ++k) {
      const std::int32_t values = 1 + below(random, 40);
      for (double& time : group) time = below(random, values);
      const double time = below(random, values);
      std::uint32_t bits = 0;
      for (std::size_t n = 0; n < tournament_group; ++n)
        if (group[n] == time) bits |= 1U << n;
      ASSERT_EQ(kernel.among(group, time), bits) << set;
    }
  }
}

}  // namespace
}  // namespace carom::test
