// A command that reads in a child process: its exit code, and what is said where the child does not come back.

#include "terminal/reading_process.hpp"

#include "terminal/signals.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/time.h>

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace carom::cli {
namespace {

using ::testing::ExitedWithCode;

/// Ends this process as the program would end. Called in a process of its own, which becomes two.
[[noreturn]] void run(const std::function<ExitCode()>& command) {
  try {
    std::exit(in_reading_process("some.h5md", command));
  } catch (const UsageError& error) {
    std::fprintf(stderr, "usage: %s\n", error.what());
    std::exit(exit_usage);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "failed: %s\n", error.what());
    std::exit(exit_failed);
  }
}

ExitCode raised(int number) {
  signal(number, SIG_DFL);
  raise(number);
  return exit_done;
}

TEST(ReadingProcessTest, ReturnsWhatTheCommandReturns) {
  EXPECT_EXIT(run([] { return exit_done; }), ExitedWithCode(0), "");
  EXPECT_EXIT(run([] { return exit_check_failed; }), ExitedWithCode(4), "");
  EXPECT_EXIT(run([]() -> ExitCode { throw UsageError("no such file"); }), ExitedWithCode(2), "^usage: no such file\n$");
}

TEST(ReadingProcessTest, WhatComesAfterItIsDoneOnce) {
  EXPECT_EXIT(
      {
        const ExitCode code = in_reading_process("some.h5md", [] { return exit_check_failed; });
        std::fputs("once\n", stderr);
        std::exit(code);
      },
      ExitedWithCode(4), "^once\n$");
}

TEST(ReadingProcessTest, ASignalThatSaysNothingOfTheFileIsPassedOn) {
  EXPECT_EXIT(run([] { return raised(SIGPIPE); }), ::testing::KilledBySignal(SIGPIPE), "^$");
}

TEST(ReadingProcessTest, ACrashIsOneSentence) {
  for (const int number : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE})
    EXPECT_EXIT(run([=] { return raised(number); }), ExitedWithCode(2),
                "^usage: some.h5md: reading it ends in a crash .*damaged.*\n$");
}

TEST(ReadingProcessTest, ReadingWithoutEndIsOneSentence) {
  EXPECT_EXIT(run([] { return raised(SIGPROF); }), ExitedWithCode(2), "^usage: some.h5md: reading it does not end.*\n$");
}

TEST(ReadingProcessTest, AnInterruptIsAnInterrupt) {
  for (const int number : stopping_signals) EXPECT_EXIT(run([=] { return raised(number); }), ExitedWithCode(130), "^$") << number;
  EXPECT_EXIT(run([] { return raised(SIGKILL); }), ExitedWithCode(1), "^failed: some.h5md: .*memory\n$");
}

TEST(ReadingProcessTest, TheLimitIsOfProcessorTimeAndEndsWithItsOwner) {
  itimerval left{};
  {
    const ReadingLimit limit("/no/such/file");
    getitimer(ITIMER_PROF, &left);
    EXPECT_GE(left.it_value.tv_sec, 10);
  }
  getitimer(ITIMER_PROF, &left);
  EXPECT_EQ(left.it_value.tv_sec, 0);
  EXPECT_EQ(left.it_value.tv_usec, 0);
}

}  // namespace
}  // namespace carom::cli
