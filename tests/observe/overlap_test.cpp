// Overlap of disks that have grown, in boxes that have moved or are sheared.

#include "observe/geometry.hpp"

#include "support/systems.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace carom::test {
namespace {

TEST(Overlap, CountsRadiiAsTheyHaveGrown) {
  System s = system_of(square_box(10.0, Boundary::walls), {{{4, 5}, {0, 0}, 0.5, 1.0}, {{6, 5}, {0, 0}, 0.5, 1.0}});
  EXPECT_EQ(deepest_overlap(s.box, Effects{}, s.disks, s.state).relative, 0.0);
  s.state.scale = 2.5;
  EXPECT_DOUBLE_EQ(deepest_overlap(s.box, Effects{}, s.disks, s.state).relative, 0.2);
}

TEST(Overlap, FindsDisksBeyondTheSceneBoxWhereWallsHaveMovedOut) {
  System s = system_of(square_box(1.0, Boundary::walls), {{{0.5, 0.5}, {0, 0}, 0.1, 1.0}, {{0.5, 0.6}, {0, 0}, 0.1, 1.0}});
  s.state.walls = {{0.0, 0.0}, {100.0, 0.0}, {0.0, 0.0}, {100.0, 0.0}};
  s.state.positions << 80.0, 80.0, 90.0, 90.1;
  EXPECT_NEAR(deepest_overlap(s.box, Effects{}, s.disks, s.state).relative, 0.5, 1e-12);  // ulp(90) / 0.2
}

class ShearedOverlap : public ::testing::Test {
 protected:
  ShearedOverlap() { effects_.shear = Shear{.rate = 0.5}; }

  /// The deepest overlap by definition: over all images, those n boxes higher displaced by n times the shear.
  [[nodiscard]] static double by_definition(const System& s) {
    double deepest = 0.0;
    for (std::size_t i = 0; i < s.disks.count(); ++i)
      for (std::size_t j = 0; j < s.disks.count(); ++j)
        for (int nx = -2; nx <= 2; ++nx)
          for (int ny = -1; ny <= 1; ++ny) {
            if (i == j && nx == 0 && ny == 0) continue;
            const Eigen::Vector2d image(nx * s.box.lengths().x() + ny * s.state.shear_displacement, ny * s.box.lengths().y());
            const double distance = (s.state.positions.col(static_cast<Eigen::Index>(i)) -
                                     s.state.positions.col(static_cast<Eigen::Index>(j)) - image)
                                        .norm();
            const double sigma = s.disks.radius[i] + s.disks.radius[j];
            deepest = std::max(deepest, (sigma - distance) / sigma);
          }
    return deepest;
  }

  Effects effects_;
};

TEST_F(ShearedOverlap, ImagesAboveAreDisplaced) {
  System s = system_of(square_box(10.0, Boundary::periodic), {{{2.0, 0.25}, {0, 0}, 0.5, 1.0}, {{2.0, 9.75}, {0, 0}, 0.5, 1.0}});
  EXPECT_NEAR(deepest_overlap(s.box, effects_, s.disks, s.state).relative, 0.5, 1e-15);
  s.state.shear_displacement = 3.0;
  EXPECT_EQ(deepest_overlap(s.box, effects_, s.disks, s.state).relative, 0.0);
  s.state.positions(0, 1) = 5.0;  // under the image of disk 0, which is at (5, 10.25)
  EXPECT_NEAR(deepest_overlap(s.box, effects_, s.disks, s.state).relative, 0.5, 1e-15);
}

TEST_F(ShearedOverlap, AgreesWithAllPairsOfAllImages) {
  // A fixed sequence of positions without pattern: multiples of the golden ratio and of sqrt(2).
  for (const double displacement : {0.0, 0.7, 4.99, 9.3}) {
    System s = system_of(square_box(10.0, Boundary::periodic), {});
    const Eigen::Index n = 40;
    s.state.positions.resize(2, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      s.state.positions.col(i) << 10.0 * std::fmod(0.6180339887 * static_cast<double>(i), 1.0),
          10.0 * std::fmod(1.4142135624 * static_cast<double>(i) + 0.05, 1.0);
      s.disks.radius.push_back(i % 2 == 0 ? 0.9 : 0.4);
      s.disks.mass.push_back(1.0);
      s.disks.species.push_back(0);
    }
    s.state.shear_displacement = displacement;
    EXPECT_NEAR(deepest_overlap(s.box, effects_, s.disks, s.state).relative, by_definition(s), 1e-13) << displacement;
  }
}

}  // namespace
}  // namespace carom::test
