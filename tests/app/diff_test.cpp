// carom diff: equal runs, runs of other engines and methods, and what cannot be compared.

#include "support/program_test.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

namespace carom::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class DiffCommand : public ProgramTest {
 protected:
  DiffCommand() : ProgramTest(fifty_disks) { run_into("a", {"--events"}); }

  void run_into(const std::string& out, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"run", "gas.toml", "-q", "--out", out});
    const Outcome outcome = carom(more);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
};

TEST_F(DiffCommand, OfEqualRunsIsZero) {
  run_into("b", {"--events"});
  const Outcome outcome = carom({"diff", "a", "b"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("a and b are the same run: state hash "));
  EXPECT_THAT(outcome.out, HasSubstr("the rms distance never exceeds 0.001 diameters"));
  EXPECT_EQ(carom({"diff", "a", "b/trajectory.h5md"}).exit_code, 0);
}

TEST_F(DiffCommand, OfTwoEnginesFindsRoundingAndTheSameCollisions) {
  run_into("b", {"--events", "--engine", "textbook"});
  const Outcome outcome = carom({"diff", "a", "b", "--json"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  const json found = json::parse(outcome.out);
  EXPECT_EQ(found["same"], false);
  ASSERT_EQ(found["distances"].size(), 5U);
  EXPECT_EQ(found["distances"][0]["largest"], 0.0);
  EXPECT_GT(found["distances"][1]["largest"], 0.0);
  EXPECT_LT(found["distances"][1]["largest"], 1e-9) << "both are right to rounding at the beginning";
  EXPECT_GT(found["equal_collisions"], 10);
  EXPECT_THAT(carom({"diff", "a", "b"}).out, HasSubstr("a and b differ: state hash "));
}

TEST_F(DiffCommand, OfNaiveStepsFindsWhereTheyPart) {
  run_into("naive", {"--events", "--method", "naive", "--dt", "0.05"});
  const Outcome outcome = carom({"diff", "naive", "a", "--json"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  const json found = json::parse(outcome.out);
  EXPECT_EQ(found["parted_at"], 0.5);
  EXPECT_GT(found["runs"][0]["deepest_overlap"], 1e-3);
  EXPECT_LT(found["runs"][1]["deepest_overlap"], 1e-12);
  ASSERT_TRUE(found["first_different_collision"].is_array());
  const json first = found["first_different_collision"];
  EXPECT_TRUE(first[0]["disk"] != first[1]["disk"] || first[0]["partner"] != first[1]["partner"]);
  EXPECT_THAT(carom({"diff", "naive", "a"}).out, HasSubstr("the first collision that differs:"));
}

/// 1 would say that they differ.
TEST_F(DiffCommand, WhoseOutputIsLostIsTwo) {
  ASSERT_EQ(carom({"run", "gas.toml", "-q"}).exit_code, 0);
  for (const char* form : {"", "--json"}) {
    const Outcome outcome = run_program(
        directory_.path(), {"sh", "-c", std::string("exec \"$0\" diff gas gas ") + form + " > /dev/full", CAROM_PROGRAM});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("cannot write to standard output: No space left on device"));
  }
}

TEST_F(DiffCommand, WithoutALogSaysSo) {
  run_into("b");
  EXPECT_THAT(carom({"diff", "a", "b"}).out, HasSubstr("collisions: not compared; b has no event log"));
}

TEST_F(DiffCommand, RefusesWhatCannotBeCompared) {
  run_into("other", {"--set", "box.x=[0.0, 11.0]"});
  refused({"diff", "a", "other"}, "a and other are no runs of the same disks in the same box: the box is [0, 10] along x");
  refused({"diff", "a", "nowhere"}, "nowhere: there is no such directory");
  refused({"diff", "gas.toml", "a"}, "gas.toml: this is no trajectory.h5md");
  run_into("fewer", {"--set", "disks.0.count=49"});
  refused({"diff", "a", "fewer"}, "the first has 50 disks and the second 49");
}

}  // namespace
}  // namespace carom::test
