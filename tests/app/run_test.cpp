// carom run: where it writes, what it prints, and what it leaves alone.

#include "runner/expected_memory.hpp"
#include "support/program_test.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <string>

namespace carom::test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

namespace fs = std::filesystem;

class RunCommand : public ProgramTest {
 protected:
  RunCommand() : ProgramTest(fifty_disks) {}
  [[nodiscard]] json summary(const std::string& name = "gas") const { return json::parse(text_of(file(name) / "summary.json")); }
};

TEST_F(RunCommand, SummaryGoesToStdoutAndNothingToStderr) {
  const Outcome outcome = carom({"run", "gas.toml"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("50 disks"), HasSubstr("pair collisions"), HasSubstr("worst overlap"), HasSubstr("Files in gas")));
  EXPECT_TRUE(fs::exists(file("gas/summary.json")));
  EXPECT_TRUE(fs::exists(file("gas/trajectory.h5md")));
}

TEST_F(RunCommand, JsonOnStdoutIsTheSummaryFile) {
  const Outcome outcome = carom({"run", "gas.toml", "--json"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, IsEmpty());
  const json printed = json::parse(outcome.out);
  EXPECT_EQ(printed, summary());
  EXPECT_EQ(printed["disks"], 50);
  EXPECT_EQ(printed["samples"], 5);
  EXPECT_EQ(printed["stopped"], "time");
}

TEST_F(RunCommand, QuietPrintsNothing) {
  const Outcome outcome = carom({"run", "gas.toml", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out + outcome.err, IsEmpty());
  EXPECT_TRUE(fs::exists(file("gas/summary.json")));
}

TEST_F(RunCommand, QuietSaysWhyARunEndedEarly) {
  const Outcome outcome =
      carom({"run", CAROM_SOURCE_DIR "/docs/scenes/bouncing_ball.toml", "--quiet", "--out", "ball", "--set", "run.time=100.0"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_THAT(outcome.err, AllOf(StartsWith("carom: ball: at time "), HasSubstr(", collapsed: disk 0 collides at ever shorter")));
}

TEST_F(RunCommand, MoreDisksThanThereIsMemoryForAreRefusedBeforeTheyAreDrawn) {
  const std::string disks = "2000000000";
  const std::vector<std::string> overrides = {"disks.0.count=" + disks, "box.x=[0.0,100000.0]", "box.y=[0.0,100000.0]"};
  if (!too_little_memory(parse_scene(fifty_disks, "gas.toml", overrides))) GTEST_SKIP() << "there is enough";
  std::vector<std::string> words = {"run", "gas.toml"};
  for (const std::string& word : overrides) words.insert(words.end(), {"--set", word});
  const Outcome outcome = carom(words);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err,
              AllOf(StartsWith("carom: gas.toml: there is not enough memory for 2,000,000,000 disks: they need some 215 "
                               "bytes per disk, and 700 GB in all at the start; "),
                    HasSubstr(" are free; fewer disks need less")));
  EXPECT_FALSE(fs::exists(file("gas")));
}

TEST_F(RunCommand, VerboseDescribesTheSceneOnStderr) {
  const Outcome outcome = carom({"run", "gas.toml", "-v", "--json"});
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("kT = 1"), HasSubstr("periodic"), HasSubstr("specular")));
  EXPECT_TRUE(json::accept(outcome.out));
}

TEST_F(RunCommand, SeedIsStoredAndChangesTheCourse) {
  const auto events_of = [&](const std::string& seed, const std::string& out) -> json {
    EXPECT_EQ(carom({"run", "gas.toml", "--seed", seed, "--out", out}).exit_code, 0);
    EXPECT_EQ(summary(out)["seed"], std::stoi(seed));
    return summary(out)["events"];
  };
  const json first = events_of("7", "a");
  EXPECT_EQ(first, events_of("7", "b"));
  EXPECT_NE(first, events_of("8", "c"));
}

TEST_F(RunCommand, SetOverridesAKeyAndTheLastOneWins) {
  EXPECT_EQ(carom({"run", "--set", "run.time=9", "--set", "run.time=1.5", "gas.toml"}).exit_code, 0);
  EXPECT_EQ(summary()["time"], 1.5);
  EXPECT_EQ(summary()["samples"], 4);
}

TEST_F(RunCommand, OutputMayBeAskedForOnTheCommandLine) {
  EXPECT_EQ(carom({"run", "gas.toml", "--xyz", "--csv", "--no-trajectory", "--out", "deep/down"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(file("deep/down/trajectory.xyz")));
  EXPECT_TRUE(fs::exists(file("deep/down/samples.csv")));
  EXPECT_FALSE(fs::exists(file("deep/down/trajectory.h5md")));
}

TEST_F(RunCommand, BrokenSceneSaysWhereAndWritesNothing) {
  write_text(file("gas.toml"), fifty_disks + "tiem = 3.0\n");
  const Outcome outcome = carom({"run", "gas.toml"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_THAT(outcome.err, AllOf(StartsWith("carom: gas.toml:19:"), HasSubstr("time")));
  EXPECT_FALSE(fs::exists(file("gas")));
}

TEST_F(RunCommand, DisksThatCannotBePlacedWriteNothing) {
  const Outcome outcome = carom({"run", "gas.toml", "--set", "disks.0.radius=0.75"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("packing"), HasSubstr("hexagonal")));
  EXPECT_FALSE(fs::exists(file("gas")));
}

TEST_F(RunCommand, ExistingResultsAreRefusedAndLeftAsTheyWere) {
  ASSERT_EQ(carom({"run", "gas.toml"}).exit_code, 0);
  const std::string trajectory = text_of(file("gas/trajectory.h5md"));
  const std::string summary_before = text_of(file("gas/summary.json"));
  const Outcome outcome = carom({"run", "gas.toml", "--seed", "2"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_THAT(outcome.err, AllOf(StartsWith("carom: gas: "), HasSubstr("--force")));
  EXPECT_TRUE(text_of(file("gas/trajectory.h5md")) == trajectory);
  EXPECT_EQ(text_of(file("gas/summary.json")), summary_before);
}

TEST_F(RunCommand, ForceReplacesResults) {
  ASSERT_EQ(carom({"run", "gas.toml", "--csv"}).exit_code, 0);
  ASSERT_EQ(carom({"run", "gas.toml", "--seed", "2", "--force"}).exit_code, 0);
  EXPECT_EQ(summary()["seed"], 2);
  EXPECT_FALSE(fs::exists(file("gas/samples.csv"))) << "a table of the run before lies beside the new trajectory";
}

TEST_F(RunCommand, AStateThatIsNotFiniteExitsThreeWithASentence) {
  // Centre all but upon centre: the square of their distance is 0, and no direction is left for an impulse.
  write_text(file("upon.toml"), R"([box]
x = [0.0, 16.0]
y = [0.0, 16.0]
boundary = "periodic"
[[disks]]
radius = 0.5
mass = 1.0
positions = [[0.0, 8.0], [1e-180, 8.0]]
velocities = [[1.0, 0.0], [-1.0, 0.0]]
[collision]
rule = "specular"
[run]
time = 1.0
sample_every = 0.25
)");
  for (const std::vector<std::string>& how :
       {std::vector<std::string>{"--engine", "textbook"}, std::vector<std::string>{"--method", "guarded"}}) {
    std::vector<std::string> arguments = {"run", "upon.toml", "--accept-overlap", "--force"};
    arguments.insert(arguments.end(), how.begin(), how.end());
    const Outcome outcome = carom(arguments);
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_THAT(outcome.err, AllOf(StartsWith("carom: upon.toml: 1 fault at time 0: "), HasSubstr("finite")));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1);
    EXPECT_EQ(summary("upon")["stopped"], "invalid_state");
    EXPECT_EQ(summary("upon")["faults"].size(), 1U);
    EXPECT_TRUE(fs::exists(file("upon/trajectory.h5md")));
  }
}

TEST_F(RunCommand, PlaceThatCannotHoldResultsExitsTwo) {
  for (const char* out : {"gas.toml/results", "gas.toml", "/proc/results"}) {
    const Outcome outcome = carom({"run", "gas.toml", "--out", out});
    EXPECT_EQ(outcome.exit_code, 2) << out;
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_THAT(outcome.err, StartsWith(std::string("carom: ") + out));
  }
  EXPECT_EQ(text_of(file("gas.toml")), fifty_disks);
}

class Interrupted : public RunCommand, public ::testing::WithParamInterface<int> {};

TEST_P(Interrupted, RunSavesWhatItHasAndExits130) {
  const auto signal_once_it_runs = [&](pid_t child) {
    EXPECT_TRUE(wait_until([&] { return fs::exists(file("gas/trajectory.h5md.partial")); }));
    kill(child, GetParam());
  };
  const Outcome outcome =
      carom({"run", "gas.toml", "--set", "run.time=1e9", "--json", "--progress", "always"}, signal_once_it_runs);
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("time "), HasSubstr("collisions")));
  EXPECT_EQ(json::parse(outcome.out)["stopped"], "interrupted");
  EXPECT_EQ(json::parse(outcome.out), summary());
  const Outcome info = carom({"info", "gas/trajectory.h5md"});
  EXPECT_EQ(info.exit_code, 0) << info.err;
  EXPECT_THAT(info.out, HasSubstr("50"));
  for (const auto& entry : fs::directory_iterator(file("gas"))) EXPECT_THAT(entry.path().string(), Not(HasSubstr(".partial")));
}

INSTANTIATE_TEST_SUITE_P(By, Interrupted, ::testing::Values(SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGUSR1),
                         [](const auto& signal) { return std::string("SIG") + sigabbrev_np(signal.param); });

TEST_F(RunCommand, SignalsThatComeTogetherEndNoRunUnsaved) {
  // GNU timeout sends two at once; a batch system that loses patience sends others.
  const auto signal_once_it_runs = [&](pid_t child) {
    EXPECT_TRUE(wait_until([&] { return fs::exists(file("gas/trajectory.h5md.partial")); }));
    for (const int number : {SIGTERM, SIGTERM, SIGINT, SIGHUP, SIGUSR1, SIGTERM}) kill(child, number);
  };
  const Outcome outcome = carom({"run", "gas.toml", "--set", "run.time=1e9", "-q"}, signal_once_it_runs);
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_EQ(summary()["stopped"], "interrupted");
  EXPECT_TRUE(fs::exists(file("gas/checkpoint.h5")));
}

}  // namespace
}  // namespace carom::test
