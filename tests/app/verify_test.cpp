// carom run --verify K: what it says where all is well, and which options it does not go with.

#include "support/program_test.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

namespace carom::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

const std::string thirty_disks = R"([box]
x = [0.0, 8.0]
y = [0.0, 8.0]
boundary = "periodic"

[[disks]]
count = 30
radius = 0.4
mass = 1.0
positions = "random"
velocities = { temperature = 1.0 }

[collision]
rule = "specular"

[run]
collisions = 500
)";

class VerifyOption : public ProgramTest {
 protected:
  VerifyOption() : ProgramTest(thirty_disks) {}
};

TEST_F(VerifyOption, SaysThatInvariantsHold) {
  const Outcome outcome = carom({"run", "gas.toml", "--verify", "100", "--out", "out"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, ::testing::ContainsRegex("invariants +hold"));
  EXPECT_THAT(outcome.out, HasSubstr("every 100 events"));
  const json summary = json::parse(text_of(file("out/summary.json")));
  EXPECT_EQ(summary["verified"]["every"], 100);
  EXPECT_GE(summary["verified"]["checks"], 5);
  EXPECT_TRUE(summary["verified"]["faults"].empty());
  EXPECT_EQ(carom({"verify", "out"}).exit_code, 0) << "what was checked is no result";
}

TEST_F(VerifyOption, IsNotMentionedWhereItWasNotAskedFor) {
  const Outcome outcome = carom({"run", "gas.toml", "--json", "--out", "out"});
  EXPECT_FALSE(json::parse(outcome.out).contains("verified"));
  EXPECT_TRUE(json::parse(outcome.out).contains("numerics"));
}

TEST_F(VerifyOption, RefusesWhatItCannotDo) {
  EXPECT_THAT(carom({"run", "gas.toml", "--verify", "0"}).err, HasSubstr("--verify 0: give the number of events"));
  const Outcome stepped = carom({"run", "gas.toml", "--verify", "10", "--method", "grid", "--dt", "0.01"});
  EXPECT_EQ(stepped.exit_code, 2);
  EXPECT_THAT(stepped.err, HasSubstr("--verify checks the plans of an event-driven engine"));
}

}  // namespace
}  // namespace carom::test
