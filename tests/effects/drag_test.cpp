// Uniform drag: on the clock s the events are those without it.

#include "observe/effects_report.hpp"
#include "observe/mechanics.hpp"
#include "scene/effect_traits.hpp"
#include "simulation/drag_engine.hpp"
#include "support/effect_scenes.hpp"
#include "support/engines.hpp"
#include "support/refusal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

namespace carom::test {
namespace {

using V = Eigen::Vector2d;

Scene with_drag(Scene scene, double rate) {
  scene.effects.drag = Drag{rate};
  return scene;
}

/// Disks of two sizes and masses between inelastic walls, with an obstacle in the middle.
Scene crowd(CollisionRule rule, double restitution) {
  Scene scene = mixture_scene(60, 0.3, Boundary::walls);
  scene.effects.collision.rule = rule;
  scene.effects.collision.restitution = restitution;
  scene.effects.walls[0].restitution = restitution;
  const V middle = 0.5 * (scene.box.lower + scene.box.upper);
  scene.effects.obstacles = {SegmentObstacle{middle, middle + V(0.01, 0.0)}};
  return scene;
}

/// One disk of radius 1/2 that flies to and fro between walls from x = 1 to the right; its centre has a way of 4.
Scene shuttle(double speed) {
  return scene_of_placed({{0.0, 0.0}, {5.0, 5.0}, {Boundary::walls, Boundary::walls}}, {{{1.0, 2.5}, {speed, 0.0}, 0.5, 2.0}});
}

constexpr double rounding = 16 * 0x1p-53;

TEST(Drag, LeavesEveryEventWhereItIsOnItsClock) {
  const double rate = 0.25;
  for (const char* name : engines_with_effects)
    for (const CollisionRule rule : both_rules)
      for (const double restitution : {1.0, 0.95}) {
        SCOPED_TRACE(testing::Message() << name << ", e = " << restitution);
        const Scene free = crowd(rule, restitution), slowed = with_drag(free, rate);
        const auto without = make_engine(name, free);
        without->record_events(true);
        without->run_until({3.0, 0.0}, no_limit, no_limit);
        const std::vector<Event> expected = without->take_events();
        ASSERT_GT(expected.size(), 200U);

        Start start = draw_start(slowed);
        auto inner = detail::choose_engine(slowed, start.disks, name).make(slowed, start.disks, start.state);
        AnyEngine& on_clock = *inner;
        detail::DragEngine drag(std::move(inner), rate);
        const DragClock clock(rate);
        drag.record_events(true);
        drag.run_until({clock.time({3.0, 0.0}), 0.0}, no_limit, no_limit);
        const std::vector<Event> found = on_clock.take_events();
        ASSERT_NEAR(static_cast<double>(found.size()), static_cast<double>(expected.size()),
                    1.0);  // by rounding of the last time

        const Ran ran = run(slowed, name, clock.time({3.0, 0.0}));
        ASSERT_EQ(ran.events.size(), found.size());
        for (std::size_t k = 0; k < std::min(found.size(), expected.size()); ++k) {
          const Event &a = found[k], &b = expected[k], &told = ran.events[k];
          ASSERT_EQ(a.time, b.time) << k;
          ASSERT_EQ(a.time_remainder, b.time_remainder) << k;
          ASSERT_EQ(a.disk, b.disk) << k;
          ASSERT_EQ(a.partner, b.partner) << k;
          ASSERT_EQ(a.velocity, b.velocity) << k;
          ASSERT_EQ(a.partner_velocity, b.partner_velocity) << k;
          ASSERT_EQ(told.disk, b.disk) << k;
          ASSERT_EQ(told.partner, b.partner) << k;
          const double s = b.time;
          ASSERT_NEAR(told.time, -std::log1p(-rate * s) / rate, rounding * 10) << k;
          ASSERT_LE((told.velocity - (1.0 - rate * s) * b.velocity).norm(), rounding * b.velocity.norm()) << k;
        }
      }
}

TEST(Drag, SlowsOneDiskAsTheClosedFormSays) {
  const double rate = 0.125, speed = 2.0;
  for (const char* name : engines_with_effects) {
    SCOPED_TRACE(name);
    Simulation simulation = make_simulation(with_drag(shuttle(speed), rate), name);
    for (const double time : {0.25, 1.0, 3.5, 10.0, 30.0}) {
      ASSERT_EQ(simulation.run_until(time), StopReason::time);
      const State state = simulation.state();
      ASSERT_EQ(state.time, time);
      const double way = speed * -std::expm1(-rate * time) / rate;  // of 16 in all: it turns at 3.5, 7.5, 11.5 and 15.5
      const double from_left = std::fmod(0.5 + way, 8.0);
      EXPECT_NEAR(state.positions(0, 0), 0.5 + std::min(from_left, 8.0 - from_left), 8 * rounding);
      EXPECT_NEAR(std::abs(state.velocities(0, 0)), speed * std::exp(-rate * time), rounding * speed);
      EXPECT_EQ(state.velocities(0, 0) < 0.0, from_left > 4.0);
      EXPECT_EQ(simulation.totals().wall, static_cast<std::uint64_t>((way + 0.5) / 4.0));
    }
  }
}

TEST(Drag, CountsWhatWallsTakeAtTheSpeedThatIsLeft) {
  const double rate = 0.125, speed = 2.0;
  Scene scene = with_drag(shuttle(speed), rate);
  scene.effects.walls[1].restitution = 0.5;
  for (const char* name : engines_with_effects) {
    SCOPED_TRACE(name);
    Simulation simulation = make_simulation(scene, name);
    ASSERT_EQ(simulation.run_until(4.0), StopReason::time);
    const double left = 1.0 - rate * 1.75;  // at s = 3.5 / 2
    const Totals totals = simulation.totals();
    ASSERT_EQ(totals.wall, 1U);
    EXPECT_NEAR(totals.wall_impulse[1], 2.0 * 1.5 * speed * left, rounding * 8);
    EXPECT_NEAR(totals.wall_energy[1], 0.5 * 2.0 * 0.75 * speed * speed * left * left, rounding * 8);
  }
}

TEST(Drag, CountsImpulsesAndLossesOfPairsAtTheSpeedThatIsLeft) {
  const double rate = 0.125;
  Scene scene = with_drag(scene_of_placed({{-4.0, -4.0}, {4.0, 4.0}, {Boundary::periodic, Boundary::periodic}},
                                          {{{-1.5, 0.0}, {1.0, 0.0}, 0.5, 1.0}, {{1.5, 0.0}, {-1.0, 0.0}, 0.5, 1.0}}),
                          rate);
  scene.effects.collision.restitution = 0.5;
  for (const char* name : engines_with_effects) {
    SCOPED_TRACE(name);
    Simulation simulation = make_simulation(scene, name);
    ASSERT_EQ(simulation.run_until(2.0), StopReason::time);
    const double left = 1.0 - rate * 1.0;  // each has gone 1
    const Totals totals = simulation.totals();
    ASSERT_EQ(totals.pair, 1U);
    EXPECT_NEAR(totals.virial, 1.5 * left, rounding);              // contact distance 1, impulse (1 + e) mu |v| of the pair
    EXPECT_NEAR(totals.dissipated, 0.75 * left * left, rounding);  // (1 - e^2) of an energy of 1
  }
}

TEST(Drag, TakesEnergyTwiceAsFastAsSpeed) {
  const Scene scene = with_drag(mixture_scene(60, 0.3, Boundary::periodic), 0.2);
  for (const char* name : engines_with_effects) {
    SCOPED_TRACE(name);
    Simulation simulation = make_simulation(scene, name);
    const double before = kinetic_energy(simulation.disks(), simulation.state());
    for (const double time : {1.0, 5.0, 20.0}) {
      ASSERT_EQ(simulation.run_until(time), StopReason::time);
      const State state = simulation.state();
      const double now = kinetic_energy(simulation.disks(), state);
      EXPECT_NEAR(now / before, std::exp(-0.4 * time), 1e-13 * std::exp(-0.4 * time));
      const auto given = effects_report(scene, simulation.disks(), simulation.totals(), state).energy_supplied;
      ASSERT_TRUE(given);
      EXPECT_NEAR(now - before, *given, 1e-13 * before);
    }
    EXPECT_GT(simulation.totals().pair, 100U);
  }
}

TEST(Drag, EndsAtRestAfterTheWholeWay) {
  for (const double rate : {0.125, 1e-3, 1e300}) {
    SCOPED_TRACE(rate);
    for (const char* name : engines_with_effects) {
      Scene scene = with_drag(shuttle(16.0 * rate), rate);  // a way of 16 in all: to x = 0.5 + 0.5
      if (rate == 1e300) scene = with_drag(shuttle(2.0), rate);
      Simulation simulation = make_simulation(scene, name);
      ASSERT_EQ(simulation.run_until(1e300), StopReason::at_rest);
      const State state = simulation.state();
      EXPECT_NEAR(state.positions(0, 0), 1.0, 64 * rounding);
      EXPECT_NEAR(simulation.time() * rate, 52.0 * std::numbers::ln2, 40 * rounding);
      EXPECT_NEAR(state.velocities(0, 0), 0.0, 0x1p-50 * 16.0 * std::max(rate, 1.0));
      EXPECT_EQ(simulation.run_until(1e300), StopReason::at_rest);
      EXPECT_EQ(state_hash(simulation.state()), state_hash(state));
    }
  }
}

TEST(Drag, EndsARunThatWaitsForCollisionsThatNeverCome) {
  Scene scene = with_drag(mixture_scene(20, 0.2, Boundary::periodic), 0.5);
  scene.run.collisions = 1'000'000;
  for (const char* name : engines_with_effects) {
    Simulation simulation = make_simulation(scene, name);
    const RunResult result = run_schedule(simulation);
    EXPECT_EQ(result.stopped, StopReason::at_rest);
    EXPECT_LT(simulation.totals().pair, 1'000'000U);
    EXPECT_EQ(simulation.check_invariants(), std::vector<std::string>{});
  }
}

TEST(Drag, LeavesNoTraceOfWhereARunWasSampledOrSavedOrItsClockReset) {
  const Scene scene = with_drag(crowd(CollisionRule::specular, 0.9), 0.1);
  for (const char* name : engines_with_effects) {
    SCOPED_TRACE(name);
    const Ran whole = run(scene, name, 6.0);
    Simulation pieces = make_simulation(scene, name);
    for (int k = 1; k <= 40; ++k) ASSERT_EQ(pieces.run_until(0.1 * k), StopReason::time);
    std::stringstream saved;
    pieces.save(saved);
    Simulation restored = restore_simulation(scene, saved);
    ASSERT_EQ(restored.run_until(6.0), StopReason::time);
    EXPECT_EQ(state_hash(restored.state()), state_hash(whole.simulation.state()));
    EXPECT_EQ(restored.totals().virial, whole.simulation.totals().virial);

    // A new zero of the clock rounds anew, so the same events follow until that has grown.
    Simulation again = make_simulation(scene, name);
    ASSERT_EQ(again.run_until(2.0), StopReason::time);
    again.reset_clock();
    EXPECT_EQ(again.time(), 0.0);
    again.record_events(true);
    ASSERT_EQ(again.run_until(0.5), StopReason::time);
    const std::vector<Event> later = again.take_events();
    ASSERT_GT(later.size(), 10U);
    std::size_t k = 0;
    while (k < whole.events.size() && whole.events[k].time <= 2.0) ++k;
    ASSERT_LE(k + 10, whole.events.size());
    for (std::size_t n = 0; n < 10; ++n) {
      EXPECT_EQ(later[n].disk, whole.events[k + n].disk);
      EXPECT_EQ(later[n].partner, whole.events[k + n].partner);
      EXPECT_NEAR(later[n].time + 2.0, whole.events[k + n].time, 1e-9);
      EXPECT_LE((later[n].velocity - whole.events[k + n].velocity).norm(), 1e-9);
    }
  }
}

TEST(Drag, IsRefusedWithWhatItCannotActWith) {
  const detail::EffectTraits& drag = detail::effect_named("drag");
  Scene scene = with_drag(crowd(CollisionRule::specular, 0.9), 0.1);
  scene.effects.obstacles.clear();
  const auto said = [](const Scene& changed) { return refusal<SceneError>([&] { check(changed); }); };
  ASSERT_EQ(said(scene), "");
  const auto expect = [&](const char* other, auto&& change) {
    Scene changed = scene;
    change(changed.effects);
    const std::string title(detail::effect_named(other).title);
    EXPECT_EQ(said(changed), "[drag] and " + title + " cannot be combined; remove one of the two");
    changed.effects.drag->rate = 0.0;
    EXPECT_EQ(said(changed), "") << other;
  };
  expect("roughness", [](Effects& e) { e.collision.roughness = 0.5; });
  expect("elastic_below", [](Effects& e) { e.collision.elastic_below = 1e-6; });
  expect("gravity", [](Effects& e) { e.gravity = Gravity{{0.0, -1.0}}; });
  expect("thermal_walls", [](Effects& e) { e.walls[1].temperature = 1.0; });
  expect("vibrating_walls", [](Effects& e) { e.walls[1].vibration = 1e-3; });
  expect("oscillating_walls", [](Effects& e) { e.walls[1].oscillation = Oscillation{WaveForm::sine, 1e-3, 1.0}; });
  expect("moving_walls", [](Effects& e) { e.walls[1].velocity = 1e-3; });
  expect("pistons", [](Effects& e) { e.walls[1].mass = 1.0, e.walls[1].load = 1.0; });
  expect("growth", [](Effects& e) { e.growth = Growth{.rate = 1e-3, .reduced_pressure = 10.0}; });
  expect("thermostat", [](Effects& e) { e.thermostat = Thermostat{1.0, 0.1}; });
  expect("tumbling", [](Effects& e) { e.tumbling = Tumbling{0.1}; });
  expect("brownian", [](Effects& e) { e.brownian = Brownian{1.0, 0.1}; });
  expect("square_well", [](Effects& e) { e.square_well = SquareWell{1.1, 0.1}; });
  expect("stepped_potential", [](Effects& e) { e.stepped_potential = SteppedPotential{{{1.1, 0.1}}}; });
  EXPECT_EQ(drag.excludes.size(), 15U);  // these, and shear, which has no walls
  Scene equilibrated = scene;
  equilibrated.run.equilibrate = Run::Equilibrate{1.0, {}};
  EXPECT_EQ(
      said(equilibrated),
      "[drag] and run.equilibrate cannot be combined; equilibrate in a run without drag, and start one with drag from where "
      "it ends");
}

}  // namespace
}  // namespace carom::test
