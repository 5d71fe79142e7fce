// The engine's future event lists alone, in the pattern of event_queue_bench.cpp: take the first event, replace it and one other
// by later ones. A calendar of any size; a tournament, which is what the engine uses where disks are few.

#include "queue/calendar_queue.hpp"
#include "queue/tournament_queue.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace {

struct Events {
  std::vector<double> times;

  [[nodiscard]] double time(std::int32_t disk) const { return times[static_cast<std::size_t>(disk)]; }
  [[nodiscard]] std::int32_t other(std::int32_t disk) const { return disk; }
  [[nodiscard]] bool precedes(const carom::FutureEvent& a, const carom::FutureEvent& b) const { return a.disk < b.disk; }
};

/// A calendar, used as the engine does at a collision.
class Calendar {
 public:
  void start(const Events& /*events*/, std::int32_t disks) {
    queue_.start(pushed_per_span / (2.0 * disks), static_cast<std::size_t>(disks), std::numeric_limits<double>::infinity());
  }
  void push(const Events& events, std::int32_t i) { queue_.push(events, {events.time(i), i, i}); }
  carom::Upcoming next(const Events& events) {
    const auto& next = *queue_.next(events, [](std::int64_t) {});
    return {next.time, next.disk};
  }
  void pop(const Events& events, std::int32_t /*other*/) { queue_.pop(events); }
  void push(const Events& events, std::int32_t i, std::int32_t j) { push(events, i), push(events, j); }

 private:
  /// As in EventLoop: two pushes per step, and as many steps in a unit of time as there are disks.
  static constexpr double pushed_per_span = 6.0;
  carom::CalendarQueue<Events> queue_;
};

class Tournament {
 public:
  void start(const Events& /*events*/, std::int32_t disks) { queue_.start(static_cast<std::size_t>(disks)); }
  void push(const Events& events, std::int32_t i) { queue_.push(i, events.time(i)); }
  carom::Upcoming next(const Events& events) { return queue_.next(events); }
  void pop(const Events& events, std::int32_t other) { queue_.pop(events, other); }
  void push(const Events& events, std::int32_t i, std::int32_t j) { queue_.push(i, events.time(i), j, events.time(j)); }

 private:
  carom::TournamentQueue<Events> queue_;
};

template <class List>
class Course {
 public:
  explicit Course(std::int32_t disks) : any_other_(1, disks - 1), disks_(disks) {
    list_.start(events_, disks);
    for (std::int32_t i = 0; i < disks; ++i) {
      events_.times.push_back(wait_(random_));
      list_.push(events_, i);
    }
  }

  /// The time of the event taken.
  double step() {
    const auto [time, disk] = list_.next(events_);
    const std::int32_t other = (disk + any_other_(random_)) % disks_;
    list_.pop(events_, other);
    for (const std::int32_t i : {disk, other}) events_.times[static_cast<std::size_t>(i)] = time + wait_(random_);
    list_.push(events_, disk, other);
    return time;
  }

  [[nodiscard]] double earliest() const { return *std::min_element(events_.times.begin(), events_.times.end()); }

 private:
  std::mt19937_64 random_{1};
  std::exponential_distribution<double> wait_{1.0};
  std::uniform_int_distribution<std::int32_t> any_other_;
  std::int32_t disks_;
  Events events_;
  List list_;
};

template <class List>
void replace_first_and_another(benchmark::State& state) {
  const auto n = static_cast<std::int32_t>(state.range(0));
  Course<List> course(n);
  for (std::int32_t k = 0; k < 10'000'000 / n; ++k) {
    const double first = course.earliest();
    if (course.step() != first) {
      state.SkipWithError("the list did not give the first event");
      return;
    }
  }
  double now = 0.0;
  for (auto _ : state) {
    const double next = course.step();
    if (next < now) {
      state.SkipWithError("the list gave an event out of order");
      return;
    }
    now = next;
  }
}

BENCHMARK(replace_first_and_another<Calendar>)
    ->Name("calendar_replace_first_and_another")
    ->RangeMultiplier(10)
    ->Range(1'000, 1'000'000);
BENCHMARK(replace_first_and_another<Tournament>)
    ->Name("tournament_replace_first_and_another")
    ->RangeMultiplier(10)
    ->Range(1'000, 10'000);

}  // namespace
