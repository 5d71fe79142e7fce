// Random scenes with any effects: every engine that covers one stays sound and accounts for its energy, and all see the same
// events.

#include "support/engine_agreement.hpp"
#include "support/decoded_scene.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

namespace carom::test {
namespace {

/// Enough bytes for any scene that they may stand for.
rc::Gen<std::vector<std::uint8_t>> any_bytes() {
  return rc::gen::container<std::vector<std::uint8_t>>(160, rc::gen::arbitrary<std::uint8_t>());
}

RC_GTEST_PROP(PropertyAgreement, EnginesStaySoundAndAgreeOnScenesWithAnyEffects, ()) {
  const std::string text = decoded_scene(*any_bytes());
  Scene scene;
  try {
    scene = parse_scene(text);
    RC_LOG() << text;
    RC_ASSERT(disagreement(scene, 400) == "");
  } catch (const SceneError&) {
    RC_DISCARD("the scene check refuses it");
  }
}

TEST(PropertyAgreement, ComparesEventsInMostScenes) {
  std::mt19937_64 random(1);
  int scenes = 0, compared = 0;
  while (scenes < 30) {
    std::vector<std::uint8_t> bytes(160);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    try {
      const Scene scene = parse_scene(decoded_scene(bytes));
      const WatchedRun one = run_watched(scene, "textbook", 400);
      compared += determined(scene, one, run_watched(scene, "textbook-long-double", 400), 400) > 0 ? 1 : 0;
      ++scenes;
    } catch (const SceneError&) {  // the scene check refuses it
    }
  }
  EXPECT_GT(compared, scenes / 2);
}

TEST(PropertyAgreement, EnginesStaySoundAndAgreeOnWhatFuzzingHasFound) {
  for (const auto& entry : std::filesystem::directory_iterator(CAROM_SOURCE_DIR "/tests/fuzz/findings/physics")) {
    std::ifstream file(entry.path(), std::ios::binary);
    const std::vector<std::uint8_t> bytes(std::istreambuf_iterator<char>(file), {});
    SCOPED_TRACE(entry.path().filename().string());
    try {
      EXPECT_EQ(disagreement(parse_scene(decoded_scene(bytes))), "");
    } catch (const SceneError& error) {
      ADD_FAILURE() << "the scene check refuses it, so that it tests nothing: " << error.what();
    }
  }
}

}  // namespace
}  // namespace carom::test
