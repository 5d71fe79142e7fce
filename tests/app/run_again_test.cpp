// carom verify and carom info --reproduce: a finished run made again.

#include "support/program_test.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace carom::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

class RunAgain : public ProgramTest {
 protected:
  RunAgain() : ProgramTest(fifty_disks) {}

  void change_summary(const std::function<void(nlohmann::ordered_json&)>& change) {
    auto summary = nlohmann::ordered_json::parse(text_of(file("gas/summary.json")));
    change(summary);
    write_text(file("gas/summary.json"), summary.dump(2));
  }
};

TEST_F(RunAgain, ARunIsTheSameToTheLastBit) {
  ASSERT_EQ(carom({"run", "gas.toml", "--events", "--csv", "--xyz", "-q", "--set", "collision.restitution=0.9"}).exit_code, 0);
  const Outcome outcome = carom({"verify", "gas"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_THAT(outcome.out,
              AllOf(StartsWith("gas: run again, the same to the last bit: trajectory.h5md (36 datasets), trajectory.xyz ("),
                    HasSubstr("samples.csv ("), HasSubstr("summary.json")));
}

TEST_F(RunAgain, ARunThatWasExtendedIsTheSameWithTheStepsThatItBeganWith) {
  write_text(file("observed.toml"), std::string(fifty_disks) + "[observe]\nspeeds = true\nviscosity = true\nh_function = true\n");
  ASSERT_EQ(carom({"run", "observed.toml", "--out", "gas", "-q", "--checkpoint-every", "1h"}).exit_code, 0);
  for (const char* end : {"64", "80"}) {
    ASSERT_EQ(carom({"extend", "gas", "-q", "--time", end}).exit_code, 0);
    const Outcome outcome = carom({"verify", "gas"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
  }
  EXPECT_THAT(text_of(file("gas/summary.json")), HasSubstr("viscosity = { every = 0.0078125 }"));  // 2 / 256
}

TEST_F(RunAgain, EngineAndMethodAreThoseOfTheRun) {
  ASSERT_EQ(carom({"run", "gas.toml", "-q", "--engine", "textbook-float"}).exit_code, 0);
  EXPECT_EQ(carom({"verify", "gas"}).exit_code, 0);
  ASSERT_EQ(carom({"run", "gas.toml", "-q", "--force", "--method", "naive", "--dt", "0.01"}).exit_code, 0);
  EXPECT_EQ(carom({"verify", "gas"}).exit_code, 0);
  ASSERT_EQ(carom({"run", "gas.toml", "-q", "--force", "--method", "soft", "--dt", "0.001", "--stiffness", "4321.0123456789"})
                .exit_code,
            0);
  EXPECT_EQ(carom({"verify", "gas"}).exit_code, 0);
  EXPECT_THAT(carom({"info", "gas", "--reproduce"}).out, HasSubstr(" --method soft --dt 0.001 --stiffness 4321.0123456789\n"));
}

TEST_F(RunAgain, AChangeAfterWhichAnotherEngineGoesOnIsTheSame) {
  write_text(file("gas.toml"), std::string(fifty_disks) +
                                   "[drag]\nrate = 0.1\n[[changes]]\ntime = 0.5\nset = [\"drag.rate=0\"]\n"
                                   "[[changes]]\ntime = 1.0\nset = [\"collision.restitution=0.5\"]\n");
  for (const char* asked : {"auto", "textbook"}) {
    ASSERT_EQ(carom({"run", "gas.toml", "-q", "--force", "--events", "--engine", asked}).exit_code, 0);
    EXPECT_EQ(carom({"verify", "gas"}).exit_code, 0) << asked;
    EXPECT_THAT(carom({"info", "gas", "--reproduce"}).out, HasSubstr(fmt::format(" --engine {}\n", asked)));
  }
}

TEST_F(RunAgain, WhatIsNotTheSameIsNamed) {
  ASSERT_EQ(carom({"run", "gas.toml", "--csv", "-q"}).exit_code, 0);
  std::string table = text_of(file("gas/samples.csv"));
  table[table.rfind('5')] = '6';
  write_text(file("gas/samples.csv"), table);
  change_summary([](auto& summary) { summary["events"]["pair"] = 1; });
  const Outcome outcome = carom({"verify", "gas"});
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("not the same"), HasSubstr("samples.csv: line "),
                                 HasSubstr("summary.json: /events/pair is 1 against ")));

  change_summary([](auto& summary) {
    std::string scene = summary["resolved_scene"];
    summary["resolved_scene"] = scene.replace(scene.find("seed = 1"), 8, "seed = 2");
  });
  const Outcome other = carom({"verify", "gas"});
  EXPECT_EQ(other.exit_code, 4);
  EXPECT_THAT(other.out, AllOf(HasSubstr("trajectory.h5md: /observables/kinetic_energy/value: row 0 is the first that differs"),
                               HasSubstr("summary.json: 1")));
}

TEST_F(RunAgain, WhatCannotBeRunAgainIsRefused) {
  EXPECT_THAT(carom({"verify", "nowhere"}).err, HasSubstr("no directory of a finished run"));
  ASSERT_EQ(carom({"run", "gas.toml", "-q"}).exit_code, 0);
  change_summary([](auto& summary) { summary["stopped"] = "interrupted"; });
  EXPECT_THAT(carom({"verify", "gas"}).err, HasSubstr("was interrupted"));
  change_summary([](auto& summary) { summary.erase("resolved_scene"); });
  EXPECT_THAT(carom({"verify", "gas"}).err, HasSubstr("run the scene again"));
  write_text(file("gas/summary.json"), "{");
  const Outcome outcome = carom({"info", "gas", "--reproduce"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("damaged or cut short"));
}

TEST_F(RunAgain, ADirectoryForTemporaryFilesThatIsNotThereIsNamed) {
  ASSERT_EQ(carom({"run", "gas.toml", "-q"}).exit_code, 0);
  const Outcome outcome = run_program(directory_.path(), {"env", "TMPDIR=/no/such/place", CAROM_PROGRAM, "verify", "gas"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err,
            "carom: TMPDIR=/no/such/place: there is no such directory for temporary files; set TMPDIR to one that is there\n");
}

TEST_F(RunAgain, OfADamagedTrajectoryHdf5HasNothingToSay) {
  ASSERT_EQ(carom({"run", "gas.toml", "-q"}).exit_code, 0);
  std::string bytes = text_of(file("gas/trajectory.h5md"));
  for (std::size_t at = 700; at < 3600; at += 100) bytes.at(at) = '\xff';
  write_text(file("gas/trajectory.h5md"), bytes);
  const Outcome outcome = carom({"verify", "gas"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("it is damaged or cut short"));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

TEST_F(RunAgain, TheCommandsPrintedMakeTheSameRun) {
  ASSERT_EQ(carom({"run", "gas.toml", "--csv", "-q", "--seed", "5", "--out", "it's one"}).exit_code, 0);
  const Outcome printed = carom({"info", "it's one/", "--reproduce"});
  ASSERT_EQ(printed.exit_code, 0) << printed.err;
  EXPECT_EQ(run_program(directory_.path(), {"sh", "-ec", printed.out}).exit_code, 0);
  EXPECT_EQ(text_of(file("it's one-again/samples.csv")), text_of(file("it's one/samples.csv")));
}

}  // namespace
}  // namespace carom::test
