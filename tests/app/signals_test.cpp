// Which signals ask a run to stop, and which of them end it at once.

#include "terminal/signals.hpp"

#include <gtest/gtest.h>

#include <signal.h>  // raise of SIGHUP and the like is POSIX, not C++
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <thread>

namespace carom::cli {
namespace {

using ::testing::ExitedWithCode;
using ::testing::KilledBySignal;

void wait_longer_than_patience() { std::this_thread::sleep_for(std::chrono::milliseconds(550)); }

/// In a process of its own: exits with 1 where a stop was asked for, else with 0.
[[noreturn]] void tell(const std::function<void()>& happens) {
  const StopRequest stop;
  happens();
  _exit(stop.made() ? 1 : 0);
}

TEST(StopRequest, IsMadeByEachSignalThatAsksToStop) {
  EXPECT_EXIT(tell([] {}), ExitedWithCode(0), "");
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGUSR1})
    EXPECT_EXIT(tell([&] { raise(number); }), ExitedWithCode(1), "") << number;
}

TEST(StopRequest, ManyAtOnceAreOne) {
  const auto all = [] {
    for (int round = 0; round < 3; ++round)
      for (const int number : {SIGTERM, SIGINT, SIGHUP, SIGXCPU, SIGUSR1}) raise(number);
  };
  EXPECT_EXIT(tell(all), ExitedWithCode(1), "");
}

TEST(StopRequest, ASecondOneAfterHalfASecondEndsAtOnce) {
  for (const int second : {SIGINT, SIGTERM}) {
    const auto twice = [&] {
      raise(SIGTERM);
      wait_longer_than_patience();
      raise(second);
    };
    EXPECT_EXIT(tell(twice), KilledBySignal(second), "");
  }
}

TEST(StopRequest, WarningsNeverEndAtOnce) {
  // The kernel sends SIGXCPU every second; SIGTERM after a warning is the first that insists.
  const auto warnings = [] {
    raise(SIGUSR1);
    raise(SIGXCPU);
    wait_longer_than_patience();
    for (const int number : {SIGXCPU, SIGUSR1, SIGHUP, SIGTERM}) raise(number);
  };
  EXPECT_EXIT(tell(warnings), ExitedWithCode(1), "");
}

TEST(StopRequest, WhatIsIgnoredFromTheStartStaysIgnored) {
  const auto ignored = [] {
    signal(SIGHUP, SIG_IGN);
    tell([] { raise(SIGHUP); });
  };
  EXPECT_EXIT(ignored(), ExitedWithCode(0), "");
}

}  // namespace
}  // namespace carom::cli
