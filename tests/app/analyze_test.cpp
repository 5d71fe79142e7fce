// carom analyze: the numbers of the run, afterwards, and what it says where it cannot.

#include "support/program_test.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace carom::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class AnalyzeCommand : public ProgramTest {
 protected:
  AnalyzeCommand() : ProgramTest(fifty_disks) {}
  void SetUp() override {
    const Outcome run =
        carom({"run", "gas.toml", "--set", "observe={ pressure = { every = 0.5 }, speeds = { every = 1.0 } }", "--events", "-q"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }
  [[nodiscard]] Outcome analyze(std::vector<std::string> more) {
    more.insert(more.begin(), {"analyze", "gas"});
    return carom(more);
  }
  [[nodiscard]] json numbers(const std::string& path) const { return json::parse(text_of(file(path)))["observables"]; }
};

TEST_F(AnalyzeCommand, GivesTheNumbersAndTablesOfTheRun) {
  const Outcome outcome = analyze({});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("pressure, every 0.5"));
  EXPECT_EQ(numbers("gas-analysis/analysis.json"), numbers("gas/summary.json"));
  for (const char* table : {"observe_speeds.csv", "observe_energies.csv"})
    EXPECT_EQ(text_of(file(std::string("gas-analysis/") + table)), text_of(file(std::string("gas/") + table)));
}

TEST_F(AnalyzeCommand, MeasuresWhatTheRunDidNot) {
  const Outcome outcome = analyze({"free_flight={ bins = 30 }", "temperature", "--json", "--out", "later"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const json found = json::parse(outcome.out);
  EXPECT_EQ(found, json::parse(text_of(file("later/analysis.json"))));
  EXPECT_EQ(found["observables"].size(), 2U);
  EXPECT_THAT(found["resolved_scene"].get<std::string>(), HasSubstr("free_flight = { bins = 30 }\n"));
}

TEST_F(AnalyzeCommand, ReplacesNothingUnasked) {
  ASSERT_EQ(analyze({"-q"}).exit_code, 0);
  const std::string before = text_of(file("gas-analysis/analysis.json"));
  const Outcome again = analyze({"temperature"});
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.err, HasSubstr("gas-analysis: the directory already holds results"));
  EXPECT_EQ(text_of(file("gas-analysis/analysis.json")), before);
  EXPECT_EQ(analyze({"temperature", "--force", "-q"}).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(file("gas-analysis/observe_speeds.csv"))) << "another analysis' table must not stay";
}

TEST_F(AnalyzeCommand, WithinADirectoryItWritesBesideIt) {
  EXPECT_EQ(run_program(file("gas"), {CAROM_PROGRAM, "analyze", ".", "-q"}).exit_code, 0);
  EXPECT_EQ(numbers("gas-analysis/analysis.json"), numbers("gas/summary.json"));
}

TEST_F(AnalyzeCommand, RefusesInOneSentenceAndWritesNothing) {
  refused({"analyze", "gas", "presure"},
          "carom: gas: presure=true: [observe] has no key \"presure\"; did you mean \"pressure\"?");
  refused({"analyze", "gas", "pressure={ every = 0.3 }"},
          "carom: gas: pressure asks for states every 0.3, and the run has them every 0.5");
  refused({"analyze", "gas", "pressure={"}, "the value is not TOML");
  EXPECT_FALSE(std::filesystem::exists(file("gas-analysis")));
}

}  // namespace
}  // namespace carom::test
