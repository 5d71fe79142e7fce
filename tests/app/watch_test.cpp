// carom run --watch on a terminal of its own (a pseudo-terminal), and without one.

#include "support/program_test.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>

namespace carom::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class WatchCommand : public ProgramTest {
 protected:
  WatchCommand() : ProgramTest(fifty_disks) {}

  /// Everything that the program shows on a terminal of this size.
  Outcome on_terminal(std::vector<std::string> words, unsigned short columns, unsigned short rows,
                      const char* language = "C.UTF-8") {
    words.insert(words.begin(), CAROM_PROGRAM);
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    winsize size{rows, columns, 0, 0};
    int terminal = -1;
    const pid_t child = forkpty(&terminal, nullptr, nullptr, &size);
    if (child == 0) {
      setenv("LC_ALL", language, 1);
      setenv("TERM", "xterm-256color", 1);
      unsetenv("NO_COLOR");
      unsetenv("COLORTERM");
      if (chdir(directory_.path().c_str()) == 0) execv(argv[0], argv.data());
      _exit(127);
    }
    Outcome outcome;
    std::array<char, 4096> part{};
    for (ssize_t got = 0; (got = read(terminal, part.data(), part.size())) > 0;)
      outcome.out.append(part.data(), static_cast<std::size_t>(got));
    int status = 0;
    waitpid(child, &status, 0);
    close(terminal);
    outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return outcome;
  }
};

TEST_F(WatchCommand, ShowsTheBoxAndTheGaugesAndThenTheSummary) {
  const Outcome outcome = on_terminal({"run", "gas.toml", "--watch"}, 100, 40);
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("┌┈┈┈"), HasSubstr("time       2"), HasSubstr("100 %"), HasSubstr("kT         1"),
                                 HasSubstr("Maxwell-Boltzmann"), HasSubstr("\x1b[38;5;")));
  EXPECT_THAT(outcome.out, HasSubstr("Try next"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("nan")));
}

TEST_F(WatchCommand, ShowsEveryInstantOfASlowedRun) {
  // Two units of time at ten per second: a picture at the start, and more than one later, whatever the machine does meanwhile.
  const Outcome outcome = on_terminal({"run", "gas.toml", "--watch", "--pace", "10"}, 80, 30);
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("time       0\x1b[K"), HasSubstr("A\r")));
}

TEST_F(WatchCommand, ChangesNoBitOfTheRun) {
  ASSERT_EQ(carom({"run", "gas.toml", "-q", "--csv", "--no-trajectory", "--out", "unseen"}).exit_code, 0);
  ASSERT_EQ(
      on_terminal({"run", "gas.toml", "--watch", "--pace", "20", "--csv", "--no-trajectory", "--out", "seen"}, 80, 30).exit_code,
      0);
  EXPECT_EQ(text_of(file("seen/samples.csv")), text_of(file("unseen/samples.csv")));
}

TEST_F(WatchCommand, IsTheProgressLineWhereTheTerminalCannotShowIt) {
  const Outcome narrow = on_terminal({"run", "gas.toml", "--watch", "--force"}, 40, 12);
  const Outcome latin = on_terminal({"run", "gas.toml", "--watch", "--force"}, 100, 40, "C");
  for (const Outcome& outcome : {narrow, latin}) {
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.out, AllOf(Not(HasSubstr("Maxwell")), HasSubstr("Try next")));
  }
  const Outcome none = carom({"run", "gas.toml", "--watch", "--force"});
  EXPECT_EQ(none.exit_code, 0);
  EXPECT_THAT(none.err, IsEmpty());
}

TEST_F(WatchCommand, RefusesAPaceThatIsNone) {
  for (const char* pace : {"0", "-1", "inf", "nan"}) {
    const Outcome outcome = carom({"run", "gas.toml", "--watch", "--pace", pace});
    EXPECT_EQ(outcome.exit_code, 2) << pace;
    EXPECT_THAT(outcome.err, HasSubstr("must be positive"));
  }
  EXPECT_THAT(carom({"run", "gas.toml", "--pace", "1"}).err, HasSubstr("give --watch too"));
}

}  // namespace
}  // namespace carom::test
