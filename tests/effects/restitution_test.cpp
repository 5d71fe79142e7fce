// Inelastic collisions: [collision] restitution, and walls that take energy.

#include "observe/mechanics.hpp"
#include "support/effect_scenes.hpp"
#include "support/energy_drift.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace carom::test {
namespace {

using V = Eigen::Vector2d;

Scene inelastic(Scene scene, double restitution) {
  scene.effects.collision.restitution = restitution;
  return scene;
}

/// Two disks that will meet at t = 1.2 with the line of centres along (0.8, 0.6), the second one at rest.
Scene off_centre(double mass, double target_mass, double restitution) {
  return inelastic(scene_of_placed({{-4.0, -4.0}, {4.0, 4.0}, {Boundary::walls, Boundary::walls}},
                                   {{{-1.0, 0.0}, {1.0, 0.0}, 0.5, mass}, {{1.0, 0.6}, {0.0, 0.0}, 0.5, target_mass}}),
                   restitution);
}

// A few roundings of each term, relative to the speed 1 with which all this begins.
constexpr double rounding_at_speed_one = 32 * 0x1p-53;

TEST(Restitution, TwoDisksPartAsTheClosedFormSays) {
  for (const char* engine : engines_with_effects)
    for (const double e : {0.0, 0.3, 0.9, 1.0})
      for (const double ratio : {1.0, 3.0, 1e12, 1e-12}) {
        SCOPED_TRACE(testing::Message() << engine << ", e = " << e << ", masses 1 : " << ratio);
        const Ran ran = run(off_centre(1.0, ratio, e), engine, 1.5);
        ASSERT_EQ(ran.events.size(), 1U);
        const V n(-0.8, -0.6);  // from disk 1 to disk 0 at contact
        const double u = n.x();
        const V impulse = -(1 + e) * u / (1 + 1 / ratio) * n;
        EXPECT_NEAR(ran.events[0].time, 1.2, rounding_at_speed_one * 4);
        EXPECT_LE((ran.events[0].velocity - (V(1.0, 0.0) + impulse)).norm(), 4 * rounding_at_speed_one);
        EXPECT_LE((ran.events[0].partner_velocity + impulse / ratio).norm(),
                  4 * rounding_at_speed_one / std::min(1.0, ratio) * 1.0);
        // mu (1 - e^2) u^2 / 2 is gone.
        const double mu = ratio / (1 + ratio);
        EXPECT_NEAR(ran.simulation.totals().dissipated, mu * (1 - e * e) * u * u / 2, 4 * rounding_at_speed_one * mu);
      }
}

TEST(Restitution, ScalesTheWholeRelativeVelocityUnderReversal) {
  for (const char* engine : engines_with_effects) {
    Scene scene = off_centre(1.0, 1.0, 0.5);
    scene.effects.collision.rule = CollisionRule::reversal;
    const Ran ran = run(scene, engine, 1.5);
    ASSERT_EQ(ran.events.size(), 1U);
    EXPECT_LE((ran.events[0].velocity - V(0.25, 0.0)).norm(), rounding_at_speed_one);
    EXPECT_LE((ran.events[0].partner_velocity - V(0.75, 0.0)).norm(), rounding_at_speed_one);
    EXPECT_NEAR(ran.simulation.totals().dissipated, 0.5 * 0.5 * (1 - 0.25), rounding_at_speed_one);
  }
}

TEST(Restitution, ZeroLeavesAPairThatGoesOnTogether) {
  for (const char* engine : engines_with_effects) {
    // Head on: both go on at half the speed, touching, and never collide again. The wall is 1e3 away.
    const Scene scene = inelastic(scene_of_placed({{0.0, 0.0}, {1024.0, 4.0}, {Boundary::walls, Boundary::walls}},
                                                  {{{1.0, 2.0}, {1.0, 0.0}}, {{4.0, 2.0}, {0.0, 0.0}}}),
                                  0.0);
    const Ran ran = run(scene, engine, 1000.0);
    EXPECT_EQ(ran.stopped, StopReason::time);
    EXPECT_EQ(ran.events.size(), 1U);
    EXPECT_EQ(ran.simulation.state().velocities.col(0), V(0.5, 0.0));
    EXPECT_EQ(ran.simulation.state().velocities.col(1), V(0.5, 0.0));
    EXPECT_EQ(ran.simulation.totals().dissipated, 0.25);
  }
}

TEST(Restitution, EnergyLostIsEnergyCountedAndMomentumIsKept) {
  // 1e5 collisions of 64 disks at e = 0.999 leave e^-3 of the energy.
  for (const char* engine : engines_with_effects)
    for (const bool mixture : {false, true}) {
      SCOPED_TRACE(engine);
      const Scene scene =
          inelastic(mixture ? mixture_scene(64, 0.4, Boundary::periodic) : gas_scene(64, 0.4, Boundary::periodic), 0.999);
      Simulation simulation = make_simulation(scene, engine);
      const State start = simulation.state();
      EXPECT_EQ(simulation.run_until(1e9, {.collisions = 100'000}), StopReason::collisions);
      const State end = simulation.state();
      const double first = kinetic_energy(simulation.disks(), start), last = kinetic_energy(simulation.disks(), end);
      EXPECT_LT(last, 0.1 * first);
      EXPECT_NEAR((last + simulation.totals().dissipated) / first, 1.0, energy_drift(100'000, 64));
      // A random walk of 1e5 steps of 4 u of the fastest, with 5 deviations.
      EXPECT_LE((total_momentum(simulation.disks(), end) - total_momentum(simulation.disks(), start)).norm(),
                5.0 * 4.0 * 0x1p-53 * 316.0 * 4.0);
      EXPECT_TRUE(simulation.check_invariants().empty());
    }
}

// ------------------------------------------------------------------------------------------------ a wall

/// A ball of radius 0.5 falls from rest for 1 = sqrt(2 h / g), h = 2, onto a floor.
Scene bouncing_ball(double restitution) {
  Scene scene = scene_of_placed(box_of(4.0, 4.0, Boundary::walls), {{{2.0, 2.5}, {0.0, 0.0}}});
  scene.effects.gravity = Gravity{{0.0, -4.0}};
  scene.effects.walls[2].restitution = restitution;
  return scene;
}

TEST(Restitution, ABallBouncesAtTheTimesOfTheClosedFormUntilTimeStandsStill) {
  constexpr double e = 0.9;
  for (const char* engine : engines_with_effects) {
    SCOPED_TRACE(engine);
    const Ran ran = run(bouncing_ball(e), engine, 25.0);
    EXPECT_EQ(ran.stopped, StopReason::collapsed);
    // After k bounces it is to rise by 2 e^(2 k): by less than an ulp of the height of its centre, 1/2, from k = 178 on, and by
    // less than 2^-60 of its radius, which ends it, from k = 205 on.
    EXPECT_NEAR(ran.simulation.time(), 1.0 + 2.0 * e / (1 - e), 1e-6);
    std::size_t bounces = 1;
    while (bounces < ran.events.size() && ran.events[bounces].time > ran.events[bounces - 1].time) ++bounces;
    EXPECT_GT(bounces, 150U);
    EXPECT_LT(bounces, 207U);

    double time = 1.0, speed = 4.0, error = 0.0;
    for (std::size_t k = 0; k < bounces; ++k) {
      // Times are rounded like 19, and heights like the box: 4 u of height are 4 u / speed of time at every bounce.
      error += 8 * 0x1p-53 * (19.0 + 4.0 / speed);
      ASSERT_NEAR(ran.events[k].time, time, error) << "bounce " << k;
      speed *= e;
      time += 2.0 * speed / 4.0;
    }
  }
}

TEST(Restitution, ABallComesToRestAtOneBounceWhateverItsNumbers) {
  // The last digit of the clock could give it at every bounce what the floor takes. Then nothing but a standstill of millions of
  // events would end the run, and where that is noticed depends on samples. What is left of the time after the last bounce that
  // coordinates can tell, some 1e-16 of the box high, is 2 sqrt(2 h / g) / (1 - e).
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int k = 0; k < 10; ++k) {
    const double g = 1.0 + 4.0 * unit(random), e = 0.3 + 0.65 * unit(random);
    const double height = 1.0 + unit(random), radius = 0.2 + 0.4 * unit(random), floor = k % 2 == 0 ? 0.0 : unit(random);
    const double left = 2.0 * std::sqrt(2.0 * 16 * 0x1p-53 * 4.0 / g) / (1 - e);
    Scene scene = scene_of_placed({{0.0, floor}, {4.0, floor + 4.0}, {Boundary::walls, Boundary::walls}},
                                  {{{2.0, floor + radius + height}, {0.0, 0.0}, radius}});
    scene.effects.gravity = Gravity{{0.0, -g}};
    scene.effects.walls[2].restitution = e;
    for (const char* engine : engines_with_effects) {
      Simulation simulation = make_simulation(scene, engine);
      EXPECT_EQ(simulation.run_until(1e3), StopReason::collapsed) << engine << ", " << k;
      EXPECT_NEAR(simulation.time(), std::sqrt(2.0 * height / g) * (1 + e) / (1 - e), left) << engine << ", " << k;
      EXPECT_LT(simulation.totals().wall, 102'000U) << engine << ", " << k << ": 1e5 at one instant, and those before";
    }
  }
}

TEST(Restitution, ABallOnAFloorThatTakesAllCollapsesAtTheFirstBounce) {
  for (const char* engine : engines_with_effects) {
    const Ran ran = run(bouncing_ball(0.0), engine, 25.0);
    EXPECT_EQ(ran.stopped, StopReason::collapsed);
    EXPECT_NEAR(ran.simulation.time(), 1.0, 1e-12);
    EXPECT_NEAR(ran.simulation.state().positions(1, 0), 0.5, 1e-12);
  }
}

TEST(Restitution, WallsScaleTheVelocityAcrossThemAndTellWhatTheyTook) {
  for (const char* engine : engines_with_effects) {
    Scene scene = scene_of_placed(box_of(4.0, 4.0, Boundary::walls), {{{2.0, 2.0}, {-1.0, 0.25}, 0.5, 2.0}});
    scene.effects.walls[0].restitution = 0.5;
    const Ran ran = run(scene, engine, 2.0);
    EXPECT_EQ(ran.simulation.state().velocities.col(0), V(0.5, 0.25));
    EXPECT_EQ(ran.simulation.totals().wall_impulse[0], 3.0);
    EXPECT_EQ(ran.simulation.totals().wall_energy[0], 0.75);
  }
}

// --------------------------------------------------------------------------------------- inelastic collapse

/// A disk runs into two that rest and touch nothing, all on one line; the clock stops long before the walls.
Ran three_in_a_row(const char* engine, double e) {
  const Scene scene = inelastic(scene_of_placed({{-4.0, -1.0}, {1020.0, 1.0}, {Boundary::walls, Boundary::walls}},
                                                {{{-2.0, 0.0}, {1.0, 0.0}}, {{0.0, 0.0}, {0.0, 0.0}}, {{1.5, 0.0}, {0.0, 0.0}}}),
                                e);
  return run(scene, engine, 1000.0);
}

/// How many collisions they have: of the closing speeds p of the pair that collides and q of the other one, a collision makes
/// -e p and q + (1 + e) p / 2. -1: no end (McNamara & Young 1992).
int collisions_of_three(double e) {
  double p = 1.0, q = 0.0;
  for (int count = 1; count < 1000; ++count) {
    const double next = q + (1 + e) / 2 * p;
    q = -e * p;
    p = next;
    if (!(p > 0)) return count;
  }
  return -1;
}

TEST(Restitution, ThreeDisksOnALineCollideAsOftenAsTheMapSays) {
  EXPECT_EQ(collisions_of_three(0.07), -1) << "below 7 - 4 sqrt(3) = 0.0718";
  for (const char* engine : engines_with_effects) {
    for (const double e : {1.0, 0.5, 0.2, 0.1, 0.08, 0.075}) {
      const Ran ran = three_in_a_row(engine, e);
      EXPECT_EQ(ran.stopped, StopReason::time);
      EXPECT_EQ(static_cast<int>(ran.events.size()), collisions_of_three(e)) << engine << ", e = " << e;
    }
    // Below it they collide until nothing of their relative motion is left, or until the clock stands still; never for ever.
    const Ran ran = three_in_a_row(engine, 0.05);
    EXPECT_GT(ran.events.size(), 20U);
    const Eigen::Matrix2Xd v = ran.simulation.state().velocities;
    EXPECT_LT(v.row(0).maxCoeff() - v.row(0).minCoeff(), 1e-12) << to_string(ran.stopped);
  }
}

/// Head on, and again through the periodic edges: the relative velocity is multiplied by -e each time.
TEST(Restitution, TwoDisksCoolAwayToTheLastBitUntilNumbersCannotTell) {
  for (const char* engine : engines_with_effects) {
    SCOPED_TRACE(engine);
    Scene scene = inelastic(scene_of_placed({{0.0, 0.0}, {8.0, 8.0}, {Boundary::periodic, Boundary::periodic}},
                                            {{{2.0, 4.0}, {0.5, 0.0}, 0.5, 1.0}, {{6.0, 4.0}, {-0.5, 0.0}, 0.5, 1.0}}),
                            0.5);
    scene.run.time.reset();
    scene.run.collisions = 1'000'000;
    Simulation simulation = make_simulation(scene, engine);
    const RunResult result = run_schedule(simulation);
    EXPECT_EQ(result.stopped, StopReason::cooled);
    const auto collisions = static_cast<int>(simulation.totals().pair);
    const State state = simulation.state();
    EXPECT_EQ(std::abs(state.velocities(0, 0) - state.velocities(0, 1)), std::ldexp(1.0, -collisions));
    // The bound is crossed between two epochs, and one has some tens of collisions at most.
    EXPECT_LT(std::abs(state.velocities(0, 0)), 1e-150);
    EXPECT_GT(std::abs(state.velocities(0, 0)), 1e-170);
    EXPECT_TRUE(state.positions.allFinite());
    EXPECT_TRUE(std::isfinite(simulation.time()));
  }
}

TEST(Restitution, ADenseColumnCollapsesAndSaysSo) {
  for (const char* engine : engines_with_effects) {
    std::vector<Placed> column;
    for (int k = 0; k < 10; ++k) column.push_back({{1.0, 0.75 + 1.25 * k}, {0.0, 0.0}});
    Scene scene = inelastic(scene_of_placed(box_of(2.0, 20.0, Boundary::walls), column), 0.3);
    scene.effects.gravity = Gravity{{0.0, -1.0}};
    scene.effects.walls[2].restitution = 0.3;
    const Ran ran = run(scene, engine, 100.0);
    EXPECT_EQ(ran.stopped, StopReason::collapsed) << engine;
    EXPECT_LT(ran.simulation.time(), 20.0);
    EXPECT_TRUE(ran.simulation.state().positions.allFinite());
  }
}

TEST(Restitution, TouchingDisksOfWildlyDifferentMassDoNotOverlapOrGainEnergy) {
  // A cradle in which each disk is 1e12 times lighter than the one before.
  for (const char* engine : engines_with_effects)
    for (const double e : {0.0, 0.5, 1.0}) {
      const Scene scene = inelastic(
          scene_of_placed(
              {{-4.0, -1.0}, {60.0, 1.0}, {Boundary::walls, Boundary::walls}},
              {{{-2.0, 0.0}, {1.0, 0.0}, 0.5, 1.0}, {{0.0, 0.0}, {0.0, 0.0}, 0.5, 1e-12}, {{1.0, 0.0}, {0.0, 0.0}, 0.5, 1e-24}}),
          e);
      const Ran ran = run(scene, engine, 3.0);
      EXPECT_TRUE(ran.stopped == StopReason::time || ran.stopped == StopReason::collapsed);
      const State end = ran.simulation.state();
      EXPECT_GE(smallest_distance(scene.box, end.positions), 1.0 - 1e-12) << engine << ", e = " << e;
      EXPECT_NEAR(kinetic_energy(ran.simulation.disks(), end) + ran.simulation.totals().dissipated, 0.5, 1e-12);
    }
}

}  // namespace
}  // namespace carom::test
