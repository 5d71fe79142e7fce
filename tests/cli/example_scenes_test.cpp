// Every scene of docs/scenes runs to its end, exactly.

#include "support/child_process.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

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
  const nlohmann::json& energy = summary["energy"];  // where effects give energy, all of it is accounted for
  EXPECT_LT(std::abs(energy.value("unexplained", energy["relative_drift"].get<double>())), 1e-12);
  const std::string stopped = summary["stopped"];
  EXPECT_TRUE(stopped == "time" || stopped == "collisions" || stopped == "grown") << stopped;
}

INSTANTIATE_TEST_SUITE_P(Scenes, ExampleScene, ::testing::ValuesIn(scenes()), [](const auto& name) { return name.param; });

}  // namespace
}  // namespace carom::test
