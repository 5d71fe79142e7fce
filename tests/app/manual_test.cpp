// The manual page and the completion that the program prints of itself.

#include "support/child_process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace carom::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

constexpr auto commands = {"run",  "check",  "horizon", "compare", "sweep", "validate", "init",
                           "info", "verify", "diff",    "play",    "bench", "hardcases"};

class Manual : public ::testing::Test {
 protected:
  std::string printed(const std::string& command) {
    const Outcome outcome = run_carom(directory_.path(), {command});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.err, IsEmpty());
    return outcome.out;
  }
  TemporaryDirectory directory_;
};

TEST_F(Manual, HasEveryCommandAndItsOptions) {
  const std::string page = printed("manual");
  EXPECT_THAT(page, StartsWith(".TH CAROM 1"));
  for (const std::string command : commands) EXPECT_THAT(page, HasSubstr(".SS \\fBcarom " + command + "\\fR\n"));
  EXPECT_THAT(page, HasSubstr("\\fB\\-q\\fR, \\fB\\-\\-quiet\\fR"));
  EXPECT_THAT(page, HasSubstr("SIGHUP, SIGXCPU and SIGUSR1 ask a run or a study to stop"));
  EXPECT_THAT(page, Not(HasSubstr("carom manual")));
}

TEST_F(Manual, IsSetWithoutAWarning) {
  write_text(directory_.file("carom.1"), printed("manual"));
  const Outcome set = run_program(directory_.path(), {"groff", "-man", "-Tutf8", "-ww", "carom.1"});
  if (set.exit_code == 127) GTEST_SKIP() << "groff is not installed";
  EXPECT_EQ(set.exit_code, 0);
  EXPECT_THAT(set.err, IsEmpty());
  EXPECT_THAT(set.out, HasSubstr("in 24 to 113 bits"));
}

TEST_F(Manual, BashCompletesCommandsOptionsAndFiles) {
  write_text(directory_.file("completion"), printed("completion"));
  write_text(directory_.file("gas.toml"), "");
  const auto completed = [&](const std::string& words, int word) {
    return run_program(directory_.path(), {"bash", "-c",
                                           "source ./completion; COMP_WORDS=(" + words + "); COMP_CWORD=" + std::to_string(word) +
                                               "; _carom; echo \"${COMPREPLY[@]}\""})
        .out;
  };
  EXPECT_EQ(completed("carom hor", 1), "horizon\n");
  EXPECT_EQ(completed("carom run --no-t", 2), "--no-trajectory\n");
  EXPECT_EQ(completed("carom check ga", 2), "gas.toml\n");
}

}  // namespace
}  // namespace carom::test
