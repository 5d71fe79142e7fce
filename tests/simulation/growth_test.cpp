// Growing disks, seen from outside the loop: when a growth ends, what rescaling does, and what the account of energy says.

#include "neighbours/disks_at_rest.hpp"
#include "observe/mechanics.hpp"
#include "support/refusal.hpp"
#include "support/scenes.hpp"
#include "support/systems.hpp"
#include "theory/equation_of_state.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>

namespace carom::test {
namespace {

Scene growing(Scene scene, double rate, std::optional<double> packing_fraction = {}, std::optional<double> pressure = {}) {
  scene.effects.growth = Growth{rate, packing_fraction, pressure};
  return scene;
}

TEST(Growth, TwoDisksMeetWhereTheirRadiiReachAndPartFasterByTwiceTheGrowth) {
  // Centres 4 apart, coming together at u = 1; contact distance 1 + a t with a = 0.25: they touch at t = 3 / (1 + a).
  const Scene scene = growing(
      scene_of(box_of(20.0, 20.0, Boundary::periodic), {species_of(2, 0.5, 1.0, ListedPositions{{{8.0, 10.0}, {12.0, 10.0}}},
                                                                   ListedVelocities{{{0.5, 0.0}, {-0.5, 0.0}}})}),
      0.25);
  for (const char* engine : {"textbook", "textbook-quad"}) {
    Simulation simulation = make_simulation(scene, engine);
    simulation.record_events(true);
    EXPECT_EQ(simulation.run_until(100.0, {.collisions = 1}), StopReason::collisions);
    const std::vector<Event> events = simulation.take_events();
    ASSERT_EQ(events.size(), 1U);
    EXPECT_NEAR(events[0].time, 2.4, 1.1e-14);  // contact_time's bound: 16 u (|r| + sigma + (|v| + a) t), over 1 + a
    EXPECT_NEAR(events[0].velocity.x(), -0.5 - 0.25, 1e-15);  // u_n' = -u_n + 2 a, half of it each
    EXPECT_NEAR(events[0].partner_velocity.x(), 0.5 + 0.25, 1e-15);
    // One collision of every disk: what growth gave is taken away at once.
    EXPECT_NEAR(kinetic_energy(simulation.disks(), simulation.state()), 0.25, 1e-15);
    EXPECT_NEAR(simulation.totals().growth_energy, 0.0, 1e-15);
    EXPECT_NEAR(simulation.state().scale, 1.0 + 0.25 * 2.4, 1e-14);  // some ten epochs, each rounded by 2e-16
    EXPECT_EQ(simulation.disks().radius[0], 0.5) << "the scene's; the state's scale tells";
  }
}

TEST(Growth, AtRateZeroLeavesTheSameBits) {
  Simulation plain = make_simulation(mixture_scene(20, 0.4, Boundary::walls));
  Simulation neutral = make_simulation(growing(mixture_scene(20, 0.4, Boundary::walls), 0.0));
  EXPECT_EQ(plain.run_until(20.0), StopReason::time);
  EXPECT_EQ(neutral.run_until(20.0), StopReason::time);
  EXPECT_EQ(neutral.engine(), plain.engine());
  EXPECT_TRUE(same_bits(plain.state(), neutral.state()));
}

TEST(Growth, EndsAtThePackingFractionAskedFor) {
  for (const double rate : {0.013, 0.1}) {
    for (const char* engine : {"textbook", "textbook-long-double"}) {
      const Scene scene = growing(gas_scene(36, 0.4, Boundary::walls), rate, 0.6);
      Simulation simulation = make_simulation(scene, engine);
      EXPECT_EQ(simulation.run_until(1e6), StopReason::grown);
      const State end = simulation.state();
      EXPECT_EQ(end.scale, std::sqrt(0.6 / scene.packing_fraction()));
      EXPECT_NEAR(end.time, (end.scale - 1.0) / rate, 1e-14 / rate);
      std::vector<double> radii = simulation.disks().radius;
      for (double& radius : radii) radius *= end.scale;
      EXPECT_LT(deepest_overlap(scene.box, radii, end.positions).relative, 1e-14);
      EXPECT_TRUE(simulation.check_invariants().empty());

      EXPECT_EQ(simulation.run_until(2e6), StopReason::grown) << "there is nothing left to do";
      EXPECT_EQ(simulation.time(), end.time);
    }
  }
}

TEST(Growth, EndsAScheduleThatWaitsForCollisions) {
  Scene scene = growing(gas_scene(16, 0.3, Boundary::periodic), 0.05, 0.5);
  scene.run.collisions = 1'000'000'000;
  scene.run.sample_every = 0.5;
  Simulation simulation = make_simulation(scene);
  const RunResult result = run_schedule(simulation);
  EXPECT_EQ(result.stopped, StopReason::grown);
  EXPECT_EQ(result.samples, static_cast<std::uint64_t>(simulation.time() / 0.5) + 1);
  EXPECT_EQ(simulation.state().scale, std::sqrt(0.5 / scene.packing_fraction()));
}

TEST(Growth, OfDisksAtRestOrOfOneAloneEndsToo) {
  for (const std::int64_t count : {1, 4}) {
    Scene scene = growing(gas_scene(count, 0.1, Boundary::periodic), 0.5, 0.2);
    scene.species.front().velocities = AtRest{};
    if (count > 1) scene.run.collisions = 10;
    if (count == 1) scene.run.time = 1e3;  // one disk cannot be asked for collisions
    Simulation simulation = make_simulation(scene);
    EXPECT_EQ(run_schedule(simulation).stopped, StopReason::grown) << count;
    EXPECT_EQ(simulation.totals().pair, 0U);
  }
}

TEST(Growth, StopsAtTheTimeOfTheRunWhereThatComesFirst) {
  Scene scene = growing(gas_scene(16, 0.3, Boundary::periodic), 0.05, 0.5);
  scene.run.time = 3.0;
  Simulation simulation = make_simulation(scene);
  EXPECT_EQ(run_schedule(simulation).stopped, StopReason::time);
  EXPECT_NEAR(simulation.state().scale, 1.15, 1e-14);  // some ten epochs, each rounded by 2e-16
}

TEST(Growth, KeepsTheEnergyOfTheStartAndAnHonestAccount) {
  for (const double roughness : {-1.0, 1.0}) {
    Scene scene = growing(mixture_scene(64, 0.3, Boundary::periodic), 0.02, 0.7);
    if (roughness > -1.0) scene.effects.collision.restitution = 0.98;  // loss and gain at once
    Simulation simulation = make_simulation(scene);
    const double before = kinetic_energy(simulation.disks(), simulation.state());
    std::uint64_t pairs = 0;
    while (simulation.run_until(1e6, {.collisions = pairs += 32}) == StopReason::collisions) {
      // Just rescaled, every time. Sums of 64 squares and a factor: some 1e-15.
      ASSERT_NEAR(kinetic_energy(simulation.disks(), simulation.state()), before, 1e-14 * before);
    }
    const Totals& totals = simulation.totals();
    EXPECT_GT(totals.pair, 1000U);
    // Every collision and rescaling rounds the energy by 1e-15 of the whole at most.
    EXPECT_NEAR(kinetic_energy(simulation.disks(), simulation.state()), before + totals.growth_energy - totals.dissipated,
                2e-15 * static_cast<double>(totals.pair) * before);
  }
}

TEST(Growth, TellsWhatCollisionsTakeFromWhatSurfacesGive) {
  // Two disks that close in at u = 1, their surfaces at 1 + a, a = 1/4; four more, far away, so that nothing is rescaled yet.
  const ListedPositions places{{{8, 8}, {12, 8}, {8, 48}, {24, 48}, {40, 48}, {56, 48}}};
  const ListedVelocities velocities{{{0.5, 0}, {-0.5, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}}};
  Scene scene = growing(scene_of(box_of(64.0, 64.0, Boundary::walls), {species_of(6, 0.5, 1.0, places, velocities)}), 0.25);
  scene.effects.collision.restitution = 0.5;
  constexpr double mu = 0.5, closing = 1.25, a = 0.25, e = 0.5;
  for (const CollisionRule rule : both_rules)
    for (const char* engine : engines_with_effects) {
      scene.effects.collision.rule = rule;
      Simulation simulation = make_simulation(scene, engine);
      ASSERT_EQ(simulation.run_until(10.0, {.collisions = 1}), StopReason::collisions);
      const Totals& totals = simulation.totals();
      EXPECT_NEAR(totals.dissipated, mu * (1 - e * e) * closing * closing / 2, 1e-14) << engine;
      EXPECT_NEAR(totals.growth_energy, mu * a * (1 + e) * closing, 1e-14) << engine;
      const double kinetic = kinetic_energy(simulation.disks(), simulation.state());
      EXPECT_NEAR(kinetic, 0.25 + totals.growth_energy - totals.dissipated, 1e-14);
    }
}

TEST(Growth, LeavesTheTemperatureToAThermostatWhereThereIsOne) {
  Scene scene = growing(gas_scene(36, 0.3, Boundary::periodic), 0.005, 0.5);
  scene.effects.thermostat = Thermostat{1.0, 0.5};
  Simulation simulation = make_simulation(scene);
  const double before = kinetic_energy(simulation.disks(), simulation.state());
  EXPECT_EQ(simulation.run_until(1e6), StopReason::grown);
  const Totals& totals = simulation.totals();
  EXPECT_GT(totals.growth_energy, 0.0) << "nothing was taken from it";
  EXPECT_NEAR(kinetic_energy(simulation.disks(), simulation.state()), before + totals.growth_energy + totals.thermostat_energy,
              2e-15 * static_cast<double>(totals.pair + totals.thermostat) * before);
}

TEST(Growth, LeavesTheSameBitsWhereverOneStops) {
  const Scene scene = growing(mixture_scene(20, 0.3, Boundary::walls), 0.03, 0.6);
  Simulation once = make_simulation(scene), often = make_simulation(scene);
  EXPECT_EQ(once.run_until(1e6), StopReason::grown);
  StopReason reason = StopReason::time;
  for (std::uint64_t k = 1; reason != StopReason::grown; ++k) {
    if ((reason = often.run_until(1e6, {.collisions = 7 * k})) == StopReason::grown) break;
    reason = often.run_until(often.time() + 0.01);
  }
  EXPECT_TRUE(same_bits(once.state(), often.state()));
  EXPECT_EQ(once.state().scale, often.state().scale);
  EXPECT_EQ(once.totals().growth_energy, often.totals().growth_energy);
}

TEST(Growth, GoesOnFromTheScaleOfAStateThatIsGiven) {
  const Scene first = growing(gas_scene(36, 0.3, Boundary::periodic), 0.03, 0.45);
  Simulation half = make_simulation(first);
  EXPECT_EQ(half.run_until(1e6), StopReason::grown);
  const Scene second = growing(gas_scene(36, 0.3, Boundary::periodic), 0.03, 0.6);
  Simulation whole = make_simulation(second, half.state());
  EXPECT_EQ(whole.run_until(1e6), StopReason::grown);
  EXPECT_EQ(whole.state().scale, std::sqrt(0.6 / first.packing_fraction()));
  EXPECT_NEAR(whole.time(), (whole.state().scale - half.state().scale) / 0.03, 1e-13);
}

TEST(Growth, IsNotEquilibrated) {
  Scene scene = growing(gas_scene(16, 0.3, Boundary::periodic), 0.05, 0.5);
  scene.run.collisions = 10;
  scene.run.equilibrate = Run::Equilibrate{{}, 1.0};
  EXPECT_NE(refusal<SceneError>([&] { (void)make_simulation(scene); }), "");
}

TEST(PhysicsGrowth, StopsAtThePressureAskedFor) {
  const double asked = 4.0 * 0.5 / std::numbers::pi * theory::kolafa_rottner(0.5);
  const Scene scene = growing(gas_scene(64, 0.3, Boundary::periodic), 2e-4, {}, asked);
  Simulation simulation = make_simulation(scene);
  EXPECT_EQ(simulation.run_until(1e6), StopReason::grown);
  // A window of 32 * 64 collisions knows Z - 1 to 2.2 %; four times that in P* is 2.6 % in eta, as d ln P* / d ln eta = 3.4.
  // The window lasts 9 units of time, in which eta grows by 0.0018.
  const double reached = scene.packing_fraction() * std::pow(simulation.state().scale, 2);
  EXPECT_NEAR(reached, 0.5, 0.013 + 0.002);
}

TEST(PhysicsGrowth, OfAThousandDisksMakesNoOverlap) {
  for (const bool mixture : {false, true}) {
    Scene scene = growing(mixture ? mixture_scene(1000, 0.4, Boundary::periodic) : gas_scene(1000, 0.4, Boundary::periodic), 0.01,
                          mixture ? 0.82 : 0.84);
    Simulation simulation = make_simulation(scene);
    std::uint64_t pairs = 0;
    StopReason reason = StopReason::collisions;
    while (reason == StopReason::collisions) {
      reason = simulation.run_until(1e6, {.collisions = pairs += 20'000});
      const State state = simulation.state();
      std::vector<double> radii = simulation.disks().radius;
      for (double& radius : radii) radius *= state.scale;
      ASSERT_LT(deepest_overlap(scene.box, radii, state.positions).relative, 1e-13);
      ASSERT_LT(pairs, 4'000'000U) << "jammed at " << scene.packing_fraction() * state.scale * state.scale;
    }
    EXPECT_EQ(reason, StopReason::grown);
  }
}

}  // namespace
}  // namespace carom::test
