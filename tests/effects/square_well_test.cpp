// Attraction and repulsion at a distance: [square_well].

#include "observe/mechanics.hpp"
#include "support/effect_scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace carom::test {
namespace {

using V = Eigen::Vector2d;

Scene with_well(Scene scene, double depth, double width = 1.5) {
  scene.effects.square_well = SquareWell{width, depth};
  return scene;
}

/// Two disks on a line, centres 3 apart, that approach at relative speed 1; wells of width 2 begin at 2.
Scene head_on(double depth, double mass = 1.0, double other_mass = 1.0) {
  return with_well(scene_of_placed({{-32.0, -4.0}, {32.0, 4.0}, {Boundary::walls, Boundary::walls}},
                                   {{{-1.5, 0.0}, {1.0, 0.0}, 0.5, mass}, {{1.5, 0.0}, {0.0, 0.0}, 0.5, other_mass}}),
                   depth, 2.0);
}

// A few roundings of numbers of the size of 4.
constexpr double rounding_of_four = 64 * 0x1p-53;

TEST(SquareWell, APairIsFasterInsideAndLeavesAsItCame) {
  for (const char* engine : engines_with_effects)
    for (const auto& [m, M] : {std::pair{1.0, 1.0}, std::pair{1.0, 3.0}, std::pair{1.0, 1e12}}) {
      const double mu = m * M / (m + M), depth = 1.5 * mu;  // u' = sqrt(1 + 2 * 1.5) = 2
      const Scene scene = head_on(depth, m, M);
      Simulation inside = make_simulation(scene, engine);
      inside.run_until(1.25);  // in at t = 1, at the core at t = 1.5, out at t = 2
      EXPECT_EQ(inside.totals().well, 1U);
      EXPECT_EQ(inside.state().bonds, 1U);
      EXPECT_NEAR(inside.state().velocities(0, 0) - inside.state().velocities(0, 1), 2.0, rounding_of_four)
          << engine << ", M = " << M;
      EXPECT_NEAR(energy_of(inside), 0.5 * m, rounding_of_four);
      const Ran ran = run(scene, engine, 2.5);
      EXPECT_EQ(ran.simulation.totals().pair, 1U);
      EXPECT_EQ(ran.simulation.totals().well, 2U);
      EXPECT_EQ(ran.simulation.state().bonds, 0U);
      EXPECT_NEAR(ran.simulation.state().velocities(0, 0) - ran.simulation.state().velocities(0, 1), -1.0, rounding_of_four);
      EXPECT_LE((total_momentum(ran.simulation.disks(), ran.simulation.state()) - V(m, 0.0)).norm(),
                rounding_of_four * (m + M) / M);
    }
}

TEST(SquareWell, IsTheSameInAnyUnitOfMass) {
  for (const char* engine : engines_with_effects)
    for (const double unit : {1e-200, 1e120}) {
      Simulation inside = make_simulation(head_on(0.75 * unit, unit, unit), engine);  // mu = unit / 2: u' = 2
      inside.run_until(1.25);
      EXPECT_EQ(inside.state().bonds, 1U) << engine;
      EXPECT_NEAR(inside.state().velocities(0, 0) - inside.state().velocities(0, 1), 2.0, rounding_of_four) << unit;
    }
}

TEST(SquareWell, AShoulderLetsThroughDisksWithTheEnergyAndReflectsTheRest) {
  // mu u^2 / 2 = 1/4.
  for (const char* engine : engines_with_effects) {
    const Ran through = run(head_on(-0.1875), engine, 1.5);
    EXPECT_NEAR(through.simulation.state().velocities(0, 0) - through.simulation.state().velocities(0, 1), 0.5, rounding_of_four)
        << engine;
    EXPECT_EQ(through.simulation.state().bonds, 1U);
    for (const double depth : {-0.25, -0.3, -1e6}) {  // at exactly the height of the shoulder nothing would be left of u
      const Ran back = run(head_on(depth), engine, 1.5);
      EXPECT_EQ(back.simulation.state().velocities.col(0), V(0.0, 0.0)) << engine << ", depth " << depth;
      EXPECT_EQ(back.simulation.state().velocities.col(1), V(1.0, 0.0));
      EXPECT_EQ(back.simulation.state().bonds, 0U);
      EXPECT_EQ(back.simulation.totals().well, 1U);
      EXPECT_EQ(back.simulation.totals().pair, 0U);
    }
  }
}

TEST(SquareWell, APairWithoutTheEnergyToLeaveStaysBoundForEver) {
  // At distance 1.5 inside a well of width 2, with mu u^2 / 2 = 1/64 of depth 1/2: core and edge in turns, 0.5 to 0.5 at u = 1/4.
  for (const char* engine : engines_with_effects) {
    const Scene scene = with_well(scene_of_placed({{-32.0, -4.0}, {32.0, 4.0}, {Boundary::walls, Boundary::walls}},
                                                  {{{-0.75, 0.0}, {-0.125, 0.0}}, {{0.75, 0.0}, {0.125, 0.0}}}),
                                  0.5, 2.0);
    const Ran ran = run(scene, engine, 4001.0);
    EXPECT_EQ(ran.simulation.state().bonds, 1U) << engine;
    // The edge at t = 2, 10, 18, ..., the core at 6, 14, ...
    EXPECT_EQ(ran.simulation.totals().well, 500U);
    EXPECT_EQ(ran.simulation.totals().pair, 500U);
    EXPECT_NEAR(energy_of(ran.simulation), 1.0 / 64 - 0.5, rounding_of_four);
  }
}

TEST(SquareWell, AGrazingPairIsBentByTheAngleOfRefraction) {
  // Impact parameter 1.2 of a well that begins at 2, with n . v = -0.8 and t . v = 0.6: inside u' = sqrt(0.64 + 4 depth), and it
  // misses the core if 1.2 / |v'| > 1.
  for (const char* engine : engines_with_effects) {
    const double depth = 0.05;
    const Scene scene = with_well(scene_of_placed({{-32.0, -16.0}, {32.0, 16.0}, {Boundary::walls, Boundary::walls}},
                                                  {{{-3.6, 0.0}, {1.0, 0.0}}, {{0.0, 1.2}, {0.0, 0.0}}}),
                                  depth, 2.0);
    Simulation simulation = make_simulation(scene, engine);
    simulation.run_until(2.5);  // at the edge at t = 2, with r = (-1.6, -1.2)
    ASSERT_EQ(simulation.state().bonds, 1U);
    const V v = simulation.state().velocities.col(0) - simulation.state().velocities.col(1);
    const V n(-0.8, -0.6), t(0.6, -0.8);
    EXPECT_NEAR(n.dot(v), -std::sqrt(0.64 + 4 * depth), rounding_of_four) << engine;
    EXPECT_NEAR(t.dot(v), 0.6, rounding_of_four) << engine;
    simulation.run_until(20.0);
    EXPECT_EQ(simulation.totals().pair, 0U) << "it passes the core by";
    EXPECT_EQ(simulation.totals().well, 2U);
    EXPECT_NEAR((simulation.state().velocities.col(0) - simulation.state().velocities.col(1)).norm(), 1.0, rounding_of_four);
  }
}

TEST(SquareWell, KeepsEnergyAndMomentum) {
  for (const char* engine : engines_with_effects)
    for (const double depth : {1.0, -0.5})
      for (const bool mixture : {false, true}) {
        SCOPED_TRACE(testing::Message() << engine << ", depth " << depth);
        const Scene scene =
            with_well(mixture ? mixture_scene(64, 0.3, Boundary::periodic) : gas_scene(64, 0.3, Boundary::periodic), depth);
        Simulation simulation = make_simulation(scene, engine);
        const double energy = energy_of(simulation);
        simulation.run_until(1e9, {.collisions = 10'000});
        EXPECT_GT(simulation.totals().pair + simulation.totals().well, 20'000U);
        EXPECT_NEAR(energy_of(simulation), energy, 1e-11 * 64)
            << "2e4 events with 1e-16 of a pair's energy each; 1e6 in tests/physics";
        EXPECT_LE(total_momentum(simulation.disks(), simulation.state()).norm(), 1e-12 * 64);
        EXPECT_TRUE(simulation.check_invariants().empty());
      }
}

TEST(SquareWell, FindsItsWayBack) {
  for (const char* engine : engines_with_effects)
    for (const double depth : {0.5, -0.3}) {
      const Scene scene = with_well(gas_scene(64, 0.3, Boundary::periodic), depth);
      const auto [start, there, back] = there_and_back(scene, engine, 1.0);
      EXPECT_GT(there.totals().well, 30U);
      // Edges bend paths less than cores do: the bound of the hard gas after T = 1, and a decade.
      EXPECT_LE((back.state().velocities + start.velocities).cwiseAbs().maxCoeff(), 1e-10) << engine << ", depth " << depth;
      EXPECT_EQ(back.state().bonds, start.bonds);
    }
}

TEST(SquareWell, OfNoDepthOrOfNoWidthToSpeakOfIsNone) {
  for (const char* engine : engines_with_effects) {
    const Scene scene = gas_scene(36, 0.4, Boundary::periodic);
    const Ran plain = run(scene, engine, 20.0);
    const Ran neutral = run(with_well(scene, 0.0), engine, 20.0);
    EXPECT_TRUE(same_bits(plain.simulation.state(), neutral.simulation.state())) << engine;
    EXPECT_EQ(neutral.simulation.totals().well, 0U);
    // An ulp or two wide: contact is at the edge and at the core at once, and energy is kept all the same.
    Simulation thin = make_simulation(with_well(scene, 0.5, 1 + 0x1p-30), engine);
    const double energy = energy_of(thin);
    thin.run_until(5.0);
    EXPECT_NEAR(energy_of(thin), energy, 1e-11 * 36) << engine;
  }
}

TEST(SquareWell, PairsThatBeginExactlyAtTheEdgeAreOutsideUntilTheyApproach) {
  for (const char* engine : engines_with_effects) {
    const Box box{{-32.0, -4.0}, {32.0, 4.0}, {Boundary::walls, Boundary::walls}};
    const Ran rest =
        run(with_well(scene_of_placed(box, {{{-1.0, 0.0}, {0.0, 0.0}}, {{1.0, 0.0}, {0.0, 0.0}}}), 1.0, 2.0), engine, 5.0);
    EXPECT_EQ(rest.events.size(), 0U);
    const Ran apart =
        run(with_well(scene_of_placed(box, {{{-1.0, 0.0}, {-1.0, 0.0}}, {{1.0, 0.0}, {0.0, 0.0}}}), 1.0, 2.0), engine, 5.0);
    EXPECT_EQ(apart.events.size(), 0U);
    const Ran near =
        run(with_well(scene_of_placed(box, {{{-1.0, 0.0}, {1.0, 0.0}}, {{1.0, 0.0}, {0.0, 0.0}}}), 0.75, 2.0), engine, 0.25);
    EXPECT_EQ(near.simulation.state().bonds, 1U);
    EXPECT_NEAR(near.simulation.state().velocities(0, 0) - near.simulation.state().velocities(0, 1), 2.0, rounding_of_four);
    EXPECT_EQ(near.events.at(0).time, 0.0);
  }
}

}  // namespace
}  // namespace carom::test
