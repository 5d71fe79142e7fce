// The engine's event queue alone, in the pattern of event_queue_bench.cpp: take the first event, replace it and one other
// by later ones.

#include "queue/calendar_queue.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace {

struct Events {
  std::vector<double> times;

  [[nodiscard]] double time(std::int32_t disk) const { return times[static_cast<std::size_t>(disk)]; }
  [[nodiscard]] std::int32_t other(std::int32_t disk) const { return disk; }
  [[nodiscard]] bool precedes(const carom::CalendarEntry& a, const carom::CalendarEntry& b) const { return a.disk < b.disk; }
};

class Course {
 public:
  explicit Course(std::int32_t disks) : any_(0, disks - 1) {
    for (std::int32_t i = 0; i < disks; ++i) events_.times.push_back(wait_(random_));
    queue_.start(pushed_per_span / (2.0 * disks), events_.times.size());
    for (std::int32_t i = 0; i < disks; ++i) queue_.push(events_, {events_.time(i), i, i});
  }

  /// The time of the event taken.
  double step() {
    const auto next = *queue_.next(events_, [](std::int64_t) {});
    queue_.pop(events_);
    replace(next.disk, next.time);
    replace(any_(random_), next.time);
    return next.time;
  }

  [[nodiscard]] double earliest() const { return *std::min_element(events_.times.begin(), events_.times.end()); }

 private:
  /// As in Engine: two pushes per step, and as many steps in a unit of time as there are disks.
  static constexpr double pushed_per_span = 6.0;

  void replace(std::int32_t disk, double now) {
    const double time = now + wait_(random_);
    events_.times[static_cast<std::size_t>(disk)] = time;
    queue_.push(events_, {time, disk, disk});
  }

  std::mt19937_64 random_{1};
  std::exponential_distribution<double> wait_{1.0};
  std::uniform_int_distribution<std::int32_t> any_;
  Events events_;
  carom::CalendarQueue<Events> queue_;
};

void calendar_replace_first_and_another(benchmark::State& state) {
  const auto n = static_cast<std::int32_t>(state.range(0));
  Course course(n);
  for (std::int32_t k = 0; k < 10'000'000 / n; ++k) {
    const double first = course.earliest();
    if (course.step() != first) {
      state.SkipWithError("the queue did not give the first event");
      return;
    }
  }
  double now = 0.0;
  for (auto _ : state) {
    const double next = course.step();
    if (next < now) {
      state.SkipWithError("the queue gave an event out of order");
      return;
    }
    now = next;
  }
}

BENCHMARK(calendar_replace_first_and_another)->RangeMultiplier(10)->Range(1'000, 1'000'000);

}  // namespace
