// carom compare SCENE --trajectory FILE: what the program says of trajectories that it wrote itself, and what it refuses.

#include "support/program_test.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

namespace carom::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class CompareTrajectory : public ProgramTest {
 protected:
  CompareTrajectory() : ProgramTest(fifty_disks) {}
  void run_into(const std::string& out, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"run", "gas.toml", "-q", "--csv", "--out", out});
    const Outcome outcome = carom(more);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
};

TEST_F(CompareTrajectory, OfExactEventsStaysWithinRounding) {
  run_into("exact");
  for (const std::string name : {"samples.csv", "trajectory.h5md"}) {
    const Outcome outcome = carom({"compare", "gas.toml", "--trajectory", "exact/" + name, "--json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const json found = json::parse(outcome.out);
    EXPECT_EQ(found["distances"].size(), 5U);
    EXPECT_EQ(found["distances"][0]["largest"], 0.0);
    EXPECT_LT(found["distances"][4]["rms"], 1e-6);
    EXPECT_TRUE(found["departure"].is_null());
    EXPECT_EQ(found["overlapping_frames"], 0);
    EXPECT_LT(found["largest_energy_drift"], 1e-12);
  }
  EXPECT_THAT(carom({"compare", "gas.toml", "--trajectory", "exact/samples.csv"}).out,
              HasSubstr("it stays within 0.001 diameters in all 5 frames\ndisks overlap in no frame\nenergy changes by "));
}

TEST_F(CompareTrajectory, OfNaiveStepsDeparts) {
  run_into("naive", {"--method", "naive", "--dt", "0.05"});
  const Outcome outcome = carom({"compare", "gas.toml", "--trajectory", "naive/samples.csv"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("it departs by 0.001 diameters at t = 0.5, after "));
  EXPECT_THAT(outcome.out, HasSubstr("disks overlap in "));
}

TEST_F(CompareTrajectory, IsRefusedWithoutADirectoryBeingMade) {
  run_into("other", {"--set", "box.x=[0.0, 11.0]"});
  refused({"compare", "gas.toml", "--trajectory", "other/trajectory.h5md"}, "the box is [0, 11] along x in the first");
  refused({"compare", "gas.toml", "--seed", "5", "--trajectory", "other/samples.csv"}, "is not the start of this scene: disk ");
  refused({"compare", "gas.toml", "--trajectory", "nowhere.csv"}, "nowhere.csv");
  refused({"compare", "gas.toml", "--every", "0.1"}, "--trajectory");
  refused({"compare", "gas.toml", "--trajectory", "other/samples.csv", "--resume"},
          "--trajectory and --resume exclude each other; give one of them");
  EXPECT_FALSE(std::filesystem::exists(file("gas-compare")));
}

}  // namespace
}  // namespace carom::test
