// Sheared boxes on the general engine against the textbook engine: event by event, with all totals, in boxes of any shape.

#include "support/same_totals.hpp"
#include "support/twin_engines.hpp"

#include "support/scenes.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace carom::test {
namespace {

Scene sheared(Scene scene, double rate) {
  scene.effects.shear = Shear{rate};
  return scene;
}

Scene gas_in(double x, double y, double packing_fraction, double rate, std::uint64_t seed = 1) {
  const auto disks = static_cast<std::int64_t>(packing_fraction * x * y / (std::numbers::pi / 4.0));
  return sheared(
      scene_of(box_of(x, y, Boundary::periodic), {species_of(disks, 0.5, 1.0, RandomPositions{}, MaxwellVelocities{1.0})}, seed),
      rate);
}

/// Four large disks of radius 2 among small ones of radius 0.5.
Scene radii_one_to_four(double rate) {
  return sheared(
      scene_of(box_of(20.0, 16.0, Boundary::periodic), {species_of(4, 2.0, 16.0, RandomPositions{}, MaxwellVelocities{1.0}),
                                                        species_of(80, 0.5, 1.0, RandomPositions{}, MaxwellVelocities{1.0})}),
      rate);
}

/// Of so many events, compared until rounding makes an end of it.
std::size_t agreed(const Scene& scene, std::size_t most, std::size_t checks = 10) {
  return compare_with_textbook([&](const std::string& name) { return make_engine(name, scene); }, "general", most, checks);
}

// How many events must agree at least: one collision of every disk lets errors grow by e^3.2 at most (reduced density 0.1), from
// 1e-16 to what is compared with 1e-2 / 1000 of a mean free time over the number of disks. In gases of some hundred disks or
// fewer that is more than two collisions of each disk: as many events as there are disks. Flow makes collisions faster, not more
// chaotic by the collision.

TEST(EnginesShear, HaveTheSameEventsAtAnyDensityAndRate) {
  for (const double rate : {0.02, -0.3, 2.0})
    for (const double packing_fraction : {0.1, 0.4, 0.65})
      EXPECT_GE(agreed(sheared(gas_scene(144, packing_fraction, Boundary::periodic), rate), 1500), 144u)
          << "rate " << rate << ", at " << packing_fraction;
}

TEST(EnginesShear, HaveTheSameEventsInFlatAndTallBoxes) {
  EXPECT_GE(agreed(gas_in(120.0, 3.0, 0.3, 0.5), 600), 137u);
  EXPECT_GE(agreed(gas_in(3.0, 120.0, 0.3, 0.05), 600), 137u);
  EXPECT_GE(agreed(gas_in(40.0, 10.0, 0.3, -0.5), 600), 152u);
}

TEST(EnginesShear, HaveTheSameEventsForRadiiOneToFour) {
  EXPECT_GE(agreed(radii_one_to_four(0.2), 600), 84u);
  EXPECT_GE(agreed(radii_one_to_four(-1.0), 600), 84u);
}

TEST(EnginesShear, HaveTheSameEventsWhereDisksAreSlowAndImagesFast) {
  Scene scene = gas_in(12.0, 10.0, 0.3, 10.0);
  ListedVelocities slow;  // in the laboratory, so that nothing flows to begin with
  for (int i = 0; i < scene.disk_count(); ++i) slow.values.emplace_back(1e-3 * std::sin(i), 1e-3 * std::cos(2 * i));
  scene.species[0].velocities = slow;
  // Disks between the edges stand still for long: only some of them collide, so errors grow faster by the collision of each.
  EXPECT_GE(agreed(scene, 200), 22u);
}

TEST(EnginesShear, HaveTheSameEventsWithEverythingElseThatMayAct) {
  Scene scene = radii_one_to_four(0.3);
  scene.effects.collision.restitution = 0.8;
  scene.effects.collision.roughness = 0.5;
  scene.effects.collision.elastic_below = 1e-3;
  scene.effects.thermostat = Thermostat{1.0, 0.5};
  EXPECT_GE(agreed(scene, 400), 84u);
  Scene reversal = gas_in(16.0, 12.0, 0.4, 0.3);
  reversal.effects.collision.rule = CollisionRule::reversal;
  EXPECT_GE(agreed(reversal, 400), 97u);
}

TEST(EnginesShear, EndWithTheSameTotalsAndInTheSamePlaces) {
  for (const double rate : {0.2, -1.5}) {
    Scene scene = radii_one_to_four(rate);
    scene.effects.collision.restitution = 0.9;
    scene.effects.collision.roughness = 0.0;
    scene.effects.thermostat = Thermostat{1.0, 0.5};
    const auto general = make_engine("general", scene), textbook = make_engine("textbook", scene);
    textbook->run_until(forever, 84, no_limit);
    const double time = textbook->now().high + 1e-3;  // between two events
    run_to(*textbook, time);
    run_to(*general, time);
    // Two collisions of every disk: errors begin as 1e-15 of the box and grow by e^3.2 each at most.
    const double tolerance = 1e-15 * 20.0 * std::exp(2.0 * 3.2);
    const State found = general->state(), expected = textbook->state();
    EXPECT_LE((unwrapped(scene.box, found) - unwrapped(scene.box, expected)).cwiseAbs().maxCoeff(), tolerance);
    EXPECT_LE((found.velocities - expected.velocities).cwiseAbs().maxCoeff(),
              tolerance * expected.velocities.cwiseAbs().maxCoeff());
    EXPECT_EQ(found.images, expected.images);
    EXPECT_LE((found.spins - expected.spins).cwiseAbs().maxCoeff(), tolerance * expected.spins.cwiseAbs().maxCoeff());
    EXPECT_NEAR(found.shear_displacement, expected.shear_displacement, tolerance);
    const Totals sums = textbook->totals();
    EXPECT_EQ(different_events(general->totals(), sums, tolerance * sums.virial), "");
  }
}

TEST(EnginesShear, SamplingAndStoppingAnywhereLeaveNoTraceInTheBits) {
  const Scene scene = sheared(gas_scene(64, 0.5, Boundary::periodic), 0.7);
  const auto straight = make_engine("general", scene), stopping = make_engine("general", scene);
  run_to(*straight, 5.0);
  for (int k = 1; k <= 1000; ++k) {
    run_to(*stopping, k / 200.0);
    static_cast<void>(stopping->state());
  }
  EXPECT_TRUE(same_bits(stopping->state(), straight->state()));
  EXPECT_EQ(stopping->totals().shear_energy, straight->totals().shear_energy);
  EXPECT_EQ(stopping->totals().virial_yx, straight->totals().virial_yx);
}

TEST(EnginesShear, GoOnFromAStateWithItsDisplacement) {
  const Scene scene = sheared(gas_scene(64, 0.4, Boundary::periodic), 0.4);
  const auto first = make_engine("general", scene);
  run_to(*first, 3.0);
  first->reset_clock();
  const State state = first->state();
  EXPECT_GT(state.shear_displacement, 0.0);
  EXPECT_EQ(first->totals().shear_energy, 0.0);
  std::vector<Event> events[2];
  for (std::size_t k = 0; k < 2; ++k) {
    Simulation simulation = make_simulation(scene, state, k == 0 ? "general" : "textbook");
    EXPECT_EQ(simulation.state().shear_displacement, state.shear_displacement);
    simulation.record_events(true);
    simulation.run_until(1000.0, {.collisions = 64});
    events[k] = simulation.take_events();
  }
  // Two collisions of every disk let an error of 1e-15 grow by e^6 at most.
  ASSERT_EQ(events[0].size(), events[1].size());
  for (std::size_t k = 0; k < events[0].size(); ++k) {
    ASSERT_TRUE(same_partners(events[0][k], events[1][k])) << k;
    ASSERT_LE(difference(events[0][k], events[1][k]), 1e-12) << k;
  }
  const std::vector<Event> on = next_events(*first, 64);
  for (std::size_t k = 0; k < on.size(); ++k) ASSERT_TRUE(same_partners(on[k], events[1][k])) << k;
}

TEST(EnginesShear, KeepWhatTheyKnowOfEnergyOverManyBoxLengthsOfDisplacement) {
  // Images pass by more than 200 times; a strong thermostat keeps the fluid from heating up.
  Scene scene = gas_in(8.0, 8.0, 0.3, 1.0);
  scene.effects.thermostat = Thermostat{1.0, 2.0};
  const auto engine = make_engine("general", scene);
  const auto kinetic = [&] { return engine->state().velocities.squaredNorm() / 2.0; };
  const double before = kinetic();
  run_to(*engine, 210.25);
  const auto faults = engine->check_invariants();
  EXPECT_TRUE(faults.empty()) << faults.front();
  const Totals& totals = engine->totals();
  ASSERT_GT(totals.pair, 5000u);
  // Every collision and every kick rounds energies of the order of the whole a few times: 1e-15 of it.
  const double events = static_cast<double>(totals.pair + totals.other + totals.thermostat);
  EXPECT_NEAR(kinetic() - before, totals.shear_energy + totals.thermostat_energy, events * 1e-15 * kinetic());
  // Each of some 10,000 epochs rounds the displacement twice, to 1e-15 of the box.
  EXPECT_NEAR(engine->state().shear_displacement, 2.0, 1e-10);
}

RC_GTEST_PROP(PropertyEnginesShear, HaveTheSameEventsInAnySmallBox, ()) {
  const double x = *rc::gen::element(4.0, 6.0, 11.0), y = x * *rc::gen::element(0.7, 1.0, 1.7);
  const double packing_fraction = *rc::gen::element(0.05, 0.2, 0.35);
  const double rate = *rc::gen::element(1e-3, 0.1, -0.1, 1.0, -7.0);
  Scene scene = gas_in(x, y, packing_fraction, rate, *rc::gen::inRange<std::uint64_t>(1, 1'000'000));
  if (*rc::gen::arbitrary<bool>() && scene.species[0].count > 3) {
    Species small = scene.species[0];
    small.name = "small";
    small.count /= 2;  // all together are not too dense to be placed at random
    small.radius = *rc::gen::element(0.4, 0.125);
    small.mass = *rc::gen::element(1.0, 0.01);
    scene.species.push_back(small);
  }
  if (*rc::gen::arbitrary<bool>()) scene.effects.collision.restitution = 0.7;
  const auto disks = static_cast<std::size_t>(scene.disk_count());
  RC_PRE(disks >= 2);
  agreed(scene, 2 * disks, 4);
  RC_ASSERT(!::testing::Test::HasFailure());
}

}  // namespace
}  // namespace carom::test
