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
        WrongLine{"UnknownCommand", {"rnu", box}, "rnu: there is no such command"},
        WrongLine{"CommandMisspelt", {"rum", box}, "rum: there is no such command; did you mean carom run?"},
        WrongLine{"SceneForACommand", {"box.toml"}, "box.toml: there is no such command; carom run box.toml runs a scene"},
        WrongLine{"SceneForACommandWithOptions",
                  {"box.toml", "--time", "5"},
                  "box.toml: there is no such command; carom run box.toml --time 5 runs a scene"},
        WrongLine{"SweepForACommand",
                  {CAROM_SOURCE_DIR "/docs/scenes/sweeps/equation_of_state.toml"},
                  "equation_of_state.toml runs a sweep"},
        WrongLine{"FileForACommand", {CAROM_SOURCE_DIR "/README.md"}, "README.md describes a file"},
        WrongLine{"CommandOfOthers", {"simulate", box}, "simulate: there is no such command; did you mean carom run?"},
        WrongLine{"CommandOfFilms", {"animate", "box"}, "did you mean carom movie?"},
        WrongLine{"HelpOnACommandMisspelt", {"help", "rum"}, "rum: there is no such command; did you mean carom run?"},
        WrongLine{"CommandLikeNone", {"zzzzzzzz"}, "choose one of: init, "},
        WrongLine{"OptionMisspelt", {"run", box, "--sede", "1"}, "--sede: carom run has no such option; did you mean --seed?"},
        WrongLine{"OptionOfAScene", {"run", box, "--duration-of-all=5"}, "is changed with --set, such as --set run.time=5"},
        WrongLine{"OptionCutShort", {"run", box, "--tim", "5"}, "--tim: carom run has no such option; did you mean --time?"},
        WrongLine{"OptionBeforeTheScene", {"run", "--tim", "5"}, "--tim: carom run has no such option; did you mean --time?"},
        WrongLine{"OptionWithOneDash", {"run", box, "-seed", "5"}, "-seed: carom run has no such option; did you mean --seed?"},
        WrongLine{"OptionThatIsAKey",
                  {"run", box, "--count", "200"},
                  "--count: carom run has no such option; a key of the scene is changed with --set disks.0.count=..."},
        WrongLine{"OptionForATemperature", {"run", box, "--temperature=2"}, "--set disks.0.velocities.temperature=..."},
        WrongLine{"StepsAsAnOption", {"run", box, "--steps", "5000"}, "events need no steps; a run is as long as time"},
        WrongLine{"NumberAsAnOption", {"run", box, "-N", "100"}, "disks are described in [[disks]], where their number is count"},
        WrongLine{"TimeStepOfEvents", {"run", box, "--dt", "0.001"}, "exact events need none"},
        WrongLine{"TimeStepAsAKey", {"run", box, "--set", "run.dt=0.001"}, "events need no time step"},
        WrongLine{"StepsAsAKey", {"run", box, "--set", "run.steps=5000"}, "events need no steps"},
        WrongLine{"NumberAsAKey", {"run", box, "--set", "N=100"}, "where their number is count"},
        WrongLine{"OptionOfOthers", {"run", box, "--jobs", "2"}, "did you mean --threads?"},
        WrongLine{"OptionMisspeltElsewhere", {"play", box, "--outptu", "x"}, "--outptu: carom play has no such option"},
        WrongLine{"OptionOfNoScene", {"play", box, "--count", "2"}, "carom play --help lists them"},
        WrongLine{"TimeIsNoNumber", {"run", box, "--time", "long"}, "--time long: T must be a number"},
        WrongLine{"TimeIsNegative", {"run", box, "--time", "-1"}, "run.time"},
        WrongLine{"NoScene", {"run"}, "run: SCENE is missing, the scene file (TOML); for example: carom run box.toml"},
        WrongLine{"NoSecondRun", {"diff", "box"}, "diff: RUN_B is missing, the run to compare it with; for example: carom diff "},
        WrongLine{"NoRunToExtend", {"extend", "--time", "3"}, "for example: carom extend kept --time 6"},
        WrongLine{"OneArgumentTooMany",
                  {"run", box, "extra", "--time", "1"},
                  "extra: carom run takes only SCENE; carom help run lists its options"},
        WrongLine{"SeveralArgumentsTooMany", {"play", "box", "c", "b", "a"}, "c: carom play takes only RUN_DIR"},
        WrongLine{"ArgumentForNone", {"bench", "fast"}, "fast: carom bench takes no arguments"},
        WrongLine{"ChangeWithoutSet", {"run", box, "run.time=3"}, "did you mean --set run.time=3?"},
        WrongLine{"OptionOfOneLetter", {"run", box, "-t", "3"}, "-t: carom run has no such option; did you mean --time?"},
        WrongLine{"OptionForAnEnd", {"run", box, "--tmax", "3"}, "did you mean --time?"},
        WrongLine{"OptionWithoutACommand",
                  {"--tim", "5"},
                  "--tim: carom has no such option; name a command first, such as carom run box.toml --time; carom help lists"},
        WrongLine{"OptionOfNoCommand", {"--zzzz"}, "name a command first, such as carom run box.toml; carom help lists them"},
        WrongLine{"HelpMisspelt", {"--hepl"}, "did you mean carom --help?"},
        WrongLine{"ValueForgotten", {"run", box, "--time"}, "--time: its value is missing, --time T; simulated time"},
        WrongLine{"ValueIsEmpty", {"run", box, "--time", ""}, "--time: its value is empty; give --time T, or leave --time out"},
        WrongLine{"ValueBehindEqualsIsEmpty", {"run", box, "--out="}, "--out: its value is empty; give --out DIR"},
        WrongLine{"ValueOfOneLetterIsEmpty", {"run", box, "-o", "", "--force"}, "-o: its value is empty; give -o DIR"},
        WrongLine{"ValueForAFlag", {"run", box, "--quiet=foo"}, "--quiet: it takes no value"},
        WrongLine{"GivenTwice", {"run", box, "--seed", "1", "--seed", "2"}, "--seed: it is given more than once"},
        WrongLine{"BelowItsRange", {"run", box, "--verify", "-1"}, "--verify -1: K must be a whole number from 0 to 9223"},
        WrongLine{
            "TwoThatExclude", {"extend", "box", "--time", "3", "--collisions", "5"}, "exclude each other; give one of them"},
        WrongLine{"OneThatNeedsAnother", {"compare", box, "--every", "3"}, "--every: it is for --trajectory alone"},

        WrongLine{"UnknownOption", {"run", box, "--sed", "1"}, "--sed"},
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

TEST(Usage, FullStandardOutputIsAFailure) {
  const TemporaryDirectory directory;
  for (const char* words : {"init --list", "hardcases --list", "hardcases --json corner_hit", "hardcases corner_hit"}) {
    const Outcome outcome =
        run_program(directory.path(), {"sh", "-c", std::string("exec \"$0\" ") + words + " > /dev/full", CAROM_PROGRAM});
    EXPECT_EQ(outcome.exit_code, 1) << words;
    EXPECT_THAT(outcome.err, StartsWith("carom: cannot write to standard output: ")) << words;
  }
}

}  // namespace
}  // namespace carom::test
