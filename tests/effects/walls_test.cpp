// Sides of the box that heat, move or give way: [walls].

#include "effects/maxwell.hpp"
#include "observe/mechanics.hpp"
#include "support/effect_scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace carom::test {
namespace {

using V = Eigen::Vector2d;

Scene one_disk(const V& r, const V& v, double mass = 1.0) {
  return scene_of_placed(box_of(8.0, 4.0, Boundary::walls), {{r, v, 0.5, mass}});
}

// ------------------------------------------------------------------------------------------ thermal walls

TEST(ThermalWalls, SendDisksOffWithTheVelocitiesOfTheFluxThroughAPlane) {
  // v_n = sqrt(2 kT / m) sqrt(-ln U): mean sqrt(pi kT / 2 m), mean square 2 kT / m. Half a Gaussian would have sqrt(2 kT / pi m)
  // and kT / m: 1.25 and 2 against 0.80 and 1.
  constexpr int draws = 100'000;
  constexpr double kT = 3.0, m = 2.0;
  double mean = 0.0, square = 0.0, along = 0.0, along_square = 0.0;
  for (int k = 0; k < draws; ++k) {
    RandomStream random(11, Stream::thermal_walls, static_cast<std::uint64_t>(k));
    const DiffuseVelocity v = diffuse_velocity(random, kT, m);
    ASSERT_GT(v.inward, 0.0);
    mean += v.inward / draws;
    square += v.inward * v.inward / draws;
    along += v.along / draws;
    along_square += v.along * v.along / draws;
  }
  // 5 standard errors: v_n has the variance (2 - pi / 2) kT / m, v_n^2 the standard deviation 2 kT / m, v_t^2 sqrt(2) kT / m.
  const double error = 5.0 / std::sqrt(draws);
  EXPECT_NEAR(mean, std::sqrt(std::numbers::pi * kT / 2 / m), error * std::sqrt((2 - std::numbers::pi / 2) * kT / m));
  EXPECT_NEAR(square, 2 * kT / m, error * 2 * kT / m);
  EXPECT_NEAR(along, 0.0, error * std::sqrt(kT / m));
  EXPECT_NEAR(along_square, kT / m, error * std::sqrt(2.0) * kT / m);
}

TEST(ThermalWalls, TakeWhatTheDisksLose) {
  // To rounding over 1e5 events, in heat and in momentum: what one wall gives must be with the disks or with the other wall.
  for (const char* engine : engines_with_effects) {
    Scene scene = gas_scene(64, 0.3, Boundary::walls);
    scene.effects.walls[0].temperature = 2.0;
    scene.effects.walls[1].temperature = 0.5;
    Simulation simulation = make_simulation(scene, engine);
    const double energy = energy_of(simulation);
    const V momentum = total_momentum(simulation.disks(), simulation.state());
    simulation.run_until(1e9, {.collisions = 80'000});
    const Totals& totals = simulation.totals();
    EXPECT_GT(totals.pair + totals.wall, 90'000U);
    // Sums of some 1e4 heats of size kT, each rounded at 1e4 kT.
    EXPECT_NEAR(energy + given_by_walls(totals), energy_of(simulation), 1e-9) << engine;
    EXPECT_NEAR(momentum[0] - totals.wall_impulse[1] + totals.wall_impulse[0],
                total_momentum(simulation.disks(), simulation.state())[0], 1e-8);
    EXPECT_LT(totals.wall_energy[0], 0.0) << "the hot wall gives";
    EXPECT_GT(totals.wall_energy[1], 0.0) << "the cold wall takes";
  }
}

TEST(ThermalWalls, GiveEveryEngineTheSameVelocities) {
  // One disk forgets at each wall whatever rounding has done to its velocity, and the n-th draw is always the same.
  Scene scene = one_disk({3.0, 2.0}, {1.0, 0.3});
  scene.effects.walls[0].temperature = 2.0;
  scene.effects.walls[1].temperature = 1.0;
  const Ran textbook = run(scene, "textbook", 200.0);
  EXPECT_GT(textbook.events.size(), 20U);
  for (const char* engine : {"general", "textbook-quad"}) {
    const Ran other = run(scene, engine, 200.0);
    ASSERT_EQ(other.events.size(), textbook.events.size()) << engine;
    EXPECT_EQ(other.simulation.state().velocities.cwiseAbs(), textbook.simulation.state().velocities.cwiseAbs()) << engine;
    EXPECT_LT((other.simulation.state().positions - textbook.simulation.state().positions).norm(), 1e-11) << engine;
  }
}

TEST(ThermalWalls, DependOnTheSeed) {
  Scene scene = one_disk({3.0, 2.0}, {1.0, 0.3});
  scene.effects.walls[0].temperature = 2.0;
  Scene other = scene;
  other.run.seed = 2;
  const Ran one = run(scene, "general", 50.0);
  EXPECT_TRUE(same_bits(one.simulation.state(), run(scene, "general", 50.0).simulation.state()));
  EXPECT_FALSE(same_bits(one.simulation.state(), run(other, "general", 50.0).simulation.state()));
}

// ------------------------------------------------------------------------------------------- moving walls

TEST(MovingWalls, SendADiskBackAsTheClosedFormSays) {
  // v' = (1 + e) u - e v, where the disk's edge meets the wall: at t = 2 with room 4.5 - 0.5 = 4, u = -1 and v = 1.
  for (const char* engine : engines_with_effects)
    for (const double e : {1.0, 0.5, 0.0}) {
      Scene scene = one_disk({3.5, 2.0}, {1.0, 0.0}, 2.0);
      scene.effects.walls[1].velocity = -1.0;
      scene.effects.walls[1].restitution = e;
      const Ran ran = run(scene, engine, 2.5);
      ASSERT_GE(ran.events.size(), 1U);
      EXPECT_EQ(ran.events[0].time, 2.0) << engine;
      EXPECT_EQ(ran.events[0].velocity, V(-(1 + e) - e, 0.0)) << engine << ", e = " << e;
      EXPECT_EQ(ran.simulation.state().walls.at(1).position, 5.5);
    }
}

TEST(MovingWalls, ADiskThatIsSlowerThanTheWallIsPushedAndOneAsFastIsLeftAlone) {
  for (const char* engine : engines_with_effects) {
    Scene scene = one_disk({3.5, 2.0}, {0.0, 0.0});
    scene.effects.walls[0].velocity = 0.5;
    EXPECT_EQ(run(scene, engine, 7.0).events.at(0).velocity, V(1.0, 0.0));  // at t = 6
    Scene fleeing = one_disk({0.5, 2.0}, {0.5, 0.0});                       // touching, side by side with the wall
    fleeing.effects.walls[0].velocity = 0.5;
    EXPECT_EQ(run(fleeing, engine, 4.0).events.size(), 0U);
    Scene receding = one_disk({3.5, 2.0}, {-0.5, 0.0});
    receding.effects.walls[0].velocity = -1.0;
    EXPECT_EQ(run(receding, engine, 100.0).events.size(), 0U);
  }
}

TEST(MovingWalls, TheAdiabaticInvariantOfABouncingDiskIsExact) {
  // Between a wall at rest and one that comes in at u: from room L and speed w after a hit the disk is back after 2 L / (w + u),
  // when the room is L (w - u) / (w + u) and its speed becomes w + 2 u. So (w - u) L is the same after every hit.
  for (const char* engine : engines_with_effects) {
    constexpr double u = 0.001;
    Scene scene = one_disk({0.5, 2.0}, {1.0, 0.0});
    scene.effects.walls[1].velocity = -u;
    const Ran ran = run(scene, engine, 3500.0);
    double invariant = 0.0;
    int hits = 0;
    for (const Event& event : ran.events) {
      if (event.partner != wall_right) continue;
      const double room = 7.0 - u * event.time;
      const double now = (-event.velocity.x() - u) * room;
      if (hits++ == 0) invariant = now;
      ASSERT_NEAR(now / invariant, 1.0, 1e-11) << engine << ", hit " << hits;
    }
    EXPECT_GT(hits, 300);
    EXPECT_NEAR(ran.simulation.state().velocities.col(0).norm(), 2.0, 0.01) << "half the room, twice the speed";
  }
}

TEST(MovingWalls, DoTheWorkThatTheyTell) {
  for (const char* engine : engines_with_effects) {
    Scene scene = gas_scene(64, 0.1, Boundary::walls);
    scene.effects.walls[1].velocity = -0.01;
    scene.effects.walls[2].velocity = 0.005;
    Simulation simulation = make_simulation(scene, engine);
    const double energy = energy_of(simulation);
    simulation.run_until(1000.0);
    EXPECT_GT(given_by_walls(simulation.totals()), 0.3 * energy);
    EXPECT_NEAR((energy + given_by_walls(simulation.totals())) / energy_of(simulation), 1.0, 1e-12) << engine;
    EXPECT_TRUE(simulation.check_invariants().empty());
    EXPECT_NEAR(simulation.state().walls.at(1).position, scene.box.upper[0] - 10.0, 1e-12);
  }
}

// ------------------------------------------------------------------------------------------------ pistons

TEST(Pistons, CollideWithADiskAsTwoBodiesDo) {
  // Without load: a disk of mass 1 and speed 1 hits a piston of mass M at rest, for any M; a light one is thrown ahead.
  for (const char* engine : engines_with_effects)
    for (const double M : {1e-12, 0.25, 1.0, 3.0, 1e12})
      for (const double e : {1.0, 0.5, 0.0}) {
        Scene scene = one_disk({3.5, 2.0}, {1.0, 0.25});
        scene.effects.walls[1] = {e == 1.0 ? std::nullopt : std::optional(e), {}, {}, M, 0.0};
        const Ran ran = run(scene, engine, 4.5);
        // Without restitution they stay together, and rounding may have them touch again.
        ASSERT_GE(ran.events.size(), 1U) << engine << ", M = " << M;
        if (e > 0) {
          EXPECT_EQ(ran.events.size(), 1U) << engine << ", M = " << M;
        }
        EXPECT_EQ(ran.events[0].time, 4.0);
        const double change = 1 + e;
        // Some roundings of numbers up to 2.
        EXPECT_NEAR(ran.simulation.state().velocities(0, 0), 1.0 - change * M / (1 + M), 1e-15);
        EXPECT_EQ(ran.simulation.state().velocities(1, 0), 0.25);
        EXPECT_NEAR(ran.simulation.state().walls.at(1).velocity, change / (1 + M), 1e-15);
        EXPECT_NEAR(ran.simulation.state().walls.at(1).position, 8.0 + 0.5 * change / (1 + M), 1e-14);
      }
}

TEST(Pistons, FallUnderTheirLoadUntilTheyMeetADisk) {
  // Load 1/2 per length on 4 lengths and mass 4: acceleration -1/2. A disk at rest with 4 of room to it is met at t = 4, at
  // speed 2.
  for (const char* engine : engines_with_effects) {
    Scene scene = one_disk({3.5, 2.0}, {0.0, 0.0}, 4.0);
    scene.effects.walls[1] = {.mass = 4.0, .load = 0.5};
    const Ran ran = run(scene, engine, 4.0);
    ASSERT_EQ(ran.events.size(), 1U);
    EXPECT_EQ(ran.events[0].time, 4.0);
    EXPECT_EQ(ran.events[0].velocity, V(-2.0, 0.0));
    EXPECT_EQ(ran.simulation.state().walls.at(1).velocity, 0.0);
    EXPECT_EQ(ran.simulation.state().walls.at(1).position, 4.0);
  }
}

TEST(Pistons, KeepEnergyTogetherWithTheDisksAndTheLoad) {
  // Heavy, light, and lighter than a disk by 1e3; 2e4 events each. The load's energy is of the size of the disks'.
  for (const char* engine : engines_with_effects)
    for (const double M : {100.0, 5.0, 1e-3}) {
      SCOPED_TRACE(testing::Message() << engine << ", M = " << M);
      Scene scene = gas_scene(25, 0.2, Boundary::walls);
      scene.effects.walls[3] = {.mass = M, .load = 0.3};
      Simulation simulation = make_simulation(scene, engine);
      const double energy = energy_of(simulation);
      const V momentum = total_momentum(simulation.disks(), simulation.state());
      simulation.run_until(1e9, {.collisions = 15'000});
      EXPECT_GT(simulation.totals().pair + simulation.totals().wall, 18'000U);
      EXPECT_NEAR(energy_of(simulation), energy, 1e-10 * 25.0);
      // The load's impulse on the piston less what disks gave it is what it has: the mean pressure on it is the load.
      const double load = 0.3 * scene.box.lengths()[0];
      EXPECT_NEAR(simulation.totals().wall_impulse[3] - load * simulation.time(), M * simulation.state().walls.at(3).velocity,
                  1e-10 * load * simulation.time());
      const double gained = total_momentum(simulation.disks(), simulation.state())[1] - momentum[1];
      EXPECT_NEAR(simulation.totals().wall_impulse[2] - simulation.totals().wall_impulse[3], gained,
                  1e-10 * load * simulation.time());
      EXPECT_TRUE(simulation.check_invariants().empty());
    }
}

TEST(Pistons, FindTheirWayBack) {
  for (const char* engine : engines_with_effects) {
    Scene scene = gas_scene(36, 0.3, Boundary::walls);
    scene.effects.walls[1] = {.mass = 5.0, .load = 0.5};
    const auto [start, there, back] = there_and_back(scene, engine, 2.0);
    EXPECT_GT(there.totals().pair, 20U);
    // Denser than the gas of laws_test.cpp, and with a piston that all disks feel: one more decade.
    EXPECT_LE((back.state().positions - start.positions).cwiseAbs().maxCoeff(), 1e-10) << engine;
    EXPECT_NEAR(back.state().walls.at(1).position, scene.box.upper[0], 1e-10) << engine;
  }
}

TEST(Pistons, AnEmptyBoxLetsThePistonFallToTheOtherSideWithoutEnd) {
  // No disk holds it: it goes where its load sends it, past the other wall; nothing else happens.
  for (const char* engine : engines_with_effects) {
    Scene scene = one_disk({0.5, 2.0}, {0.0, 0.0}, 1e12);
    scene.effects.walls[1] = {.mass = 1.0, .load = 0.25};
    const Ran ran = run(scene, engine, 5.0);
    EXPECT_EQ(ran.stopped, StopReason::time);
    EXPECT_GE(ran.simulation.state().walls.at(1).position, 1.0 - 1e-12) << "a disk as heavy as an anvil holds it off";
  }
}

}  // namespace
}  // namespace carom::test
