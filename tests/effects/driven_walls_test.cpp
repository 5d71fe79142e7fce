// Walls that slide and walls that vibrate, and a force along a periodic axis, where walls or a bath hold the disks back.

#include "observe/mechanics.hpp"
#include "support/effect_scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace carom::test {
namespace {

using V = Eigen::Vector2d;

/// A box that is periodic along x, between walls at the bottom and the top.
Box long_channel(double length, double width) {
  Box box = box_of(length, width, Boundary::walls);
  box.boundary[0] = Boundary::periodic;
  return box;
}

double given_to_disks(const Totals& totals) {
  double sum = 0.0;
  for (const double taken : totals.wall_energy) sum -= taken;
  return sum;
}

Scene channel_gas(double top_velocity) {
  Scene scene = gas_scene(64, 0.3, Boundary::walls);
  scene.box.boundary[0] = Boundary::periodic;
  scene.effects.walls[2].temperature = 1.0;
  scene.effects.walls[3].temperature = 1.5;
  scene.effects.walls[3].tangential_velocity = top_velocity;
  return scene;
}

TEST(SlidingWalls, GiveADiskTheirVelocityBesideWhatIsDrawn) {
  for (const char* engine : engines_with_effects) {
    Scene scene = scene_of_placed(long_channel(8.0, 4.0), {{{3.0, 2.0}, {0.3, 1.0}}});
    scene.effects.walls[3].temperature = 2.0;
    const Ran still = run(scene, engine, 2.0);
    scene.effects.walls[3].tangential_velocity = 0.75;
    const Ran slides = run(scene, engine, 2.0);
    ASSERT_FALSE(still.events.empty());
    const Event &one = still.events.front(), &other = slides.events.front();
    EXPECT_EQ(one.time, 1.5) << engine;
    EXPECT_EQ(other.time, 1.5);
    EXPECT_EQ(other.velocity.y(), one.velocity.y());
    EXPECT_EQ(other.velocity.x(), one.velocity.x() + 0.75);
    EXPECT_EQ(slides.simulation.totals().wall_shear[3], 0.3 - other.velocity.x());
    EXPECT_EQ(slides.simulation.totals().wall_shear[2], 0.0) << "a smooth wall takes no momentum along itself";
  }
}

TEST(SlidingWalls, AtVelocityZeroHaveTheSameBits) {
  for (const char* engine : engines_with_effects) {
    Scene scene = channel_gas(0.0), without = scene;
    without.effects.walls[3].tangential_velocity.reset();
    const Ran a = run(scene, engine, 5.0), b = run(without, engine, 5.0);
    EXPECT_GT(a.events.size(), 100U);
    EXPECT_EQ(a.simulation.state().positions, b.simulation.state().positions) << engine;
    EXPECT_EQ(a.simulation.state().velocities, b.simulation.state().velocities) << engine;
  }
}

TEST(SlidingWalls, TakeAndGiveWhatTheDisksHave) {
  for (const char* engine : engines_with_effects) {
    const Scene scene = channel_gas(2.0);
    Simulation simulation = make_simulation(scene, engine);
    const double energy = energy_of(simulation);
    const V momentum = total_momentum(simulation.disks(), simulation.state());
    simulation.run_until(1e9, {.collisions = 80'000});
    const Totals& totals = simulation.totals();
    EXPECT_NEAR(energy + given_to_disks(totals), energy_of(simulation), 1e-9 * energy) << engine;
    EXPECT_NEAR(momentum[0] - totals.wall_shear[2] - totals.wall_shear[3],
                total_momentum(simulation.disks(), simulation.state())[0], 1e-8);
    // The wall that slides does work, and both walls take it as heat: all but what is left in the gas, which is bounded.
    const double work = -2.0 * totals.wall_shear[3], heat = work - given_to_disks(totals);
    EXPECT_GT(work, 1000.0);
    EXPECT_NEAR(heat / work, 1.0, 0.1);
    EXPECT_GT(totals.wall_shear[2], 0.0) << "the wall at rest is dragged along";
  }
}

TEST(SlidingWalls, AreTheSameInEveryFrame) {
  // All walls and disks faster by 1 along the channel: the same run, seen from elsewhere.
  for (const char* engine : engines_with_effects) {
    Scene scene = scene_of_placed(long_channel(8.0, 4.0), {{{3.0, 2.0}, {0.25, 1.0}}, {{5.0, 2.5}, {-0.5, 0.25}}});
    for (const std::size_t wall : {2U, 3U}) {
      scene.effects.walls[wall].temperature = 1.0;
      scene.effects.walls[wall].tangential_velocity = wall == 3 ? 0.5 : 0.0;
    }
    Scene moved = scene;
    for (const std::size_t wall : {2U, 3U}) *moved.effects.walls[wall].tangential_velocity += 1.0;
    for (V& v : std::get<ListedVelocities>(moved.species[0].velocities).values) v.x() += 1.0;
    const Ran a = run(scene, engine, 25.0), b = run(moved, engine, 25.0);
    ASSERT_EQ(a.events.size(), b.events.size()) << engine;
    ASSERT_GT(a.events.size(), 5U);
    for (std::size_t k = 0; k < a.events.size(); ++k) {
      EXPECT_NEAR(a.events[k].time, b.events[k].time, 1e-11);
      EXPECT_NEAR(a.events[k].velocity.x() + 1.0, b.events[k].velocity.x(), 1e-11);
    }
  }
}

// ------------------------------------------------------------------------------------------ vibrating walls

TEST(VibratingWalls, AddTwiceTheirSpeedAtEveryHit) {
  for (const char* engine : engines_with_effects) {
    Scene scene = scene_of_placed(box_of(8.0, 4.0, Boundary::walls), {{{3.0, 2.0}, {0.0, -1.0}}});
    scene.effects.walls[2].vibration = 0.25;
    Simulation simulation = make_simulation(scene, engine);
    double speed = 1.0, time = 1.5;
    simulation.run_until(1.5);
    for (int k = 0; k < 20; ++k) {
      // It hits the bottom now; then it goes to the top and back, three diameters each way.
      speed += 0.5;
      simulation.run_until(time + 1.0 / speed);
      EXPECT_NEAR(simulation.state().velocities(1, 0), speed, 1e-13) << engine << ", hit " << k;
      time += 6.0 / speed;
      simulation.run_until(time * (1.0 - 1e-9));
      simulation.run_until(time);
    }
    const Totals& totals = simulation.totals();
    // The work is the impulse times the speed. Outward is down here, and the bottom is pushed outward.
    EXPECT_NEAR(-totals.wall_energy[2], 0.25 * totals.wall_impulse[2], 1e-12 * totals.wall_impulse[2]);
    EXPECT_NEAR(energy_of(simulation), 0.5 + given_to_disks(totals), 1e-12);
    EXPECT_TRUE(simulation.state().walls.empty()) << "it stays where it is";
  }
}

TEST(VibratingWalls, WithRestitutionADiskComesToASpeed) {
  // v' = (1 + e) u + e v between two of them: v = (1 + e) u / (1 - e) in the end.
  for (const char* engine : engines_with_effects) {
    Scene scene = scene_of_placed(box_of(8.0, 4.0, Boundary::walls), {{{3.0, 2.0}, {0.0, -1.0}}});
    for (const std::size_t wall : {2U, 3U}) scene.effects.walls[wall] = {.restitution = 0.5, .vibration = 0.25};
    Simulation simulation = make_simulation(scene, engine);
    simulation.run_until(400.0);
    EXPECT_NEAR(std::abs(simulation.state().velocities(1, 0)), 0.75, 1e-12) << engine;
  }
}

TEST(VibratingWalls, AtSpeedZeroHaveTheSameBits) {
  for (const char* engine : engines_with_effects) {
    Scene scene = gas_scene(64, 0.3, Boundary::walls);
    scene.effects.gravity = Gravity{{0.0, -0.1}};
    const Ran a = run(scene, engine, 5.0);
    scene.effects.walls[2].vibration = 0.0;
    const Ran b = run(scene, engine, 5.0);
    EXPECT_EQ(a.simulation.state().positions, b.simulation.state().positions) << engine;
    EXPECT_EQ(a.simulation.state().velocities, b.simulation.state().velocities) << engine;
  }
}

TEST(VibratingWalls, KeepAPileAloftWithoutStopping) {
  // Disks that start at rest on the floor, one on the other, under their weight.
  for (const char* engine : engines_with_effects) {
    Scene scene =
        scene_of_placed(box_of(8.0, 20.0, Boundary::walls), {{{3.0, 0.5}, {0, 0}}, {{3.0, 1.5}, {0, 0}}, {{6.0, 0.5}, {0, 0}}});
    scene.effects.gravity = Gravity{{0.0, -1.0}};
    scene.effects.collision.restitution = 0.8;
    scene.effects.walls[2] = {.restitution = 0.9, .vibration = 1.0};
    Simulation simulation = make_simulation(scene, engine);
    EXPECT_EQ(simulation.run_until(200.0), StopReason::time) << engine;
    EXPECT_GT(simulation.counts().wall, 50U);
    EXPECT_GT(simulation.state().positions.row(1).maxCoeff(), 1.0);
  }
}

// ------------------------------------------------------------------------------------------ a force along the channel

TEST(ForceAlongAPeriodicAxis, LetsADiskFallRoundAndRound) {
  for (const char* engine : engines_with_effects) {
    for (const double g : {0.5, -2.0}) {
      Scene scene = scene_of_placed(long_channel(8.0, 4.0), {{{3.0, 2.0}, {-1.0, 0.0}}});
      scene.effects.gravity = Gravity{{g, 0.0}};
      scene.effects.walls[3].temperature = 1.0;
      Simulation simulation = make_simulation(scene, engine);
      const double energy = energy_of(simulation);
      for (const double t : {0.125, 1.0, 2.0, 7.5, 33.0, 100.0}) {
        simulation.run_until(t);
        const State state = simulation.state();
        const double way = state.positions(0, 0) + 8.0 * static_cast<double>(state.images(0, 0)),
                     expected = 3.0 - t + g * t * t / 2;
        EXPECT_NEAR(way, expected, 1e-11 * (1.0 + std::abs(expected))) << engine << ", g = " << g << ", time " << t;
        EXPECT_GE(state.positions(0, 0), 0.0);
        EXPECT_LT(state.positions(0, 0), 8.0);
        EXPECT_NEAR(state.velocities(0, 0), -1.0 + g * t, 1e-12 * (1.0 + std::abs(g * t)));
        EXPECT_NEAR(energy_of(simulation), energy, 1e-10 * (1.0 + g * g * t * t));
      }
    }
  }
}

TEST(ForceAlongAPeriodicAxis, IsNotNoticedByDisksThatFallTogether) {
  // Both axes periodic, with a bath that does nothing yet: in the frame that falls with them the disks move as without a force.
  for (const char* engine : engines_with_effects) {
    Scene scene = gas_scene(36, 0.4, Boundary::periodic);
    Simulation still = make_simulation(scene, engine);
    scene.effects.thermostat = Thermostat{1.0, 1e-12};
    scene.effects.gravity = Gravity{{3.0, -1.5}};
    Simulation falls = make_simulation(scene, engine);
    for (const double t : {0.25, 1.0, 2.5}) {
      still.run_until(t);
      falls.run_until(t);
      const State a = still.state(), b = falls.state();
      EXPECT_EQ(still.counts().pair, falls.counts().pair) << engine << ", time " << t;
      const V lengths = scene.box.lengths(), g = scene.effects.gravity->acceleration;
      for (Eigen::Index i = 0; i < a.positions.cols(); ++i)
        for (int axis = 0; axis < 2; ++axis) {
          const double way = b.positions(axis, i) - a.positions(axis, i) +
                             static_cast<double>(b.images(axis, i) - a.images(axis, i)) * lengths[axis];
          EXPECT_NEAR(way, g[axis] * t * t / 2, 1e-9);
          EXPECT_NEAR(b.velocities(axis, i) - a.velocities(axis, i), g[axis] * t, 1e-9);
        }
    }
    EXPECT_GT(still.counts().pair, 100U);
    EXPECT_TRUE(falls.check_invariants().empty());
  }
}

TEST(ForceAlongAPeriodicAxis, IsHeldByTheWalls) {
  // The momentum that the force gives, N m g t, and the energy are with the disks or with the walls.
  for (const char* engine : engines_with_effects) {
    Scene scene = channel_gas(0.0);
    scene.effects.gravity = Gravity{{0.05, 0.0}};
    Simulation simulation = make_simulation(scene, engine);
    const double energy = energy_of(simulation);
    const V momentum = total_momentum(simulation.disks(), simulation.state());
    simulation.run_until(1e9, {.collisions = 50'000});
    const Totals& totals = simulation.totals();
    const double given = 64 * 0.05 * simulation.time();
    EXPECT_NEAR(momentum[0] + given - totals.wall_shear[2] - totals.wall_shear[3],
                total_momentum(simulation.disks(), simulation.state())[0], 1e-9 * given)
        << engine;
    EXPECT_NEAR((totals.wall_shear[2] + totals.wall_shear[3]) / given, 1.0, 0.1) << "all but what the flow has, which is bounded";
    EXPECT_NEAR(energy + given_to_disks(totals), energy_of(simulation), 1e-9 * (energy + std::abs(energy_of(simulation))));
    EXPECT_TRUE(simulation.check_invariants().empty());
  }
}

TEST(ForceAlongAPeriodicAxis, ARunThatIsSavedGoesOnToTheSameBits) {
  for (const char* engine : engines_with_effects) {
    Scene scene = channel_gas(0.5);
    scene.effects.gravity = Gravity{{0.2, -0.1}};
    const auto [whole, restored] = gone_on_and_restored(scene, engine, 20.0, 40.0);
    EXPECT_EQ(whole.state().positions, restored.state().positions) << engine;
    EXPECT_EQ(whole.state().images, restored.state().images);
    EXPECT_EQ(whole.totals().wall_shear, restored.totals().wall_shear);
  }
}

}  // namespace
}  // namespace carom::test
