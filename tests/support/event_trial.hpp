#pragma once
// What a future event list is held against: its obvious twin, a list that is searched from end to end for the earliest event,
// under times that none of them likes.

#include "core/real.hpp"
#include "queue/future_event.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <tuple>
#include <vector>

namespace carom::test {

/// The owner of the events, and the twin.
class Events {
 public:
  explicit Events(std::size_t disks) : events_(disks, Event{infinity<double>, 0}) {}

  [[nodiscard]] double time(std::int32_t disk) const { return at(disk).time; }
  [[nodiscard]] std::int32_t other(std::int32_t disk) const { return at(disk).rank; }
  [[nodiscard]] bool precedes(const FutureEvent& a, const FutureEvent& b) const { return a.other < b.other; }

  void set(std::int32_t disk, double time, std::int32_t rank) { events_[static_cast<std::size_t>(disk)] = {time, rank}; }
  [[nodiscard]] std::int32_t count() const { return static_cast<std::int32_t>(events_.size()); }

  /// -1 where nothing is to come.
  [[nodiscard]] std::int32_t earliest() const {
    std::int32_t first = -1;
    for (std::int32_t i = 0; i < count(); ++i)
      if (time(i) < infinity<double> && (first < 0 || std::tuple(time(i), other(i)) < std::tuple(time(first), other(first))))
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

using Random = std::mt19937_64;

inline constexpr auto no_look = [](std::int64_t) {};

inline double unit(Random& random) { return std::uniform_real_distribution<double>(0.0, 1.0)(random); }
inline std::int32_t below(Random& random, std::int32_t n) {
  return std::uniform_int_distribution<std::int32_t>(0, n - 1)(random);
}

/// Draws the time of a disk's next event, not before `now`.
using Draw = std::function<double(Random& random, double now)>;

/// What orders events at one time: the disk they belong to, the first or the last disk first, or something that changes with
/// every event, as the ids of two partners do.
enum class Ranks { of_disks, of_disks_falling, of_events };

struct Trial {
  std::int32_t disks;
  double span;
  int events;
  Draw draw;
  int partners = 1;  ///< others that get a new event with each one taken
  Ranks ranks = Ranks::of_disks;
};

/// What a loop does: takes the next event, gives its disk and some others new ones, and so on.
///
/// List: `void start(const Trial&)`, `Upcoming next(const Events&)`, `void push(const Events&, std::int32_t disk)`, `bool
/// holds(const Events&, std::int32_t disk)`; `void pop(const Events&)`, and with a second disk `j` which has no event from then
/// on; `void push(const Events&, std::int32_t i, std::int32_t j)`.
template <class List>
void expect_as_twin(const Trial& trial, std::uint64_t seed, List&& list) {
  Random random(seed);
  Events events(static_cast<std::size_t>(trial.disks));
  const auto draw = [&](std::int32_t disk, double now) {
    const double time = trial.draw(random, now);
    events.set(disk, time,
               trial.ranks == Ranks::of_disks           ? disk
               : trial.ranks == Ranks::of_disks_falling ? trial.disks - disk
                                                        : below(random, trial.disks));
  };
  const auto schedule = [&](std::int32_t disk, double now) {
    draw(disk, now);
    list.push(events, disk);
  };
  const auto start = [&] {
    list.start(trial);
    for (std::int32_t i = 0; i < trial.disks; ++i) schedule(i, 0.0);
  };
  start();
  for (int k = 0; k < trial.events; ++k) {
    const std::int32_t expected = events.earliest();
    const Upcoming next = list.next(events);
    ASSERT_EQ(next.time < infinity<double>, expected >= 0) << "event " << k;
    if (expected < 0) {
      start();
      continue;
    }
    ASSERT_EQ(next.time, events.time(expected)) << "event " << k;
    ASSERT_EQ(events.other(next.disk), events.other(expected)) << "event " << k << " at time " << next.time;
    ASSERT_EQ(next.disk, list.next(events).disk) << "asked again";
    const std::int32_t other = below(random, trial.disks);
    if (trial.partners > 0 && other != next.disk && unit(random) < 0.5) {
      list.pop(events, other);
      draw(next.disk, next.time), draw(other, next.time);
      list.push(events, next.disk, other);
    } else {
      list.pop(events);
      schedule(next.disk, next.time);
    }
    for (int n = 1; n < trial.partners; ++n) schedule(below(random, trial.disks), next.time);
    if (k % 64 == 0) {
      for (std::int32_t i = 0; i < trial.disks; ++i)
        if (events.time(i) < infinity<double>) {
          ASSERT_TRUE(list.holds(events, i)) << "disk " << i << " at time " << events.time(i) << ", event " << k;
        }
    }
  }
}

inline double exponential(Random& random) { return -std::log(1.0 - unit(random)); }

}  // namespace carom::test
