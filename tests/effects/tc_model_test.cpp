// The TC model (Luding & McNamara 1998): a collision within t_c of another one of either partner takes no energy.

#include "observe/mechanics.hpp"
#include "support/effect_scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace carom::test {
namespace {

using V = Eigen::Vector2d;

Scene with_tc(Scene scene, double restitution, double elastic_below) {
  scene.effects.collision.restitution = restitution;
  scene.effects.collision.elastic_below = elastic_below;
  return scene;
}

/// Disk 0 hits disk 1 at t = 1 with speed 1; at e = 0.5 disk 1 goes on with 0.75 and hits disk 2 after another 1.
Scene relay(double elastic_below) {
  return with_tc(scene_of_placed(box_of(32.0, 4.0, Boundary::walls),
                                 {{{2.0, 2.0}, {1.0, 0.0}}, {{4.0, 2.0}, {0.0, 0.0}}, {{5.75, 2.0}, {0.0, 0.0}}}),
                 0.5, elastic_below);
}

TEST(TcModel, ACollisionIsElasticOnlyWithinTheTimeOfTheOneBefore) {
  for (const char* engine : engines_with_effects) {
    for (const auto& [elastic_below, last] : {std::pair{0.0, 0.5625}, std::pair{0.99, 0.5625}, std::pair{1.01, 0.75}}) {
      const Ran ran = run(relay(elastic_below), engine, 2.5);
      ASSERT_EQ(ran.events.size(), 2U);
      EXPECT_EQ(ran.events[0].time, 1.0);
      EXPECT_EQ(ran.events[1].time, 2.0);
      EXPECT_EQ(ran.events[0].velocity, V(0.25, 0.0));
      EXPECT_EQ(ran.simulation.state().velocities(0, 2), last) << engine << ", t_c = " << elastic_below;
    }
  }
}

TEST(TcModel, HoldsForWallsToo) {
  for (const char* engine : engines_with_effects) {
    // From the disk that it has left at rest to the wall in 0.5, and back with the speed that it had.
    Scene scene = with_tc(
        scene_of_placed(box_of(4.0, 4.0, Boundary::walls), {{{1.0, 2.0}, {1.0, 0.0}}, {{2.5, 2.0}, {0.0, 0.0}}}), 0.5, 2.0);
    scene.effects.walls[1].restitution = 0.5;
    const Ran ran = run(scene, engine, 2.0);
    ASSERT_EQ(ran.events.size(), 2U);
    EXPECT_EQ(ran.events[1].partner, wall_right);
    EXPECT_EQ(ran.events[1].velocity, V(-0.75, 0.0));
    EXPECT_EQ(ran.simulation.totals().wall_energy[1], 0.0);
  }
}

TEST(TcModel, AtZeroLeavesTheSameBits) {
  for (const char* engine : engines_with_effects) {
    Scene scene = gas_scene(36, 0.4, Boundary::periodic);
    scene.effects.collision.restitution = 0.9;
    const Ran plain = run(scene, engine, 20.0);
    const Ran neutral = run(with_tc(scene, 0.9, 0.0), engine, 20.0);
    EXPECT_TRUE(same_bits(plain.simulation.state(), neutral.simulation.state())) << engine;
  }
}

TEST(TcModel, WithoutLossItChangesNothing) {
  for (const char* engine : engines_with_effects) {
    const Scene scene = gas_scene(36, 0.4, Boundary::walls);
    const Ran plain = run(scene, engine, 20.0);
    const Ran elastic = run(with_tc(scene, 1.0, 0.5), engine, 20.0);
    EXPECT_TRUE(same_bits(plain.simulation.state(), elastic.simulation.state())) << engine;
  }
}

/// Ten disks fall on a floor and on each other, in a column of their own width.
Scene column(double elastic_below) {
  std::vector<Placed> disks;
  for (int k = 0; k < 10; ++k) disks.push_back({{1.0, 0.75 + 1.25 * k}, {0.0, 0.0}});
  Scene scene = with_tc(scene_of_placed(box_of(2.0, 20.0, Boundary::walls), disks), 0.3, elastic_below);
  scene.effects.gravity = Gravity{{0.0, -1.0}};
  scene.effects.walls[2].restitution = 0.3;
  return scene;
}

TEST(TcModel, ADenseColumnNeitherStallsNorKeepsMuchMotion) {
  for (const char* engine : engines_with_effects) {
    EXPECT_EQ(run(column(0.0), engine, 30.0).stopped, StopReason::collapsed) << engine;
    const Ran ran = run(column(0.01), engine, 30.0);
    EXPECT_EQ(ran.stopped, StopReason::time) << engine;
    EXPECT_EQ(ran.simulation.time(), 30.0);
    // What hovers: a disk that bounces without loss every t_c has a speed of g t_c / 2. Ten above each other add up to some ten
    // times that, and energy is far below that of a fall by one radius.
    EXPECT_LT(kinetic_energy(ran.simulation.disks(), ran.simulation.state()), 10 * 0.5 * std::pow(10 * 0.005, 2)) << engine;
    EXPECT_TRUE(ran.simulation.check_invariants().empty());
  }
}

TEST(TcModel, EnergyLostIsEnergyCounted) {
  for (const char* engine : engines_with_effects) {
    Simulation simulation = make_simulation(with_tc(gas_scene(64, 0.4, Boundary::periodic), 0.99, 0.02), engine);
    const double first = kinetic_energy(simulation.disks(), simulation.state());
    simulation.run_until(1e9, {.collisions = 100'000});
    const double last = kinetic_energy(simulation.disks(), simulation.state());
    EXPECT_LT(last, 0.9 * first);
    EXPECT_NEAR((last + simulation.totals().dissipated) / first, 1.0, 1e-12) << "bound as for restitution";
  }
}

}  // namespace
}  // namespace carom::test
