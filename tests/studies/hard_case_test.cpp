// The reader of hard cases, and that the runner can fail: cases that are wrong on purpose, one per checker, whose first line
// names the one check that must notice.

#include "studies/hard_cases/hard_case.hpp"
#include "studies/hard_cases/checks.hpp"
#include "studies/hard_cases/run.hpp"
#include "studies/hard_cases/steps.hpp"
#include "studies/hard_cases/table.hpp"
#include "support/refusal.hpp"

#include <carom/scene.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace carom::test {
namespace {

using ::testing::HasSubstr;

const std::filesystem::path wrong_cases = CAROM_SOURCE_DIR "/tests/studies/wrong_cases";

std::vector<std::string> names_of_wrong_cases() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(wrong_cases)) names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

class EnginesWrongCase : public testing::TestWithParam<std::string> {};

TEST_P(EnginesWrongCase, FailsWhereItIsWrongAndNowhereElse) {
  const HardCase wrong = load_hard_case((wrong_cases / (GetParam() + ".toml")).string());
  const std::string mark = "# fails: ";
  const std::string expected = wrong.text.substr(mark.size(), wrong.text.find('\n') - mark.size());
  const CaseVerdict verdict = run_hard_case(wrong);
  EXPECT_FALSE(verdict.holds());
  std::set<std::string> failed;
  for (const CaseCheck& check : verdict.checks)
    if (!check.holds) failed.insert(check.what);
  EXPECT_EQ(failed, std::set<std::string>{expected});
  EXPECT_EQ(row_of(verdict).verdict, "FAILS");
}

INSTANTIATE_TEST_SUITE_P(All, EnginesWrongCase, testing::ValuesIn(names_of_wrong_cases()),
                         [](const auto& one) { return one.param; });

const std::string right_case = R"(title = "A disk at rest"

[case]
family = "contact"
why = "It is not hard."
source = "By hand"

[box]
x = [0, "0x1p2"]
y = [0, "0x1.8p+1"]
boundary = "walls"

[[disks]]
radius = 0.5
mass = 1
positions = [["0x1.999999999999ap-1", 1]]
velocities = [["-0x1.8p-3", 0]]

[collision]
rule = "specular"

[run]
time = 1.0

[expect]
pair = 0
)";

std::string with(const std::string& old, const std::string& fresh) {
  std::string text = right_case;
  text.replace(text.find(old), old.size(), fresh);
  return text;
}

std::string refusal_of(const std::string& text) {
  return refusal<SceneError>([&] { return parse_scene(read_hard_case(text, "case.toml").scene, "case.toml"); });
}

TEST(HardCaseReader, HexfloatsBecomeTheSameNumbers) {
  const HardCase one = read_hard_case(right_case, "some/case.toml");
  EXPECT_EQ(one.name, "case");
  EXPECT_EQ(one.title, "A disk at rest");
  const Scene scene = parse_scene(one.scene);
  EXPECT_EQ(scene.box.upper, Eigen::Vector2d(4.0, 3.0));
  EXPECT_EQ(std::get<ListedPositions>(scene.species.front().positions).values.front().x(), 0x1.999999999999ap-1);
  EXPECT_EQ(std::get<ListedVelocities>(scene.species.front().velocities).values.front().x(), -0x1.8p-3);
}

TEST(HardCaseReader, WhatIsWrongWithTheSceneIsSaidOfTheRightLine) {
  EXPECT_THAT(refusal_of(with("mass = 1", "mass = -1")), HasSubstr("case.toml:15:"));
  EXPECT_THAT(refusal_of(with("time = 1.0", "time = -1.0")), HasSubstr("case.toml:23:"));
}

TEST(HardCaseReader, AFileThatIsNoCaseIsRefusedWithASentence) {
  EXPECT_THAT(refusal_of(with("[case]", "[casa]")), HasSubstr("a hard case has a table [case]"));
  EXPECT_THAT(refusal_of(with("pair = 0", "pear = 0")), HasSubstr("case.toml:26:1: [expect] has no key \"pear\""));
  EXPECT_THAT(refusal_of(with("\"contact\"", "\"contacts\"")),
              HasSubstr("there is no family \"contacts\"; choose one of contact"));
  EXPECT_THAT(refusal_of(with("why = \"It is not hard.\"", "")), HasSubstr("why"));
  EXPECT_THAT(refusal_of(with("source = \"By hand\"", "source = \"By hand\"\nengines = [\"steam\"]")),
              HasSubstr("there is no engine \"steam\""));
  EXPECT_THAT(refusal_of(with("pair = 0", "events = [[1, 0]]")), HasSubstr("[time, disk, partner]"));
}

TEST(HardCaseChecks, BrokenInvariantsAreTold) {
  const HardCase one = read_hard_case(right_case, "case.toml");
  const Scene scene = parse_scene(one.scene);
  const auto failed = [&](auto spoil) {
    EngineRun run = run_in_engine(scene, "fast", {});
    spoil(run);
    std::set<std::string> names;
    for (const CaseCheck& check : checks_of_run(one, scene, run)) {
      if (!check.holds) names.insert(check.what);
      EXPECT_TRUE(check.holds || check.invariant);
    }
    return names;
  };
  using Names = std::set<std::string>;
  EXPECT_EQ(failed([](EngineRun&) {}), Names{});
  EXPECT_EQ(failed([](EngineRun& run) { run.faults.emplace_back("disk 0: its next event lies in the past"); }),
            Names{"invariants"});
  EXPECT_EQ(failed([](EngineRun& run) { run.finite = false; }), Names{"finite"});
  EXPECT_EQ(failed([](EngineRun& run) { run.monotone = false; }), Names{"clock"});
  EXPECT_EQ(failed([](EngineRun& run) { run.overlap = 1e-9; }), Names{"overlap"});
}

TEST(HardCaseChecks, NotANumberIsWithinNoBound) {
  EXPECT_FALSE(within("energy", {}, std::numeric_limits<double>::quiet_NaN(), 1.0).holds);
  EXPECT_FALSE(within("energy", {}, std::numeric_limits<double>::infinity(), 1.0).holds);
  EXPECT_TRUE(within("energy", {}, 1.0, 1.0).holds);
}

TEST(HardCaseTable, VerdictsAsJsonAndMarkdownNameCaseAndCheck) {
  const std::vector<CaseVerdict> verdicts = {run_hard_case(load_hard_case((wrong_cases / "pair.toml").string()))};
  const auto written = nlohmann::json::parse(hard_cases_json(verdicts));
  EXPECT_EQ(written.at("failed"), 1);
  EXPECT_EQ(written.at("cases").at(0).at("name"), "pair");
  EXPECT_EQ(written.at("cases").at(0).at("verdict"), "FAILS");
  EXPECT_THAT(hard_cases_markdown(verdicts), HasSubstr("| `pair` |"));
}

TEST(HardCaseSteps, ADiskThatFliesThroughAnotherInOneStepHasTunnelled) {
  const HardCase one = read_hard_case(with("[[\"0x1.999999999999ap-1\", 1]]\nvelocities = [[\"-0x1.8p-3\", 0]]",
                                           "[[0.75, 1], [2, 1]]\nvelocities = [[1, 0], [0, 0]]"),
                                      "case.toml");
  // The disks are 1 wide: in a step of 2.5 units of time the one flies past the other, out of the box and back.
  const StepTrial coarse = run_in_steps(one, "guarded", 2.5);
  EXPECT_EQ(coarse.exact_collisions, 1U);
  EXPECT_EQ(coarse.counts.missed, 1U);
  EXPECT_THAT(coarse.faults(), ::testing::Contains("tunnelled"));
  EXPECT_EQ(run_in_steps(one, "guarded", {}).counts.found, 1U);
}

}  // namespace
}  // namespace carom::test
