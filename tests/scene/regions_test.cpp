// Random positions within a part of the box: no disk reaches across the edge, the part is filled evenly, and disks of other
// species are drawn as without it.

#include "scene/scene_texts.hpp"
#include "support/refusal.hpp"

#include <carom/simulation.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace carom::test {
namespace {

Eigen::Matrix2Xd positions_of(const std::string& positions, int count, const std::string& boundary = "\"walls\"") {
  const std::string text =
      changed({{"\"random\"", positions}, {"count = 10", "count = " + std::to_string(count)}, {"\"walls\"", boundary}});
  return make_simulation(parse_scene(text)).state().positions;
}

TEST(Regions, ARectangleHoldsItsDisks) {
  for (const char* boundary : {"\"walls\"", "\"periodic\""}) {
    const Eigen::Matrix2Xd found = positions_of("{ random = { x = [0, 4], y = [5, 8] } }", 24, boundary);
    EXPECT_GE(found.row(0).minCoeff(), 0.25) << boundary;
    EXPECT_LE(found.row(0).maxCoeff(), 3.75);
    EXPECT_GE(found.row(1).minCoeff(), 5.25);
    EXPECT_LE(found.row(1).maxCoeff(), 7.75);
    EXPECT_LT(found.row(0).minCoeff(), 0.8) << "it is filled";
    EXPECT_GT(found.row(1).maxCoeff(), 7.2);
  }
}

TEST(Regions, ACircleHoldsItsDisksAndIsFilledEvenly) {
  double inner = 0.0, all = 0.0;
  for (int seed = 1; seed <= 200; ++seed) {
    const std::string text = changed({{"\"random\"", "{ random = { centre = [5, 4], radius = 3.25 } }"},
                                      {"radius = 0.25", "radius = 1e-3"},
                                      {"time = 5.0", "time = 5.0\nseed = " + std::to_string(seed)}});
    const Eigen::Matrix2Xd found = make_simulation(parse_scene(text)).state().positions;
    const Eigen::RowVectorXd distance = (found.colwise() - Eigen::Vector2d(5.0, 4.0)).colwise().norm();
    EXPECT_LE(distance.maxCoeff(), 3.249);
    inner += static_cast<double>((distance.array() < 3.249 / 2.0).count());
    all += static_cast<double>(found.cols());
  }
  EXPECT_NEAR(inner / all, 0.25, 4.0 * std::sqrt(0.25 * 0.75 / all)) << "a quarter of the area";
}

TEST(Regions, ACircleIsFilledByOneDisk) {
  const Eigen::Matrix2Xd found =
      make_simulation(parse_scene(changed(
                          {{"\"random\"", "{ random = { centre = [5, 4], radius = 0.2501 } }"}, {"count = 10", "count = 1"}})))
          .state()
          .positions;
  EXPECT_LE((found.col(0) - Eigen::Vector2d(5.0, 4.0)).norm(), 1.001e-4);
}

TEST(CircularBox, IsFilledByOneDisk) {
  const std::string text =
      "[box]\ncircle = { centre = [0, 0], radius = 1.0 }\n[[disks]]\ncount = COUNT\nradius = 0.99\nmass = 1.0\npositions = "
      "\"random\"\nvelocities = { speed = 1.0 }\n[collision]\nrule = \"specular\"\n[run]\ntime = 1.0\n";
  const auto with = [&](const std::string& count) { return std::string(text).replace(text.find("COUNT"), 5, count); };
  const Eigen::Matrix2Xd found = make_simulation(parse_scene(with("1"))).state().positions;
  EXPECT_LE(found.col(0).norm(), 0.01 * (1.0 + 1e-12));
  EXPECT_THROW((void)parse_scene(with("2")), SceneError);
}

TEST(Regions, OtherSpeciesAreDrawnAsWithout) {
  const std::string second =
      "[[disks]]\nname = \"more\"\ncount = 3\nradius = 0.1\nmass = 1.0\npositions = { random = { x = [9, 10], y = [0, 8] } "
      "}\nvelocities = "
      "\"rest\"\n";
  const std::string text(small_scene);
  const Eigen::Matrix2Xd alone = make_simulation(parse_scene(text)).state().positions;
  const Eigen::Matrix2Xd both = make_simulation(parse_scene(text + second)).state().positions;
  EXPECT_EQ(both.leftCols(10), alone);
  EXPECT_GE(both.rightCols(3).row(0).minCoeff(), 9.1);
}

TEST(Regions, ThatAreFullAreToldSo) {
  EXPECT_NE(refusal<SceneError>([] {
              (void)positions_of("{ random = { x = [0, 2], y = [0, 2] } }", 16);
            }).find("disks.0.positions.random after"),
            std::string::npos);
}

}  // namespace
}  // namespace carom::test
