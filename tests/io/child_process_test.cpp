// Child processes: what they get, how they end, and that none is left behind.

#include "io/child_process.hpp"

#include <gmock/gmock.h>

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <string>
#include <system_error>

namespace carom::test {
namespace {

ChildProcess shell(const char* script, int errors = -1) {
  return ChildProcess("/bin/sh", {"sh", "-c", script}, {.errors = errors});
}

/// Runs a script and returns what it writes to its standard error.
std::string errors_of(const char* script) {
  std::array<int, 2> ends{};
  EXPECT_EQ(pipe2(ends.data(), O_CLOEXEC), 0);
  {
    ChildProcess child = shell(script, ends[1]);
    close(ends[1]);
    child.wait();
  }
  std::array<char, 256> bytes{};
  const ssize_t count = read(ends[0], bytes.data(), bytes.size());
  close(ends[0]);
  return {bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0))};
}

TEST(ChildProcess, GivesItsExitCodeAndTheSignalThatEndedIt) {
  EXPECT_EQ(WEXITSTATUS(shell("exit 7").wait()), 7);
  const int killed = shell("kill -TERM $$").wait();
  EXPECT_TRUE(WIFSIGNALED(killed));
  EXPECT_EQ(WTERMSIG(killed), SIGTERM);
}

TEST(ChildProcess, HasAnEmptyInputAndWritesItsErrorsWhereAsked) {
  EXPECT_EQ(errors_of("cat; echo here >&2; echo not here"), "here\n");
}

TEST(ChildProcess, ObeysSignalsThatThisProcessIgnores) {
  const auto before = signal(SIGUSR1, SIG_IGN);
  const int status = shell("kill -USR1 $$").wait();
  signal(SIGUSR1, before);
  EXPECT_TRUE(WIFSIGNALED(status));
}

TEST(ChildProcess, IsKilledWithItsObject) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe2(ends.data(), O_CLOEXEC), 0);
  {
    ChildProcess child = shell("exec sleep 1000", ends[1]);
    close(ends[1]);
    EXPECT_FALSE(child.has_ended());
  }
  char byte = 0;
  EXPECT_EQ(read(ends[0], &byte, 1), 0) << "its end of the pipe is closed";
  close(ends[0]);
}

TEST(ChildProcess, ThatCannotBeStartedIsAnError) {
  try {
    const ChildProcess child("/no/such/program", {"program"}, {});
    FAIL();
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code(), std::errc::no_such_file_or_directory);
  }
}

}  // namespace
}  // namespace carom::test
