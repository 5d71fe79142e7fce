// Steps with a mistake: what swept and backtrack do to two and three disks, in closed form.

#include "studies/compare/mistakes.hpp"

#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace carom::test {
namespace {

/// Unit disks in a large periodic box.
Scene scene_of_disks(const std::vector<Eigen::Vector2d>& positions, const std::vector<Eigen::Vector2d>& velocities) {
  return scene_of(box_of(100.0, 100.0, Boundary::periodic),
                  {species_of(static_cast<std::int64_t>(positions.size()), 0.5, 1.0, ListedPositions{positions},
                              ListedVelocities{velocities})});
}

StepMistakes mistakes(const Scene& scene, const Method& method, std::uint64_t steps) {
  return mistakes_of(scene, make_simulation(scene).state(), method, 1e9, steps);
}

TEST(StepMistakes, ACollisionWithinAStepIsNone) {
  const Scene scene = scene_of_disks({{10.0, 10.0}, {14.0, 10.5}}, {{1.0, 0.0}, {-1.0, 0.0}});
  for (const char* method : {"backtrack", "swept"}) {
    const StepMistakes found = mistakes(scene, {method, 0.7}, 5);
    EXPECT_EQ(found.steps, 5U) << method;
    EXPECT_EQ(found.mistaken, 0U) << method;
  }
}

TEST(StepMistakes, AGrazeThatFitsIntoAStepIsOneOfBacktrackAndNoneOfSwept) {
  // Impact parameter 0.99: a chord of 2 sqrt(1 - 0.99^2) = 0.28 diameters, passed at speed 2 in 0.14. The centre of the chord is
  // reached at time 2, in the middle of the step from 1.5 to 2.5.
  const Scene scene = scene_of_disks({{10.0, 10.0}, {14.0, 10.99}}, {{1.0, 0.0}, {-1.0, 0.0}});
  EXPECT_EQ(mistakes(scene, {"backtrack", 0.5}, 3).mistaken, 0U);
  Scene shifted = scene;
  shifted.species[0].positions = ListedPositions{{{10.0, 10.0}, {14.5, 10.99}}};  // at time 2.25
  EXPECT_EQ(mistakes(shifted, {"backtrack", 0.5}, 6).mistaken, 1U);
  EXPECT_EQ(mistakes(shifted, {"backtrack", 0.5}, 4).mistaken, 0U) << "the graze is in the fifth step";
  EXPECT_EQ(mistakes(shifted, {"swept", 0.5}, 6).mistaken, 0U);
}

TEST(StepMistakes, AStepOfGuardedWithACollisionIsOne) {
  const Scene scene = scene_of_disks({{10.0, 10.0}, {14.25, 10.0}}, {{1.0, 0.0}, {-1.0, 0.0}});  // they meet at 1.625
  const StepMistakes found = mistakes(scene, {"guarded", 0.5}, 3);
  EXPECT_EQ(found.steps, 3U);
  EXPECT_EQ(found.mistaken, 0U);
  EXPECT_GE(mistakes(scene, {"guarded", 0.5}, 5).mistaken, 1U);
}

TEST(StepMistakes, EndWithTheTimeAndWhereTheyAreStopped) {
  const Scene scene = scene_of_disks({{10.0, 10.0}, {14.0, 10.5}}, {{1.0, 0.0}, {-1.0, 0.0}});
  const State start = make_simulation(scene).state();
  EXPECT_EQ(mistakes_of(scene, start, {"swept", 0.5}, 2.0, 100).steps, 4U);
  int asked = 0;
  EXPECT_EQ(mistakes_of(scene, start, {"swept", 0.5}, 2.0, 100, [&] { return ++asked < 3; }).steps, 2U);
  EXPECT_EQ(StepMistakes{}.fraction(), 0.0);
}

}  // namespace
}  // namespace carom::test
