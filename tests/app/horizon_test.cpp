// carom horizon, and carom run --verify-horizon: what they print and how they end.

#include "support/program_test.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <carom/version.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <string>

namespace carom::test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

namespace fs = std::filesystem;

const std::string equilibrated_disks = fifty_disks + "equilibrate = { collisions_per_disk = 5 }\n";

class HorizonCommand : public ProgramTest {
 protected:
  HorizonCommand() : ProgramTest(equilibrated_disks) {}
};

TEST_F(HorizonCommand, PrintsARowForEveryPrecisionAndOneSentenceAndWritesNothing) {
  const Outcome outcome = carom({"horizon", "gas.toml", "--collisions", "20000"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("textbook-float"), HasSubstr("fast"), HasSubstr("textbook-quad"),
                                 HasSubstr("Lyapunov exponent: "), HasSubstr("In double precision this trajectory is right")));
  EXPECT_FALSE(fs::exists(file("gas")));
}

TEST_F(HorizonCommand, QuietPrintsTheSentenceAlone) {
  const Outcome outcome = carom({"horizon", "gas.toml", "--collisions", "20000", "-q"});
  EXPECT_THAT(outcome.out, StartsWith("In double precision this trajectory is right to 0.001 diameters"));
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 1);
}

TEST_F(HorizonCommand, JsonHoldsEveryRowAndTheExponent) {
  const Outcome outcome = carom({"horizon", "gas.toml", "--collisions", "20000", "--json", "--seed", "3"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, IsEmpty());
  const json result = json::parse(outcome.out);
  EXPECT_EQ(result["carom"]["version"], build_info().version);
  EXPECT_EQ(result["seed"], 3);
  EXPECT_EQ(result["disks"], 50);
  const json& horizon = result["horizon"];
  EXPECT_EQ(horizon["tolerance"], 1e-3);
  EXPECT_EQ(horizon["engine"], "fast");
  EXPECT_EQ(horizon["ended"], "parted");
  EXPECT_GT(horizon["lyapunov"]["per_time"], 0.0);
  EXPECT_GT(horizon["lyapunov"]["per_collision_error"], 0.0);
  EXPECT_GE(horizon["rows"].size(), 4U);
  for (const json& row : horizon["rows"]) {
    EXPECT_GT(row["time"], 0.0) << row;
    EXPECT_GT(row["collisions_per_disk"], 0.0) << row;
    EXPECT_GT(row["seconds"], 0.0) << row;
    EXPECT_EQ(row["estimated"], row["against"].is_null()) << row;
    EXPECT_EQ(row["first_difference"].is_null(), row["against"].is_null()) << row;
  }
  EXPECT_THAT(result["sentence"].get<std::string>(), StartsWith("In double precision"));
}

TEST_F(HorizonCommand, OverridesChangeTheScene) {
  const Outcome outcome =
      carom({"horizon", "gas.toml", "--collisions", "20000", "--json", "--set", "disks.0.count=20", "--engine", "textbook"});
  const json result = json::parse(outcome.out);
  EXPECT_EQ(result["disks"], 20);
  EXPECT_EQ(result["horizon"]["engine"], "textbook");
}

TEST_F(HorizonCommand, SaysWhenThereIsNothingToPart) {
  const Outcome outcome = carom({"horizon", "-q", "--collisions", "20000", CAROM_SOURCE_DIR "/docs/scenes/newtons_cradle.toml"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("to the end of the run"));
}

TEST_F(HorizonCommand, BrokenSceneExitsTwoWithOneSentence) {
  write_text(file("gas.toml"), equilibrated_disks + "tiem = 3.0\n");
  const Outcome outcome = carom({"horizon", "gas.toml", "--collisions", "20000"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_THAT(outcome.err, StartsWith("carom: gas.toml:20:"));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1);
}

TEST_F(HorizonCommand, InterruptedSaysHowFarItCameAndExits130) {
  const auto signal_soon = [&](pid_t child) {
    EXPECT_TRUE(wait_until([&] { return handles(child, SIGINT); }));
    kill(child, SIGINT);
  };
  const Outcome outcome =
      carom({"horizon", "gas.toml", "--set", "disks.0.count=40000", "--set", "box.x=[0.0,400.0]", "--set", "box.y=[0.0,400.0]",
             "--set", "run.time=200.0", "--set", "run.equilibrate.collisions_per_disk=1"},
            signal_soon);
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_THAT(outcome.out + outcome.err, HasSubstr("nterrupted"));
}

TEST_F(HorizonCommand, RunVerifiesItsOwnHorizonWhenAskedAsTheCommandDoes) {
  const Outcome outcome = carom({"run", "gas.toml", "--verify-horizon"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, IsEmpty());
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("worst overlap"), HasSubstr("In double precision this trajectory is right to 0.001")));
  const json beside = json::parse(text_of(file("gas/summary.json")))["horizon"];
  const json alone = json::parse(carom({"horizon", "gas.toml", "--json"}).out)["horizon"];
  EXPECT_EQ(beside["ended"], "parted");
  EXPECT_EQ(beside["lyapunov"], alone["lyapunov"]);
  ASSERT_EQ(beside["rows"].size(), alone["rows"].size());
  for (std::size_t k = 0; k < alone["rows"].size(); ++k) {
    EXPECT_EQ(alone["rows"][k]["time"], beside["rows"][k]["time"]);
    EXPECT_EQ(alone["rows"][k]["first_difference"], beside["rows"][k]["first_difference"]);
  }
}

TEST_F(HorizonCommand, RunAmongObstaclesHasTheHorizonOfTheEngineThatRanIt) {
  const char* stadium = CAROM_SOURCE_DIR "/docs/scenes/stadium.toml";
  const Outcome outcome = carom({"run", stadium, "--verify-horizon", "--set", "run.time=20", "--out", "out"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const json summary = json::parse(text_of(file("out/summary.json")));
  EXPECT_EQ(summary["engine"], "general");
  EXPECT_EQ(summary["horizon"]["engine"], "general");
  const Outcome alone = carom({"horizon", stadium, "--engine", "general", "--set", "run.time=20", "--json"});
  EXPECT_EQ(alone.exit_code, 0) << alone.err;
  EXPECT_EQ(json::parse(alone.out)["horizon"]["time"], summary["horizon"]["time"]);
}

TEST_F(HorizonCommand, OfOneDiskSaysThatExponentsAreOfPairs) {
  const char* sinai = CAROM_SOURCE_DIR "/docs/scenes/sinai.toml";
  const Outcome plain = carom({"horizon", sinai});
  EXPECT_EQ(plain.exit_code, 0) << plain.err;
  EXPECT_THAT(plain.out, HasSubstr("Lyapunov exponent: not measured, since it is over collisions of pairs, and collisions of one "
                                   "disk with walls or obstacles are none\n"));
  const Outcome all = carom({"horizon", sinai, "--spectrum"});
  EXPECT_EQ(all.exit_code, 2);
  EXPECT_THAT(all.err,
              HasSubstr("sinai.toml has 1 disk, and exponents are measured over collisions of pairs of disks; take two"));
}

TEST_F(HorizonCommand, OfOneDiskAmongObstaclesIsComparedSeveralTimesInItsFreeFlights) {
  const Outcome outcome = carom({"horizon", CAROM_SOURCE_DIR "/docs/scenes/lorentz.toml", "--json"});
  for (const json& row : json::parse(outcome.out)["horizon"]["rows"])
    EXPECT_TRUE(row["time"].is_null() || row["time"] > 0.0) << row;
}

TEST_F(HorizonCommand, RunSaysNothingOfHorizonsUnasked) {
  const Outcome outcome = carom({"run", "gas.toml", "--json"});
  EXPECT_FALSE(json::parse(outcome.out).contains("horizon"));
}

TEST_F(HorizonCommand, AnExponentOfNoCollisionsIsRefused) {
  const Outcome outcome = carom({"horizon", "gas.toml", "--collisions", "0"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, StartsWith("carom: --collisions 0: "));
}

}  // namespace
}  // namespace carom::test
