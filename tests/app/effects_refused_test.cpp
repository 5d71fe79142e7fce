// Commands that know the collision rule and hard walls only say so of scenes with effects, and write nothing.

#include "support/program_test.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace carom::test {
namespace {

using ::testing::HasSubstr;

class EffectsRefused : public ProgramTest {
 protected:
  EffectsRefused() : ProgramTest(fifty_disks) {}
};

TEST_F(EffectsRefused, ByEveryCommandThatWouldIgnoreThem) {
  const std::vector<std::vector<std::string>> commands = {
      {"compare", "gas.toml", "--out", "out"}, {"horizon", "gas.toml"}, {"run", "gas.toml", "--verify-horizon", "--out", "out"}};
  for (std::vector<std::string> command : commands) {
    for (const auto& [change, name] : {std::pair{"shear={rate=0.1}", "shear"}, {"drag={rate=0.1}", "drag"}}) {
      std::vector<std::string> words = command;
      words.insert(words.end(), {"--set", change});
      const Outcome outcome = carom(words);
      EXPECT_EQ(outcome.exit_code, 2) << command[0] << " with " << change << outcome.err;
      EXPECT_THAT(outcome.err,
                  HasSubstr(std::string("this scene asks for ") + name + " besides, which exact events alone simulate"));
      EXPECT_FALSE(std::filesystem::exists(file("out")));
    }
  }
}

TEST_F(EffectsRefused, AsAreChangesByEveryStudyOfErrors) {
  const std::vector<std::vector<std::string>> commands = {{"compare", "gas.toml", "--out", "out"},
                                                          {"compare", "gas.toml", "--trajectory", "own.npy"},
                                                          {"horizon", "gas.toml"},
                                                          {"horizon", "gas.toml", "--spectrum"},
                                                          {"run", "gas.toml", "--verify-horizon", "--out", "out"}};
  for (std::vector<std::string> words : commands) {
    words.insert(words.end(), {"--set", "changes=[{time=0.5,scale_velocities=2}]"});
    const Outcome outcome = carom(words);
    EXPECT_EQ(outcome.exit_code, 2) << words[0] << ": " << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("carom: gas.toml: "));
    EXPECT_THAT(outcome.err, HasSubstr("trajectories that go on as they began, and this scene has [[changes]]; "));
    EXPECT_THAT(outcome.err, HasSubstr("--set 'changes=[]'"));
    EXPECT_FALSE(std::filesystem::exists(file("out")));
  }
}

TEST_F(EffectsRefused, ByFixedStepsThatKnowRestitutionAndGravityAlone) {
  const std::vector<std::string> command = {"run", "gas.toml", "--method", "grid", "--dt", "0.01", "--out", "out", "--set"};
  std::vector<std::string> words = command;
  words.emplace_back("shear={rate=0.1}");
  const Outcome refused = carom(words);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--method grid: fixed-step methods know the collision rule, hard walls, restitution, "
                                     "gravity, inelastic_walls, obstacles, circle; this scene asks for shear besides"));
  EXPECT_FALSE(std::filesystem::exists(file("out")));
  words.back() = "collision.restitution=0.9";
  EXPECT_EQ(carom(words).exit_code, 0);
}

TEST_F(EffectsRefused, ButNotAtTheirNeutralValue) {
  const Outcome outcome =
      carom({"run", "gas.toml", "--method", "grid", "--dt", "0.01", "--set", "collision.restitution=1.0", "--out", "out"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

TEST_F(EffectsRefused, ByAnEngineThatDoesNotCoverThem) {
  const Outcome outcome = carom({"run", "gas.toml", "--engine", "fast", "--set", "collision.restitution=0.9", "--out", "out"});
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(file("out")));
}

}  // namespace
}  // namespace carom::test
