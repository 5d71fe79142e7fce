// Pieces of work that threads share: each is done once, and one thread stops them all.

#include "studies/validate/in_threads.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <thread>

namespace carom::test {
namespace {

using validation::in_threads;

TEST(InThreads, DoEveryPieceOnceWhateverTheirNumber) {
  for (const unsigned threads : {1U, 2U, 3U, 100U}) {
    std::array<std::atomic<int>, 20> done{};
    EXPECT_TRUE(in_threads(done.size(), threads, {}, [&](std::size_t k, const std::function<bool()>& go_on) {
      EXPECT_TRUE(go_on());
      ++done[k];
    }));
    for (const std::atomic<int>& times : done) EXPECT_EQ(times, 1);
  }
  EXPECT_TRUE(in_threads(0, 2, {}, [](std::size_t, const std::function<bool()>&) { FAIL(); }));
}

TEST(InThreads, AskOnTheCallingThreadAloneEvenWhileItWaits) {
  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<bool> free = false;
  std::atomic<int> asked_since = 0;
  const auto proceed = [&] {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    return !free || ++asked_since < 3;
  };
  // The other thread works until the calling one, which has nothing left to do, is told to stop.
  std::atomic<int> begun = 0;
  EXPECT_FALSE(in_threads(2, 2, proceed, [&](std::size_t, const std::function<bool()>& go_on) {
    ++begun;
    while (begun < 2) std::this_thread::yield();
    if (std::this_thread::get_id() == caller) {
      free = true;
      return;
    }
    while (go_on()) std::this_thread::yield();
  }));
  EXPECT_EQ(asked_since, 3);
}

TEST(InThreads, BeginNothingMoreOnceToldToStop) {
  int begun = 0;
  EXPECT_FALSE(in_threads(
      5, 1, [&] { return begun < 2; },
      [&](std::size_t, const std::function<bool()>& go_on) {
        ++begun;
        (void)go_on();
      }));
  EXPECT_EQ(begun, 2);
}

TEST(InThreads, PassOnTheFirstExceptionAndStopTheOthers) {
  std::atomic<int> ended = 0;
  EXPECT_THROW((void)in_threads(2, 2, {},
                                [&](std::size_t k, const std::function<bool()>& go_on) {
                                  if (k == 1) throw std::runtime_error("no room");
                                  while (go_on()) std::this_thread::yield();
                                  ++ended;
                                }),
               std::runtime_error);
  EXPECT_EQ(ended, 1);
}

TEST(InThreads, PassOnWhatIsThrownWhileTheCallingThreadWaits) {
  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<int> begun = 0;
  std::atomic<bool> waits = false;
  const auto proceed = [&]() -> bool { return waits ? throw std::runtime_error("the disk is full") : true; };
  // The other thread works until it is told to stop: without that the call would not return.
  EXPECT_THROW((void)in_threads(2, 2, proceed,
                                [&](std::size_t, const std::function<bool()>& go_on) {
                                  ++begun;
                                  while (begun < 2) std::this_thread::yield();
                                  if (std::this_thread::get_id() == caller)
                                    waits = true;
                                  else
                                    while (go_on()) std::this_thread::yield();
                                }),
               std::runtime_error);
}

}  // namespace
}  // namespace carom::test
