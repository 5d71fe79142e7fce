// The event queue alone, in the pattern of a run: take the first event, replace it and one other by later ones.

#include "queue/event_queue.hpp"

#include <benchmark/benchmark.h>

#include <random>

namespace {

void replace_first_and_another(benchmark::State& state) {
  const auto n = static_cast<std::int32_t>(state.range(0));
  std::mt19937_64 random(1);
  std::exponential_distribution<double> wait(1.0);
  std::uniform_int_distribution<std::int32_t> any(0, n - 1);
  std::vector<carom::QueuedEvent<double>> events;
  for (std::int32_t i = 0; i < n; ++i) events.push_back({wait(random), i, i, i});
  carom::EventQueue<double> queue;
  queue.assign(events);
  double now = 0.0;
  for (auto _ : state) {
    const auto next = queue.next();
    if (next.time < now) {
      state.SkipWithError("the queue gave an event out of order");
      return;
    }
    now = next.time;
    queue.update({now + wait(random), next.disk, next.disk, next.disk});
    const std::int32_t other = any(random);
    queue.update({now + wait(random), other, other, other});
  }
}

BENCHMARK(replace_first_and_another)->RangeMultiplier(10)->Range(1'000, 1'000'000);

}  // namespace
