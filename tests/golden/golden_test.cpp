// The final state of every example scene, bit for bit: for either compiler, any optimisation, with or without sampling.
// hashes.txt holds what this code gave when it was last known to be right; a commit that changes a hash says why.

#include "support/scene_files.hpp"

#include <carom/simulation.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <map>

namespace carom::test {
namespace {

/// FNV-1a over the bytes of the numbers.
class Hash {
 public:
  template <class T>
  void add(const T& number) {
    unsigned char bytes[sizeof(T)];
    std::memcpy(bytes, &number, sizeof(T));
    for (const unsigned char byte : bytes) value_ = (value_ ^ byte) * 0x100000001b3ull;
  }
  [[nodiscard]] std::string text() const { return fmt::format("{:016x}", value_); }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ull;
};

std::string hash_of_run(Scene scene, bool sampling) {
  if (!sampling) scene.run.sample_every.reset();
  Simulation simulation = make_simulation(scene);
  run_schedule(simulation);
  const State state = simulation.state();
  Hash hash;
  for (Eigen::Index i = 0; i < state.positions.cols(); ++i) {
    for (int a = 0; a < 2; ++a) {
      hash.add(state.positions(a, i));
      hash.add(state.velocities(a, i));
      hash.add(state.images(a, i));
    }
  }
  hash.add(simulation.totals().pair);
  hash.add(simulation.totals().wall);
  return hash.text();
}

std::map<std::string, std::string> recorded() {
  std::map<std::string, std::string> hashes;
  std::ifstream file(CAROM_SOURCE_DIR "/tests/golden/hashes.txt");
  for (std::string name, hash; file >> name >> hash;) hashes[name] = hash;
  return hashes;
}

class GoldenScene : public testing::TestWithParam<std::string> {};

TEST_P(GoldenScene, EndsInTheRecordedBits) {
  const Scene scene = load_scene(example_path(GetParam()));
  const auto hashes = recorded();
  const std::string hash = hash_of_run(scene, true);
  ASSERT_TRUE(hashes.contains(GetParam())) << "add to tests/golden/hashes.txt: " << GetParam() << " " << hash;
  EXPECT_EQ(hash, hashes.at(GetParam()));
}

TEST_P(GoldenScene, EndsInTheSameBitsWithoutSampling) {
  const Scene scene = load_scene(example_path(GetParam()));
  EXPECT_EQ(hash_of_run(scene, false), hash_of_run(scene, true));
}

INSTANTIATE_TEST_SUITE_P(All, GoldenScene, testing::ValuesIn(example_scenes()), [](const auto& scene) { return scene.param; });

}  // namespace
}  // namespace carom::test
