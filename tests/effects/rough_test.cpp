// Rough disks with spin: [collision] roughness.

#include "observe/energy.hpp"
#include "observe/mechanics.hpp"
#include "support/effect_scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace carom::test {
namespace {

using V = Eigen::Vector2d;

Scene rough(Scene scene, double roughness, double restitution = 1.0) {
  scene.effects.collision.roughness = roughness;
  scene.effects.collision.restitution = restitution;
  return scene;
}

State spinning(State state, const Eigen::VectorXd& spins) {
  state.spins = spins;
  return state;
}

double all_energy(const Disks& disks, const State& state) { return kinetic_energy(disks, state) + spin_energy(disks, state); }

/// Two disks of any size that meet at t = 1 with their line of centres along (0.8, 0.6).
struct Pair {
  double radius = 0.5, mass = 1.0, other_radius = 0.5, other_mass = 1.0, spin = 0.0, other_spin = 0.0;
};
constexpr double approach_speed = 1.0;
Scene scene_of_pair(const Pair& p) {
  const V contact = -(p.radius + p.other_radius) * V(0.8, 0.6);
  return scene_of_placed({{-16.0, -16.0}, {16.0, 16.0}, {Boundary::walls, Boundary::walls}},
                         {{contact - V(approach_speed, 0.0), {approach_speed, 0.0}, p.radius, p.mass},
                          {{0.0, 0.0}, {0.0, 0.0}, p.other_radius, p.other_mass}});
}
Simulation met(const Scene& scene, const Pair& p, const char* engine) {
  Simulation simulation =
      make_simulation(scene, spinning(make_simulation(scene).state(), Eigen::Vector2d(p.spin, p.other_spin)), engine);
  simulation.run_until(1.5);
  EXPECT_EQ(simulation.totals().pair, 1U);
  return simulation;
}

const Pair tried_pairs[] = {{},
                            {0.5, 1.0, 0.5, 1.0, 2.0, -3.0},
                            {0.5, 1.0, 1.5, 7.0, -1.0, 0.5},
                            {0.25, 1e-6, 2.0, 1.0, 4.0, 1.0},
                            {1.0, 1.0, 0.5, 1e-12, 0.0, 1.0}};

// A few roundings of each term, in units of the largest speed on the rim.
constexpr double rounding_on_the_rim = 64 * 0x1p-53;

TEST(RoughDisks, PartAsTheClosedFormSays) {
  for (const char* engine : engines_with_effects)
    for (const Pair& p : tried_pairs)
      for (const double e : {1.0, 0.5})
        for (const double beta : {-1.0, -0.5, 0.0, 0.7, 1.0}) {
          SCOPED_TRACE(testing::Message() << engine << ", e = " << e << ", beta = " << beta << ", mass " << p.other_mass);
          const Simulation simulation = met(rough(scene_of_pair(p), beta, e), p, engine);
          const State end = simulation.state();
          const V n(-0.8, -0.6), t(0.6, -0.8);  // t: n turned by a right angle
          const double g_n = n.x() * approach_speed;
          const double g_t = t.x() * approach_speed - (p.radius * p.spin + p.other_radius * p.other_spin);
          const double mu = p.mass * p.other_mass / (p.mass + p.other_mass);
          const V impulse = -mu * ((1 + e) * g_n * n + (1 + beta) / 3 * g_t * t);
          const double turn = (1 + beta) / 3 * mu * g_t;
          const double rim = approach_speed + std::abs(p.radius * p.spin) + std::abs(p.other_radius * p.other_spin);
          EXPECT_LE((end.velocities.col(0) - V(approach_speed, 0.0) - impulse / p.mass).norm(),
                    rounding_on_the_rim * rim * mu / p.mass + rounding_on_the_rim);
          EXPECT_LE((end.velocities.col(1) + impulse / p.other_mass).norm(),
                    rounding_on_the_rim * rim * std::max(1.0, mu / p.other_mass));
          EXPECT_NEAR(end.spins[0] * p.radius, p.spin * p.radius + 2 * turn / p.mass, rounding_on_the_rim * rim);
          EXPECT_NEAR(end.spins[1] * p.other_radius, p.other_spin * p.other_radius + 2 * turn / p.other_mass,
                      rounding_on_the_rim * rim);
          // The loss of one collision, exactly: mu (1 - e^2) g_n^2 / 2 + mu (1 - beta^2) g_t^2 / 6.
          EXPECT_NEAR(simulation.totals().dissipated, mu / 2 * (1 - e * e) * g_n * g_n + mu / 6 * (1 - beta * beta) * g_t * g_t,
                      rounding_on_the_rim * mu * rim * rim);
        }
}

TEST(RoughDisks, AreTheSameInAnyUnitOfMass) {
  for (const char* engine : engines_with_effects)
    for (const double unit : {1e-200, 1e120}) {
      const Pair one{0.5, 1.0, 1.5, 7.0, -1.0, 0.5}, same{0.5, unit, 1.5, 7.0 * unit, -1.0, 0.5};
      const State usual = met(rough(scene_of_pair(one), 0.5), one, engine).state();
      const State scaled = met(rough(scene_of_pair(same), 0.5), same, engine).state();
      EXPECT_LE((scaled.velocities - usual.velocities).cwiseAbs().maxCoeff(), rounding_on_the_rim) << engine << unit;
      EXPECT_LE((scaled.spins - usual.spins).cwiseAbs().maxCoeff(), rounding_on_the_rim / 0.5) << engine << unit;
    }
}

TEST(RoughDisks, AnIsolatedPairKeepsItsAngularMomentum) {
  for (const char* engine : engines_with_effects)
    for (const Pair& p : tried_pairs)
      for (const double beta : {-1.0, -0.3, 0.0, 0.5, 1.0}) {
        const Scene scene = rough(scene_of_pair(p), beta, 0.8);
        const State start = spinning(make_simulation(scene).state(), Eigen::Vector2d(p.spin, p.other_spin));
        const Simulation simulation = met(scene, p, engine);
        // Terms as large as the box times the momentum, and I w.
        const double scale = 16.0 * (p.mass + p.other_mass) * 4.0;
        EXPECT_NEAR(angular_momentum(simulation.disks(), simulation.state()), angular_momentum(simulation.disks(), start),
                    rounding_on_the_rim * scale)
            << engine << ", beta = " << beta << ", masses " << p.mass << " and " << p.other_mass;
      }
}

TEST(RoughDisks, EnergyLostIsEnergyCounted) {
  // Elastic at beta = +-1, and with what is lost at others: 1e5 collisions, bound as for smooth disks (laws_test.cpp).
  for (const char* engine : engines_with_effects)
    for (const double beta : {-1.0, 0.99, 1.0}) {
      Simulation simulation = make_simulation(rough(mixture_scene(64, 0.4, Boundary::periodic), beta), engine);
      const double first = all_energy(simulation.disks(), simulation.state());
      const V momentum = total_momentum(simulation.disks(), simulation.state());
      simulation.run_until(1e9, {.collisions = 100'000});
      const double last = all_energy(simulation.disks(), simulation.state());
      EXPECT_NEAR((last + simulation.totals().dissipated) / first, 1.0, 1e-12) << engine << ", beta = " << beta;
      if (std::abs(beta) == 1.0) {
        EXPECT_NEAR(last / first, 1.0, 1e-12);
      }
      EXPECT_LE((total_momentum(simulation.disks(), simulation.state()) - momentum).norm(), 1e-12 * 64);
    }
}

TEST(RoughDisks, SmoothOnesKeepTheirSpins) {
  for (const char* engine : engines_with_effects) {
    const Scene scene = rough(gas_scene(16, 0.4, Boundary::walls), -1.0);
    const Eigen::VectorXd spins = Eigen::VectorXd::LinSpaced(16, -2.0, 3.0);
    Simulation smooth = make_simulation(scene, spinning(make_simulation(scene).state(), spins), engine);
    Simulation plain = make_simulation(gas_scene(16, 0.4, Boundary::walls), engine);
    smooth.run_until(10.0);
    plain.run_until(10.0);
    EXPECT_EQ(smooth.state().spins, spins);
    EXPECT_TRUE(same_bits(smooth.state(), plain.state()));
  }
}

TEST(RoughDisks, PerfectlyRoughOnesFindTheirWayBack) {
  // As for smooth disks: rho* = 0.4, back within 1e-12 after T = 1, 1e-8 after 4 (tests/physics/laws_test.cpp).
  for (const char* engine : engines_with_effects)
    for (const auto& [time, bound] : {std::pair{1.0, 1e-12}, std::pair{4.0, 1e-8}}) {
      const Scene scene = rough(gas_scene(64, 0.4 * std::numbers::pi / 4, Boundary::periodic), 1.0);
      const State start = spinning(make_simulation(scene).state(), Eigen::VectorXd::LinSpaced(64, -3.0, 3.0));
      Simulation there = make_simulation(scene, start, engine);
      there.run_until(time);
      State turned = there.state();
      turned.velocities = -turned.velocities;
      turned.spins = -turned.spins;
      Simulation back = make_simulation(scene, turned, engine);
      back.run_until(time);
      const State end = back.state();
      EXPECT_GT(back.totals().pair, 30U);
      EXPECT_LE((end.velocities + start.velocities).cwiseAbs().maxCoeff(), 10 * bound) << engine << ", T = " << time;
      EXPECT_LE((end.spins + start.spins).cwiseAbs().maxCoeff(), 10 * bound) << engine << ", T = " << time;
    }
}

TEST(RoughDisks, AFrozenSpinIsSetGoingByAGrazingTouch) {
  // All but tangential: an impact parameter of 1 - 2^-20. The tangential impulse is a third of the momentum nonetheless.
  for (const char* engine : engines_with_effects) {
    const Scene scene = rough(
        scene_of_placed(box_of(8.0, 8.0, Boundary::walls), {{{2.0, 4.0}, {1.0, 0.0}}, {{4.0, 5.0 - 0x1p-20}, {0.0, 0.0}}}), 1.0);
    Simulation simulation = make_simulation(scene, engine);
    simulation.run_until(3.0);
    ASSERT_EQ(simulation.totals().pair, 1U);
    const State end = simulation.state();
    // mu = 1/2, and g_t is the impact parameter: dw = 2 (2/3) (1/2) g_t / r for both, to some roundings.
    EXPECT_NEAR(std::abs(end.spins[0]), 4.0 / 3.0 * (1.0 - 0x1p-20), 1e-15);
    EXPECT_EQ(end.spins[0], end.spins[1]) << "cog-wheels turn the same way round where both are struck on the same side";
    EXPECT_NEAR(all_energy(simulation.disks(), end), 0.5, 1e-15);
  }
}

}  // namespace
}  // namespace carom::test
