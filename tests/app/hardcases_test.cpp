// carom hardcases from the outside.

#include "support/child_process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace carom::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

class HardCases : public ::testing::Test {
 protected:
  Outcome hardcases(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "hardcases");
    return run_carom(directory_.path(), arguments);
  }
  static std::string wrong(const std::string& name) { return CAROM_SOURCE_DIR "/tests/studies/wrong_cases/" + name + ".toml"; }
  TemporaryDirectory directory_;
};

TEST_F(HardCases, ANamedCaseThatHoldsExitsZeroWithItsRow) {
  const Outcome outcome = hardcases({"touching_and_receding", "speed_1e150_is_refused"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("touching_and_receding"), HasSubstr("2 cases"), HasSubstr("all hold")));
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_TRUE(std::filesystem::is_empty(directory_.path()));
}

TEST_F(HardCases, AnExpectationThatFailsExitsFourAndABrokenInvariantThree) {
  const Outcome expectation = hardcases({wrong("pair")});
  EXPECT_EQ(expectation.exit_code, 4);
  EXPECT_THAT(expectation.out,
              AllOf(HasSubstr("FAILS"), HasSubstr("pair, fast: pair collisions 1 is not within 0: 1 in place of 2")));
  EXPECT_EQ(hardcases({wrong("overlap"), wrong("pair")}).exit_code, 3);
}

TEST_F(HardCases, ListShowAndJsonNameTheCases) {
  EXPECT_THAT(hardcases({"--list"}).out, AllOf(HasSubstr("galperin_314159"), HasSubstr("(--long)")));
  EXPECT_THAT(hardcases({"--show", "corner_hit"}).out, StartsWith("title = "));
  const auto found = nlohmann::json::parse(hardcases({"corner_hit", "--engine", "fast", "--json"}).out);
  EXPECT_EQ(found.at("cases").at(0).at("engines"), nlohmann::json({"fast"}));
}

TEST_F(HardCases, APageIsWrittenWhereItIsAskedFor) {
  EXPECT_EQ(hardcases({"corner_hit", "--page", "cases.html"}).exit_code, 0);
  EXPECT_GT(std::filesystem::file_size(directory_.path() / "cases.html"), 100'000U);
}

TEST_F(HardCases, APageReplacesPagesOfItsKindAlone) {
  const auto path = [&](const std::string& name) { return directory_.path() / name; };
  std::ofstream(path("scene.toml")) << "title = \"mine\"\n";
  std::ofstream(path("mine.html")) << "<p>mine</p>\n";
  for (const std::string name : {"scene.toml", "mine.html", "."}) {
    const Outcome outcome = hardcases({"corner_hit", "--page", name});
    EXPECT_EQ(outcome.exit_code, 2) << name;
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_THAT(outcome.err, HasSubstr("--page"));
  }
  EXPECT_EQ(std::filesystem::file_size(path("mine.html")), 12U);
  for (int k = 0; k < 2; ++k) EXPECT_EQ(hardcases({"corner_hit", "--page", "cases.html"}).exit_code, 0);
}

TEST_F(HardCases, AFixedStepMethodIsToldFromTheEngines) {
  const Outcome outcome = hardcases({"two_pairs_at_once", "ball_comes_to_rest", "--method", "naive-edge"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("two_pairs_at_once"), HasSubstr("not run: asks for"), HasSubstr("1 cases run")));
}

TEST_F(HardCases, CasesThatAnEngineDoesNotCoverAreCountedAndNeverHold) {
  const Outcome some = hardcases({"corner_hit", "galperin_314159", "--engine", "textbook-float"});
  EXPECT_EQ(some.exit_code, 0);
  EXPECT_THAT(some.out, HasSubstr("2 cases, 1 not run, 1 runs"));
  const Outcome none = hardcases({"galperin_314159", "--engine", "textbook-float"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, HasSubstr("--engine textbook-float: this engine covers none of these cases"));
}

TEST_F(HardCases, WrongLinesExitTwoWithASentence) {
  using Line = std::vector<std::string>;
  for (const Line& line : {Line{"no_such_case"}, Line{"--family", "easy"}, Line{"--engine", "steam"}, Line{"--method", "leap"},
                           Line{"--dt", "0.1"}, Line{"--method", "naive", "--dt", "0"}, Line{"--method", "naive", "--json"},
                           Line{"--method", "naive", "--page", "a.html"}, Line{"--method", "naive", "--engine", "fast"},
                           Line{"nowhere.toml"}, Line{"--show", "none"}}) {
    const Outcome outcome = hardcases(line);
    EXPECT_EQ(outcome.exit_code, 2) << line.front();
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_THAT(outcome.err, StartsWith("carom: "));
  }
}

}  // namespace
}  // namespace carom::test
