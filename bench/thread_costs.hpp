#pragma once
// The cost of a meeting of two threads, in nanoseconds: what every way to share out one run pays in.

#include <algorithm>
#include <atomic>
#include <barrier>
#include <chrono>
#include <cstdint>
#include <thread>
#include <vector>

namespace carom::bench {

struct ThreadCosts {
  std::vector<double> barrier;     ///< std::barrier: both arrive, both go on; sorted, one per round of many meetings
  std::vector<double> round_trip;  ///< a cache line there and back: one writes, the other sees it and answers; sorted
};

/// `meeting(side, k)` is what thread `side`, 0 or 1, does for meeting k. In rounds, for other programs interrupt some of them.
template <class Meeting>
std::vector<double> time_of_meetings(Meeting&& meeting) {
  constexpr std::int64_t rounds = 2000, meetings = 20;
  std::vector<double> nanoseconds;
  std::thread other([&] {
    for (std::int64_t k = 0; k < rounds * meetings; ++k) meeting(1, k);
  });
  for (std::int64_t round = 0; round < rounds; ++round) {
    const auto before = std::chrono::steady_clock::now();
    for (std::int64_t k = round * meetings; k < (round + 1) * meetings; ++k) meeting(0, k);
    const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - before;
    nanoseconds.push_back(taken.count() / meetings);
  }
  other.join();
  std::sort(nanoseconds.begin(), nanoseconds.end());
  return nanoseconds;
}

inline ThreadCosts thread_costs() {
  std::barrier barrier(2);
  alignas(64) std::atomic<std::int64_t> turn = 0;
  // A thread that waits gives way now and then, so that two of them get on where others hold the cores.
  const auto wait_for = [&turn](std::int64_t value) {
    for (int tries = 0; turn.load(std::memory_order_acquire) != value; ++tries)
      if (tries % 4096 == 4095) std::this_thread::yield();
  };
  ThreadCosts costs;
  costs.barrier = time_of_meetings([&](int, std::int64_t) { barrier.arrive_and_wait(); });
  costs.round_trip = time_of_meetings([&](int side, std::int64_t k) {
    wait_for(2 * k + side);
    turn.store(2 * k + side + 1, std::memory_order_release);
  });
  return costs;
}

}  // namespace carom::bench
