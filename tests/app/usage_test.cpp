// What the program says to a command line that is wrong, and to questions about itself.

#include "support/child_process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <carom/version.hpp>

#include <sys/wait.h>
#include <algorithm>
#include <cstdlib>

namespace carom::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

struct WrongLine {
  const char* name;
  std::vector<std::string> arguments;
  const char* sentence;  ///< a part of it
};

class WrongCommandLine : public ::testing::TestWithParam<WrongLine> {};

TEST_P(WrongCommandLine, ExitsTwoWithASentenceOnStderr) {
  const TemporaryDirectory directory;
  const Outcome outcome = run_carom(directory.path(), GetParam().arguments);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_THAT(outcome.err, AllOf(StartsWith("carom: "), HasSubstr(GetParam().sentence)));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_TRUE(std::filesystem::is_empty(directory.path()));
}

const std::string box = CAROM_SOURCE_DIR "/docs/scenes/box.toml";

INSTANTIATE_TEST_SUITE_P(
    Each, WrongCommandLine,
    ::testing::Values(
        WrongLine{"NoCommand", {}, "subcommand is required"},
        WrongLine{"UnknownCommand", {"rnu", box}, "rnu: there is no such command"},
        WrongLine{"NoCommandNamesTwo", {}, "carom run SCENE runs a scene"},
        WrongLine{"CommandMisspelt", {"rum", box}, "rum: there is no such command; did you mean carom run?"},
        WrongLine{"SceneForACommand", {"box.toml"}, "box.toml: there is no such command; carom run box.toml runs a scene"},
        WrongLine{"HelpAsACommand", {"help"}, "it is carom --help"},
        WrongLine{"CommandLikeNone", {"zzzzzzzz"}, "choose one of: run, "},
        WrongLine{"OptionMisspelt", {"run", box, "--sede", "1"}, "--sede: carom run has no such option; did you mean --seed?"},
        WrongLine{"OptionOfAScene", {"run", box, "--duration-of-all=5"}, "is changed with --set, such as --set run.time=5"},
        WrongLine{"OptionMisspeltElsewhere", {"play", box, "--outptu", "x"}, "--outptu: carom play has no such option"},
        WrongLine{"NoScene", {"run"}, "scene is required"}, WrongLine{"UnknownOption", {"run", box, "--sed", "1"}, "--sed"},
        WrongLine{"SeedIsNoNumber", {"run", box, "--seed", "x"}, "--seed"},
        WrongLine{"UnknownEngine", {"run", box, "--engine", "steam"}, "--engine steam: there is no such engine; choose auto"},
        WrongLine{"UnknownProgress", {"run", box, "--progress", "often"}, "auto, always or never"},
        WrongLine{"OverrideWithoutValue", {"run", box, "--set", "run.time"}, "run.time"},
        WrongLine{"OverrideOfUnknownKey", {"run", box, "--set", "run.tiem=2"}, "time"},
        WrongLine{"SceneNotThere", {"run", "nowhere.toml"}, "nowhere.toml"},
        WrongLine{"CheckOfSceneNotThere", {"check", "nowhere.toml"}, "nowhere.toml"},
        WrongLine{"InfoOnFileNotThere", {"info", "nowhere.h5md"}, "nowhere.h5md"},
        WrongLine{"UnknownPreset", {"init", "bax"}, "bax"}),
    [](const auto& line) { return line.param.name; });

TEST(Usage, VersionNamesVersionCommitAndCompiler) {
  const TemporaryDirectory directory;
  const Outcome outcome = run_carom(directory.path(), {"--version"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, AllOf(StartsWith("carom " + build_info().version), HasSubstr(build_info().commit),
                                 HasSubstr(build_info().compiler)));
  EXPECT_THAT(outcome.err, IsEmpty());
}

TEST(Usage, HelpNamesEveryCommand) {
  const TemporaryDirectory directory;
  const Outcome outcome = run_carom(directory.path(), {"--help"});
  EXPECT_EQ(outcome.exit_code, 0);
  for (const char* command : {"run", "check", "init", "info", "bench"}) EXPECT_THAT(outcome.out, HasSubstr(command));
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("\nScenes and runs:\n"), HasSubstr("\nResults of a run:\n"), HasSubstr("\nStudies:\n"),
                                 Not(HasSubstr("\nSubcommands:")), HasSubstr("carom run box.toml")));
  EXPECT_THAT(outcome.err, IsEmpty());
}

TEST(Usage, FullStandardOutputIsAFailure) {
  const int status = std::system("'" CAROM_PROGRAM "' init --list > /dev/full 2> /dev/null");
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 1);
}

}  // namespace
}  // namespace carom::test
