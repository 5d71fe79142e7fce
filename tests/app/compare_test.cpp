// carom compare: what it writes and prints, that it can be interrupted and goes on, and what it refuses.

#include "support/program_test.hpp"

#include <carom/simulation.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace carom::test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

namespace fs = std::filesystem;

const std::string a_dozen_disks = R"(title = "A dozen disks"

[box]
x = [0.0, 5.0]
y = [0.0, 5.0]
boundary = "periodic"

[[disks]]
count = 12
radius = 0.5
mass = 1.0
positions = "random"
velocities = { temperature = 1.0 }

[collision]
rule = "specular"

[run]
time = 5.0
)";

/// Fixed-step methods of a periodic box, where the two naive ones do not differ.
const std::size_t steppers = fixed_step_names().size() - 1;

class CompareCommand : public ProgramTest {
 protected:
  CompareCommand() : ProgramTest(a_dozen_disks) {}

  /// A comparison of two fixed steps from one start, where nothing else is said.
  Outcome compare(const std::vector<std::string>& options, const std::function<void(pid_t)>& meanwhile = {}) {
    std::vector<std::string> arguments = {"compare", "gas.toml", "--no-costs"};
    if (std::find(options.begin(), options.end(), "--seeds") == options.end())
      arguments.insert(arguments.end(), {"--seeds", "1"});
    if (std::find(options.begin(), options.end(), "--dt") == options.end())
      arguments.insert(arguments.end(), {"--dt", "0.02,0.01"});
    arguments.insert(arguments.end(), options.begin(), options.end());
    return carom(arguments, meanwhile);
  }
  [[nodiscard]] std::set<std::string> files_in(const std::string& name) const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(file(name))) names.insert(entry.path().filename().string());
    return names;
  }

  /// Exit code 2, one sentence, and nothing new in the directory.
  void expect_refused(const std::vector<std::string>& options, const std::string& beginning) {
    SCOPED_TRACE(beginning);
    const Outcome outcome = compare(options);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_THAT(outcome.err, StartsWith("carom: " + beginning));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1);
    EXPECT_EQ(files_in("."), std::set<std::string>{"gas.toml"});
  }
};

TEST_F(CompareCommand, WritesPageTablesAndPointsAndPrintsTheAnswerAndKeepsWhatIsThere) {
  const Outcome outcome = compare({});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_EQ(files_in("gas-compare"), (std::set<std::string>{"report.html", "compare.json", "compare.csv", "points.jsonl"}));
  EXPECT_THAT(outcome.out, AllOf(StartsWith("A dozen disks\n12 disks"), HasSubstr("textbook-float"), HasSubstr("grid"),
                                 HasSubstr("the exact engine"), HasSubstr("Files in gas-compare: ")));
  const json all = json::parse(text_of(file("gas-compare/compare.json")));
  EXPECT_EQ(all["runs"].size(), 4U + 2U * steppers);
  EXPECT_EQ(all["complete"], true);
  for (const json& sentence : all["sentences"]) EXPECT_THAT(outcome.out, HasSubstr(sentence.get<std::string>() + "\n"));
  EXPECT_EQ(lines_of(text_of(file("gas-compare/compare.csv"))).size(), 1U + 4U + 2U * steppers);
  EXPECT_EQ(lines_of(text_of(file("gas-compare/points.jsonl"))).size(), 1U + 4U + 2U * steppers);
  EXPECT_THAT(text_of(file("gas-compare/report.html")), HasSubstr("<title>Error and cost: A dozen disks</title>"));
  const Outcome info = run_carom(directory_.path(), {"info", "gas-compare/compare.json"});
  EXPECT_EQ(info.exit_code, 0) << info.err;
  EXPECT_THAT(info.out, AllOf(HasSubstr("comparison of methods"), HasSubstr(all["sentences"][0].get<std::string>())));

  const std::string before = text_of(file("gas-compare/compare.json"));
  const Outcome refused = compare({});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.out, IsEmpty());
  EXPECT_THAT(refused.err, AllOf(StartsWith("carom: gas-compare"), HasSubstr("--force")));
  EXPECT_EQ(text_of(file("gas-compare/compare.json")), before);

  const Outcome forced = compare({"--force", "-q", "--dt", "0.02"});
  EXPECT_EQ(forced.exit_code, 0) << forced.err;
  const json replaced = json::parse(text_of(file("gas-compare/compare.json")));
  EXPECT_EQ(replaced["runs"].size(), 4U + steppers);
  std::string sentences;  // quiet: them alone
  for (const json& sentence : replaced["sentences"]) sentences += sentence.get<std::string>() + "\n";
  EXPECT_THAT(sentences, Not(IsEmpty()));
  EXPECT_EQ(forced.out, sentences);
}

TEST_F(CompareCommand, AStartThatIsNotDrawnIsRunOnceAndTheTableHasNoErrors) {
  const Outcome outcome = compare({"--seeds", "8", "--dt", "0.02", "--set", "disks.0.positions=[[1,1],[3,1.2],[2,3]]", "--set",
                                   "disks.0.count=3", "--set", "disks.0.velocities=[[1,0],[-1,0],[0,-1]]"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("; 1 start, which contains nothing random;"), HasSubstr("a bias has no error bar"),
                                 Not(HasSubstr("±")), Not(HasSubstr(" ns"))));
  EXPECT_EQ(json::parse(text_of(file("gas-compare/compare.json")))["runs"].size(), 4U + steppers);
  EXPECT_THAT(text_of(file("gas-compare/report.html")), Not(HasSubstr("± nan")));
}

TEST_F(CompareCommand, TheTableSaysWhatItsColumnsAre) {
  const Outcome outcome = compare({"--seeds", "2", "--dt", "0.02"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* words :
       {"bias of Z  missed  repeated", "       %       %         %", "in mean diameters (1)", "  missed: pairs that touched",
        "  repeated: reversals of a pair", "± its standard error over 2 starts"})
    EXPECT_THAT(outcome.out, HasSubstr(words));
  EXPECT_THAT(outcome.out, ::testing::ContainsRegex(" bias of Z +missed +repeated +wrong steps\n .* % +% +% +%\n"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("sigma")));
}

TEST_F(CompareCommand, JsonPrintsTheFileOfThatName) {
  const Outcome outcome = compare({"--json", "--dt", "0.02", "--out", "elsewhere/deep", "--engine", "textbook", "--seed", "7"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, text_of(file("elsewhere/deep/compare.json")));
  const json all = json::parse(outcome.out);
  EXPECT_EQ(all["runs"].size(), 3U + steppers);
  EXPECT_EQ(all["runs"][0]["seed"], 7);
}

TEST_F(CompareCommand, PlayMakesThePageOfTwoFlightsFirstAndSaysSo) {
  const Outcome outcome = compare({"--play", "naive:0.05", "--dt", "0.02"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, StartsWith("carom: gas-compare/side_by_side.html: can be watched while the study goes on"));
  EXPECT_EQ(files_in("gas-compare"),
            (std::set<std::string>{"side_by_side.html", "report.html", "compare.json", "compare.csv", "points.jsonl"}));
  EXPECT_THAT(outcome.out, HasSubstr("Files in gas-compare: side_by_side.html, report.html"));
  EXPECT_THAT(text_of(file("gas-compare/side_by_side.html")),
              AllOf(StartsWith("<!doctype html>"), HasSubstr("\"method\":\"naive\",\"dt\":0.05")));
  // Without it the page of another study does not stay.
  EXPECT_EQ(compare({"--force", "-q", "--dt", "0.02"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(file("gas-compare/side_by_side.html")));
}

TEST_F(CompareCommand, PlayChoosesAMethodAndAStepOfTheStudyItself) {
  const Outcome outcome = compare({"--play", "--set", "run.time=0.1"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "carom: gas-compare/side_by_side.html: can be watched while the study goes on\n")
      << "all of it is shown";
  EXPECT_THAT(text_of(file("gas-compare/side_by_side.html")), HasSubstr("\"method\":\"guarded\",\"dt\":0.02"));
}

TEST_F(CompareCommand, PlayGoesWithAStudyThatGoesOn) {
  const fs::path points = file("gas-compare/points.jsonl");
  const Outcome stopped = ended_early([&] {
    return compare({"--seeds", "3", "-q", "--force"}, [&](pid_t child) {
      EXPECT_TRUE(wait_until([&] { return lines_of(text_of(points)).size() > 4; }));
      kill(child, SIGINT);
    });
  });
  EXPECT_EQ(stopped.exit_code, 130);
  const Outcome resumed = compare({"--seeds", "3", "--resume", "-q", "--play"});
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_THAT(resumed.err, IsEmpty());
  EXPECT_TRUE(fs::exists(file("gas-compare/side_by_side.html")));
}

TEST_F(CompareCommand, WhatCannotBePlayedIsRefusedBeforeAnythingIsWritten) {
  expect_refused({"--play", "warp"}, "--play warp: there is no fixed-step method \"warp\"; choose one of naive,");
  expect_refused({"--play", "warp:0.1"}, "--play warp:0.1: there is no");
  expect_refused({"--play", ":0.1"}, "--play :0.1: there is no fixed-step method \"\"");
  for (const char* const dt : {"", "0", "-1", "nan", "inf", "0.1x", "0.1:0.2"})
    expect_refused({"--play", std::string("guarded:") + dt},
                   std::string("--play guarded:") + dt + ": after the colon stands a time step, positive and finite");
  expect_refused({"--play", "grid:6"}, "--play grid:6: the scene's run ends at time 5, within the first step");
  expect_refused({"--play", "grid:1e160", "--dt", "1e149", "--set", "run.time=1e164", "--set", "run.sample_every=1e163"},
                 "--play grid:1e160: in a time step of 1e+160");
  expect_refused({"--play", "--set", "disks.0.count=2001", "--set", "box.x=[0.0,100.0]", "--set", "box.y=[0.0,100.0]"},
                 "--play: 2001 disks are too many");
  expect_refused({"--play", "--set", "gravity.acceleration=[0.0,-1.0]"}, "");
}

TEST_F(CompareCommand, InterruptedItKeepsItsPointsAndGoesOnFromThere) {
  const std::vector<std::string> options = {"--seeds", "3"};
  const fs::path points = file("gas-compare/points.jsonl");
  const Outcome stopped = ended_early([&] {
    return compare({"--seeds", "3", "--force"}, [&](pid_t child) {
      EXPECT_TRUE(wait_until([&] { return lines_of(text_of(points)).size() > 4; }));
      kill(child, SIGINT);
    });
  });
  EXPECT_EQ(stopped.exit_code, 130);
  EXPECT_THAT(stopped.out, IsEmpty());
  EXPECT_THAT(stopped.err, AllOf(HasSubstr("interrupted"), HasSubstr("points.jsonl"), HasSubstr("--resume")));
  EXPECT_EQ(files_in("gas-compare"), std::set<std::string>{"points.jsonl"});
  const std::vector<std::string> before = lines_of(text_of(points));

  const Outcome refused = compare({"--seeds", "3", "--dt", "0.03", "--resume"});  // points of another study
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("another scene, other options"));
  EXPECT_EQ(lines_of(text_of(points)), before);
  EXPECT_EQ(compare(options).exit_code, 2);  // they are results, and --force was not given

  const Outcome resumed = compare({"--seeds", "3", "--resume"});
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  const std::vector<std::string> after = lines_of(text_of(points));
  ASSERT_EQ(after.size(), 1U + 3U * (4U + 2U * steppers));
  EXPECT_TRUE(std::equal(before.begin(), before.end(), after.begin()));
  std::set<std::tuple<std::string, double, int>> runs;
  for (std::size_t k = 1; k < after.size(); ++k) {
    const json run = json::parse(after[k])["run"];
    runs.emplace(run["method"], run["dt"], run["seed"]);
  }
  EXPECT_EQ(runs.size(), 3U * (4U + 2U * steppers));
  EXPECT_EQ(json::parse(text_of(file("gas-compare/compare.json")))["runs"].size(), 3U * (4U + 2U * steppers));
}

TEST_F(CompareCommand, InterruptedBeforeTheFirstPointItLeavesNothing) {
  const Outcome outcome =
      compare({"--set", "disks.0.count=2000", "--set", "box.x=[0.0,100.0]", "--set", "box.y=[0.0,100.0]"}, [&](pid_t child) {
        EXPECT_TRUE(wait_until([&] { return fs::exists(file("gas-compare")); }));
        kill(child, SIGINT);
      });
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_THAT(outcome.err, HasSubstr("interrupted before the first point"));
  EXPECT_EQ(files_in("."), std::set<std::string>{"gas.toml"});
}

TEST_F(CompareCommand, OptionsThatMakeNoSenseAreRefusedBeforeAnythingIsWritten) {
  expect_refused({"--seeds", "0"}, "--seeds 0: ");
  expect_refused({"--seeds", "10001"}, "--seeds 10001: ");
  expect_refused({"--dt", "-1"}, "--dt -1: ");
  expect_refused({"--dt", "0.01,0"}, "--dt 0: ");
  expect_refused({"--dt", "inf"}, "--dt inf: ");
  expect_refused({"--longest", "0"}, "--longest 0: ");
  expect_refused({"--longest", "nan"}, "--longest nan: ");
  for (const char* const wrong : {"0", "-1", "inf", "nan"})
    expect_refused({"--stiffness", wrong}, fmt::format("--stiffness {}: it must be positive and finite", wrong));
  expect_refused({"--force", "--resume"}, "--force ");
  expect_refused({"--engine", "warp"}, "");
  expect_refused({"--engine", "textbook-quad"}, "--engine textbook-quad: ");
  expect_refused({"--progress", "often"}, "");
  expect_refused({"--set", "disks.0.radius=9"}, "");
}

TEST_F(CompareCommand, SpringsHaveTheStiffnessThatIsGivenAndStepsThatItMakesUnstableAreLeftOut) {
  const Outcome outcome = compare({"--stiffness", "1e5", "--dt", "0.02,0.002,0.001"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("; stiffness of soft 100000\n"),
                                 HasSubstr("  left out: soft: a time step of 0.02 is unstable with a stiffness of 100000 where "
                                           "several disks touch one; take at most 0.00258, ")));
  const json all = json::parse(text_of(file("gas-compare/compare.json")));
  EXPECT_EQ(all["plan"]["stiffness"], 1e5);
  EXPECT_EQ(all["runs"].size(), 4U + 3U * steppers - 1U);
  std::vector<double> errors;
  for (const json& run : all["runs"])
    if (run["method"] == "soft") errors.push_back(run["error"][0]);
  ASSERT_EQ(errors.size(), 2U);
  EXPECT_NEAR(errors[0], errors[1], 0.1 * errors[1]) << "the error is that of the springs and not of the step";
}

TEST_F(CompareCommand, AStiffnessThatNoStepOrNoSpringsCanHaveIsRefused) {
  expect_refused({"--stiffness", "1e5"}, "--stiffness 100000: a time step of 0.01 is unstable with a stiffness of 100000");
  expect_refused({"--stiffness", "1e-3", "--dt", "0.01"}, "--stiffness 0.001: with a stiffness of 0.001 the two fastest disks");
  expect_refused({"--stiffness", "1e3", "--set", "collision.rule=\"reversal\""}, "--stiffness 1000: the method \"soft\" has a");
  expect_refused({"--play", "soft:0.02", "--stiffness", "1e5", "--dt", "0.001"}, "--play soft:0.02: a time step of 0.02 is");
}

TEST_F(CompareCommand, WithoutPointsThereIsNothingToResume) { expect_refused({"--resume"}, "gas-compare/points.jsonl"); }

TEST_F(CompareCommand, AStepSoLongThatPositionsOverflowIsRefused) { expect_refused({"--dt", "0.01,1e200"}, "--dt 1e+200: "); }

TEST_F(CompareCommand, ASceneWithoutCollisionsIsRefused) {
  expect_refused({"--set", "disks.0.count=1"}, "gas.toml: no two disks");
  expect_refused({"--set", "disks.0.count=0"}, "gas.toml: no two disks");
}

}  // namespace
}  // namespace carom::test
