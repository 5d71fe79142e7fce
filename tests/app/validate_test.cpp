// carom validate from the outside.

#include "support/child_process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

namespace carom::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

namespace fs = std::filesystem;

class ValidateCommand : public ::testing::Test {
 protected:
  Outcome validate(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "validate");
    return run_carom(directory_.path(), arguments);
  }
  [[nodiscard]] fs::path file(const std::string& name) const { return directory_.path() / name; }
  TemporaryDirectory directory_;
};

TEST_F(ValidateCommand, ListNamesTheTrialsAndWritesNothing) {
  const Outcome outcome = validate({"--list"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("Maxwell and Boltzmann\n  relaxation-periodic-one-speed\n"),
                                 HasSubstr("transition-0.708 (--full)")));
  EXPECT_EQ(validate({"--list", "--only", "transition-0.708"}).out.find("relaxation"), std::string::npos);
  EXPECT_TRUE(fs::is_empty(directory_.path()));
}

TEST_F(ValidateCommand, WhatMakesNoSenseIsRefusedInOneSentence) {
  for (const auto& [arguments, sentence] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"--quick", "--full"}, "--quick and --full: give one of them"},
           {{"--force", "--resume"}, "--force begins anew and --resume goes on"},
           {{"--only", "pressure-7"},
            "--only pressure-7: there is no such trial and no such group; carom validate --list names them all"},
           {{"--resume", "--only", "equipartition-walls"}, "trials.jsonl: there is no such file, so that no trial is finished"},
           {{"--seed", "-1"}, "--seed"}}) {
    const Outcome outcome = validate(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << sentence;
    EXPECT_THAT(outcome.err, HasSubstr(sentence));
    EXPECT_THAT(outcome.out, IsEmpty());
    EXPECT_TRUE(fs::is_empty(directory_.path())) << sentence;
  }
}

class PhysicsValidateCommand : public ValidateCommand {};

TEST_F(PhysicsValidateCommand, WritesItsFilesGoesOnFromThemAndExitsFourWhereACheckFails) {
  const std::vector<std::string> one = {"--only", "equipartition-walls", "--out", "found"};
  const Outcome outcome = validate(one);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("equipartition-walls"), HasSubstr("agrees"),
                                 HasSubstr("2 checks in 1 trial, seed 1: all hold"), HasSubstr("report.html")));
  for (const char* product : {"found/trials.jsonl", "found/report.html", "found/validation.json"})
    EXPECT_TRUE(fs::exists(file(product))) << product;
  const auto validation = nlohmann::json::parse(text_of(file("found/validation.json")));
  EXPECT_EQ(validation["failed"], 0);
  EXPECT_EQ(validation["trials"][0]["checks"][1]["holds"], true);

  EXPECT_EQ(validate(one).exit_code, 2) << "results are in the way";
  // Interrupted after a trial whose numbers are not those of theory: it is not run again, and fails.
  auto lines = text_of(file("found/trials.jsonl"));
  const auto at = lines.find("\"expected\":");
  ASSERT_NE(at, std::string::npos);
  lines.insert(at + 11, "9");
  write_text(file("found/trials.jsonl"), lines);
  fs::remove(file("found/validation.json"));
  const Outcome resumed = validate({"--only", "equipartition-walls", "--out", "found", "--resume", "--json"});
  EXPECT_EQ(resumed.exit_code, 4) << resumed.err;
  EXPECT_EQ(nlohmann::json::parse(resumed.out)["failed"], 1);
}

TEST_F(PhysicsValidateCommand, InterruptedItKeepsWhatIsFinishedAndSaysHowToGoOn) {
  const std::vector<std::string> two = {"validate", "--only", "equipartition-walls", "--only", "reversal-frozen",
                                        "--out",    "found"};
  const fs::path trials = file("found/trials.jsonl");
  const auto lines = [&] {
    const std::string text = fs::exists(trials) ? text_of(trials) : "";
    return std::count(text.begin(), text.end(), '\n');
  };
  const Outcome stopped = run_carom(directory_.path(), two, [&](pid_t child) {
    EXPECT_TRUE(wait_until([&] { return lines() == 2; }));
    kill(child, SIGINT);
  });
  EXPECT_EQ(stopped.exit_code, 130);
  EXPECT_THAT(stopped.err,
              AllOf(HasSubstr("interrupted; 1 finished trial in found/trials.jsonl"), HasSubstr("--resume goes on from there")));
  EXPECT_FALSE(fs::exists(file("found/validation.json")));

  const Outcome refused = validate({"--seed", "2", "--out", "found", "--resume"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("another seed"));
  EXPECT_EQ(lines(), 2);
}

}  // namespace
}  // namespace carom::test
