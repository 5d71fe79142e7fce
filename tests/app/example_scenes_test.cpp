// Every scene of docs/scenes runs to its end, exactly.

#include "support/child_process.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace carom::test {
namespace {

std::vector<std::string> scenes() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(CAROM_SOURCE_DIR "/docs/scenes")) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

class ExampleScene : public ::testing::TestWithParam<std::string> {};

TEST_P(ExampleScene, RunsToItsEndWithoutOverlap) {
  const TemporaryDirectory directory;
  const Outcome outcome =
      run_carom(directory.path(), {"run", CAROM_SOURCE_DIR "/docs/scenes/" + GetParam() + ".toml", "--json", "--out", "results"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const nlohmann::json summary = nlohmann::json::parse(outcome.out);
  // The project's promise for any sampled state; what is measured is rounding of positions.
  EXPECT_LT(summary["overlap"]["max_relative"].get<double>(), 1e-12);
  EXPECT_GT(summary["overlap"]["checked"].get<std::uint64_t>(), 0U);
  // Rounding of a few 1e5 events at 1e-16 each, all that nothing gave or took.
  const nlohmann::json& energy = summary["energy"];
  EXPECT_LT(std::abs(energy.value("unaccounted", energy["relative_drift"].get<double>())), 1e-12);
  // Time, or a number of collisions; a ball that bounces ever lower stops the clock, and growth stops where it was told to.
  const std::string stopped = summary["stopped"];
  const std::map<std::string, std::string> others = {{"bouncing_ball", "collapsed"}};
  if (others.contains(GetParam())) {
    EXPECT_EQ(stopped, others.at(GetParam()));
  } else {
    EXPECT_TRUE(stopped == "time" || stopped == "collisions" || stopped == "grown") << stopped;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ExampleScene, ::testing::ValuesIn(scenes()), [](const auto& name) { return name.param; });

}  // namespace
}  // namespace carom::test
