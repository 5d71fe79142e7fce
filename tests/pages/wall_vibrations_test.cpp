// How far walls vibrate, against where the engine has them.

#include "pages/wall_vibrations.hpp"

#include "observe/geometry.hpp"

#include <carom/simulation.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace carom::test {
namespace {

class WallVibrationOf : public ::testing::TestWithParam<std::string> {};

TEST_P(WallVibrationOf, IsAsFarAsTheEngineMovesTheWall) {
  const Scene scene = parse_scene(
      "[box]\nx = [0.0, 10.0]\ny = [0.0, 5.0]\nboundary = \"walls\"\n[[disks]]\nradius = 0.2\nmass = 1.0\n"
      "positions = [[3.0, 2.5]]\nvelocities = [[1.0, 0.0]]\n[collision]\nrule = \"specular\"\n[run]\ntime = 3.0\n[walls]\n" +
      GetParam());
  const std::vector<WallVibration> vibrations = wall_vibrations(scene);
  ASSERT_EQ(vibrations.size(), 1U);
  Simulation simulation = make_simulation(scene);
  const auto position = [&] {
    const Box box = box_of(scene.box, simulation.state());
    const std::size_t axis = vibrations[0].side / 2;
    return vibrations[0].side % 2 == 0 ? box.lower[static_cast<Eigen::Index>(axis)] : box.upper[static_cast<Eigen::Index>(axis)];
  };
  double low = position(), high = low;
  for (int k = 1; k < 3000; ++k) {
    simulation.run_until(0.001 * k);
    low = std::min(low, position());
    high = std::max(high, position());
  }
  // From one instant to the next a sawtooth moves by 0.002 amplitudes; a sine is slower where it turns.
  EXPECT_NEAR(vibrations[0].low, low, 0.001);
  EXPECT_NEAR(vibrations[0].high, high, 0.001);
  EXPECT_LE(vibrations[0].low, low + 1e-12);
  EXPECT_GE(vibrations[0].high, high - 1e-12);
}

INSTANTIATE_TEST_SUITE_P(
    All, WallVibrationOf,
    ::testing::Values("bottom = { vibration = { form = \"sine\", amplitude = 0.5, frequency = 1.0 } }\n",
                      "top = { vibration = { form = \"sine\", amplitude = 0.5, frequency = 1.0, phase = 0.3 } }\n",
                      "left = { vibration = { form = \"sawtooth\", amplitude = 0.3, frequency = 1.0 } }\n",
                      "right = { vibration = { form = \"sawtooth\", amplitude = 0.3, frequency = 1.0, phase = 0.4 } }\n"));

TEST(WallVibrations, OfWallsAtRestAreNone) {
  EXPECT_TRUE(wall_vibrations(parse_scene("disks = []\n[box]\nx = [0.0, 1.0]\ny = [0.0, 1.0]\nboundary = \"walls\"\n"
                                          "[collision]\nrule = \"specular\"\n[run]\ntime = 1.0\n"))
                  .empty());
}

}  // namespace
}  // namespace carom::test
