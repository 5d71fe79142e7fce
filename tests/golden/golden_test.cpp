// The final state of every example scene, bit for bit: for either compiler, any optimisation, with or without sampling.
// hashes.txt holds what this code gave when it was last known to be right; a commit that changes a hash says why.

#include "core/instructions.hpp"
#include "golden/run_hash.hpp"
#include "support/instructions.hpp"
#include "support/memory_ranks.hpp"
#include "support/scene_files.hpp"

#include <carom/simulation.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace carom::test {
namespace {

/// By scene and engine.
std::map<std::pair<std::string, std::string>, std::string> recorded() {
  std::map<std::pair<std::string, std::string>, std::string> hashes;
  std::ifstream file(CAROM_SOURCE_DIR "/tests/golden/hashes.txt");
  for (std::string scene, engine, hash; file >> scene >> engine >> hash;) hashes[{scene, engine}] = hash;
  return hashes;
}

std::string engine_of(const Scene& scene) { return scene.effects.neutral() ? "fast" : "general"; }

/// Each scene on the engine that runs it, and on that which proves it.
class GoldenScene : public testing::TestWithParam<std::tuple<std::string, std::string>> {
 protected:
  const std::string& name() const { return std::get<0>(GetParam()); }
  [[nodiscard]] std::string engine() const { return std::get<1>(GetParam()) == "textbook" ? "textbook" : engine_of(scene_); }
  void expect_recorded(const std::string& hash) const {
    const auto hashes = recorded();
    ASSERT_TRUE(hashes.contains({name(), engine()}))
        << "add to tests/golden/hashes.txt: " << name() << " " << engine() << " " << hash;
    EXPECT_EQ(hash, hashes.at({name(), engine()}));
  }

  const Scene scene_ = load_scene(example_path(name()));
};

TEST_P(GoldenScene, EndsInTheRecordedBits) { expect_recorded(hash_of_run(scene_, engine())); }

TEST_P(GoldenScene, EndsInTheRecordedBitsWithoutSampling) { expect_recorded(hash_of_run(scene_, engine(), false)); }

INSTANTIATE_TEST_SUITE_P(All, GoldenScene,
                         testing::Combine(testing::ValuesIn(example_scenes()), testing::Values("its_own", "textbook")),
                         [](const auto& param) { return std::get<0>(param.param) + "_" + std::get<1>(param.param); });

/// Each scene on the engine that runs it, with the kernels of other machines. The textbook engine has none.
class GoldenInstructions : public testing::TestWithParam<std::string> {};

TEST_P(GoldenInstructions, OfEverySetEndInTheRecordedBits) {
  const Scene scene = load_scene(example_path(GetParam()));
  const std::string engine = engine_of(scene);
  if (chosen_instructions() == Instructions::portable) GTEST_SKIP() << "there is no other set on this machine";
  for (const Instructions set : {Instructions::portable, Instructions::avx2}) {
    if (set >= chosen_instructions()) continue;  // the best, with which GoldenScene runs, or not on this machine
    const WithInstructions asked(name_of(set));
    EXPECT_EQ(hash_of_run(scene, engine), recorded().at({GetParam(), engine})) << name_of(set);
  }
}

INSTANTIATE_TEST_SUITE_P(All, GoldenInstructions, testing::ValuesIn(example_scenes()),
                         [](const auto& param) { return param.param; });

/// Each scene on the engine that runs it, shared out.
class GoldenDomains : public testing::TestWithParam<std::string> {};

TEST_P(GoldenDomains, EndInTheRecordedBits) {
  const Scene scene = load_scene(example_path(GetParam()));
  const Simulation simulation = make_simulation(scene);
  if (const std::string reason = simulation.why_not_threads(); !reason.empty()) GTEST_SKIP() << "one core: " << reason;
  for (const std::size_t domains : {2U, 3U, 8U})
    EXPECT_EQ(hash_of_run(scene, simulation.engine(), true, {.domains = domains}),
              recorded().at({GetParam(), simulation.engine()}))
        << domains << " domains";
}

INSTANTIATE_TEST_SUITE_P(All, GoldenDomains, testing::ValuesIn(example_scenes()), [](const auto& param) { return param.param; });

/// On several ranks. They are threads here, which is slow: tests/parallel has more kinds of scenes.
TEST(GoldenRanks, EndInTheRecordedBits) {
  for (const char* name : {"box", "clusters"}) {
    const Scene scene = load_scene(example_path(name));
    const std::string engine = make_simulation(scene).engine();
    for (const int ranks : {1, 2, 3, 4}) {
      ServingRanks serving(ranks);
      EXPECT_EQ(hash_of_run(scene, engine, true, {}, &serving.first()), recorded().at({name, engine})) << name << ", " << ranks;
    }
  }
}

}  // namespace
}  // namespace carom::test
