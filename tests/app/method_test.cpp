// carom run --method: fixed steps through the same door, into the same files.

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
using ::testing::IsEmpty;

const std::string channel = R"([box]
x = [0.0, 8.0]
y = [0.0, 8.0]
boundary = { x = "periodic", y = "walls" }

[[disks]]
count = 30
radius = 0.4
mass = 1.0
positions = "random"
velocities = { temperature = 1.0 }

[collision]
rule = "specular"

[run]
time = 2.0
sample_every = 0.0625

[output]
csv = true
xyz = true
events = true
)";

class MethodOption : public ProgramTest {
 protected:
  MethodOption() : ProgramTest(channel) {}
  [[nodiscard]] std::string text(const std::string& name) const { return text_of(file(name)); }
};

TEST_F(MethodOption, EveryMethodWritesTheSameFilesAsTheExactOne) {
  ASSERT_EQ(carom({"run", "gas.toml", "--out", "exact"}).exit_code, 0);
  for (const std::string method : {"naive", "naive-edge", "guarded", "grid", "backtrack", "swept", "soft"}) {
    const Outcome outcome = carom({"run", "gas.toml", "--method", method, "--dt", "0.01", "--out", method});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, IsEmpty());
    for (const char* file : {"summary.json", "trajectory.h5md", "trajectory.xyz", "samples.csv"})
      EXPECT_TRUE(std::filesystem::exists(directory_.path() / method / file)) << method << " " << file;
    const json summary = json::parse(text(method + "/summary.json"));
    EXPECT_EQ(summary["engine"], method);
    EXPECT_EQ(summary["dt"], 0.01);
    EXPECT_EQ(summary["samples"], 33);
    EXPECT_EQ(summary["events"]["other"], 201);  // steps, both ends included
    if (method == "backtrack" || method == "swept")
      EXPECT_LT(summary["overlap"]["max_relative"], 1e-12);  // samples are at steps, where pairs are apart again
    else
      EXPECT_GT(summary["overlap"]["max_relative"], 1e-6);
  }
  EXPECT_FALSE(json::parse(text("exact/summary.json")).contains("dt"));
}

TEST_F(MethodOption, TheFirstSampleIsTheSameStart) {
  ASSERT_EQ(carom({"run", "gas.toml", "--out", "exact"}).exit_code, 0);
  ASSERT_EQ(carom({"run", "gas.toml", "--method", "grid", "--out", "grid"}).exit_code, 0);
  const std::string exact = text("exact/samples.csv"), grid = text("grid/samples.csv");
  std::size_t lines = 0, end = 0;
  while (lines < 31) end = exact.find('\n', end) + 1, ++lines;
  EXPECT_EQ(exact.substr(0, end), grid.substr(0, end));
}

TEST_F(MethodOption, TheStepIsTheSamplingGridUnlessGiven) {
  ASSERT_EQ(carom({"run", "gas.toml", "--method", "guarded"}).exit_code, 0);
  EXPECT_EQ(json::parse(text("gas/summary.json"))["dt"], 0.0625);
}

TEST_F(MethodOption, AStiffnessIsToldWhereverTheStepIs) {
  const Outcome run =
      carom({"run", "gas.toml", "--method", "soft", "--dt", "0.002", "--stiffness", "2500", "--checkpoint-every", "1h"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("method soft, dt = 0.002, stiffness = 2500;"));
  EXPECT_EQ(json::parse(text("gas/summary.json"))["stiffness"], 2500.0);
  for (const char* of : {"gas/summary.json", "gas/trajectory.h5md"})
    EXPECT_THAT(carom({"info", of}).out, HasSubstr("\n  method      soft, dt = 0.002, stiffness = 2500\n"));
  ASSERT_EQ(carom({"extend", "gas", "--time", "4", "-q"}).exit_code, 0);
  EXPECT_EQ(json::parse(text("gas/summary.json"))["stiffness"], 2500.0);
  EXPECT_EQ(carom({"verify", "gas"}).exit_code, 0);
  ASSERT_EQ(carom({"run", "gas.toml", "--method", "soft", "--dt", "0.002", "--out", "derived"}).exit_code, 0);
  EXPECT_FALSE(json::parse(text("derived/summary.json")).contains("stiffness"));
}

TEST_F(MethodOption, WhatDoesNotFitTogetherIsRefusedInOneSentence) {
  const auto refused = [&](const std::vector<std::string>& more, const std::string& what) {
    std::vector<std::string> arguments = {"run", "gas.toml"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = carom(arguments);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr(what));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(directory_.path() / "gas"));
  };
  refused({"--method", "leapfrog"}, "choose exact or one of: naive, naive-edge, guarded, grid, backtrack, swept, soft");
  refused({"--dt", "0.1"}, "exact events need none");
  refused({"--method", "grid", "--engine", "textbook"}, "leave out one of the two");
  refused({"--method", "grid", "--dt", "0"}, "it must be positive and finite");
  refused({"--method", "grid", "--dt", "-1"}, "it must be positive and finite");
  refused({"--method", "grid", "--dt", "nan"}, "it must be positive and finite");
  refused({"--method", "grid", "--dt", "1e300"}, "take a shorter one");
  refused({"--method", "grid", "--dt", "soon"}, "--dt");
  refused({"--stiffness", "5000"}, "--stiffness is that of the springs of --method soft; exact events have none");
  refused({"--method", "grid", "--stiffness", "5000"}, "has no springs, and so no stiffness");
  refused({"--method", "soft", "--stiffness", "0"}, "the stiffness is 0; it must be positive and finite");
  refused({"--method", "soft", "--stiffness", "5000"}, "a time step of 0.0625 is unstable with a stiffness of 5000");
  refused({"--method", "soft", "--dt", "0.001", "--stiffness", "1e-3"}, "a disk would leave the box through a wall");
}

}  // namespace
}  // namespace carom::test
