// Restitution and gravity in fixed steps: one disk or pair in closed form, exact events for some, and where the energy goes.

#include "observe/energy.hpp"
#include "support/exact_run.hpp"
#include "support/refusal.hpp"
#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace carom::test {
namespace {

constexpr double at_floor = 0.5;  ///< height of the centre of a disk on the floor

Scene falling_scene(const std::vector<Placed>& disks, double side) {
  Scene scene = scene_of(square_box(side, Boundary::walls), {});
  scene.effects.gravity = Gravity{{0.0, -1.0}};
  for (const Placed& disk : disks) scene.species.push_back(species_of(1, disk.radius, disk.mass, RandomPositions{}, AtRest{}));
  return scene;
}

Simulation steps_of(const Scene& scene, const std::vector<Placed>& disks, const std::string& method, double dt) {
  Simulation simulation = make_simulation(scene, system_of(scene.box, disks).state, FixedStep{method, dt});
  simulation.record_events(true);
  return simulation;
}

TEST(StepEffects, ADiskFallsOnItsParabolaWhateverTheMethod) {
  const std::vector<Placed> thrown = {{{2.0, 20.0}, {1.5, 2.0}}};
  const Scene scene = falling_scene(thrown, 32.0);
  for (const std::string& method : fixed_step_names()) {
    Simulation s = steps_of(scene, thrown, method, 0.25);
    for (const double time : {0.0, 0.25, 2.0, 4.125}) {  // a step, and a moment between two
      s.run_until(time);
      const State state = s.state();
      EXPECT_EQ(state.positions.col(0), Eigen::Vector2d(2.0 + 1.5 * time, 20.0 + 2.0 * time - time * time / 2.0)) << method;
      EXPECT_EQ(state.velocities.col(0), Eigen::Vector2d(1.5, 2.0 - time)) << method;
    }
  }
}

TEST(StepEffects, AnInelasticPairKeepsTheShareOfItsSpeedThatRestitutionSays) {
  // Masses 1 and 3 close with speed 4 and part with 1: the centre of mass moves at -2, and mu (16 - 1) / 2 is lost.
  const std::vector<Placed> pair = {{{6.0, 8.0}, {1.0, 0.0}, 0.5, 1.0}, {{8.0, 8.0}, {-3.0, 0.0}, 0.5, 3.0}};
  for (const CollisionRule rule : both_rules)
    for (const std::string& method : fixed_step_names()) {
      // Naive steps turn the pair again and again while it overlaps; a spring takes many.
      if (method == "naive" || method == "naive-edge" || method == "soft") continue;
      Scene scene = falling_scene(pair, 16.0);
      scene.effects.gravity.reset();
      scene.effects.collision = {.rule = rule, .restitution = 0.25};
      Simulation s = steps_of(scene, pair, method, 0.375);
      s.run_until(0.375);
      EXPECT_EQ(s.totals().pair, 1U) << method;
      EXPECT_EQ(s.state().velocities.col(0), Eigen::Vector2d(-2.75, 0.0)) << method;
      EXPECT_EQ(s.state().velocities.col(1), Eigen::Vector2d(-1.75, 0.0)) << method;
      EXPECT_EQ(s.totals().dissipated, 0.75 * 7.5) << method;
    }
}

TEST(StepEffects, ABouncingDiskIsWhereItShouldBeAtEveryStep) {
  // From a height of 2 the disk arrives at time 2 with speed 2 and leaves with 1; at 4 it arrives with 1 and leaves with 1/2.
  const std::vector<Placed> dropped = {{{8.0, at_floor + 2.0}, {0.0, 0.0}, 0.5, 2.0}};
  Scene scene = falling_scene(dropped, 16.0);
  scene.effects.walls[2].restitution = 0.5;
  for (const char* method : {"backtrack", "swept"})
    for (const double dt : {0.4375, 1.0, 1.5, 3.0, 4.5}) {
      Simulation s = steps_of(scene, dropped, method, dt);
      s.run_until(4.5);  // at a step, or between two
      EXPECT_NEAR(s.state().positions(1, 0), at_floor + 0.5 * 0.5 - 0.125, 1e-14) << method << ' ' << dt;
      s.run_until(6.0);
      std::vector<double> times;
      for (const Event& event : s.take_events()) {
        EXPECT_EQ(event.partner, wall_bottom);
        times.push_back(event.time);
      }
      if (times.size() > 2) times.resize(2);
      ASSERT_EQ(times.size(), 2U) << method << ' ' << dt;
      EXPECT_NEAR(times[0], 2.0, 1e-14) << method << ' ' << dt;
      EXPECT_NEAR(times[1], 4.0, 1e-14) << method << ' ' << dt;
    }
}

TEST(StepEffects, ADiskThatTouchesTheCeilingWithinAStepIsTurnedThere) {
  // Thrown with speed 2 it would rise by 2; the ceiling is 1.5 away and met at time 1, with speed 1. Without it the disk would be
  // below it again from time 3 on.
  const std::vector<Placed> thrown = {{{8.0, 14.0}, {0.0, 2.0}}};
  const Scene scene = falling_scene(thrown, 16.0);
  for (const char* method : {"backtrack", "swept"})
    for (const double dt : {0.75, 2.0, 3.5}) {
      Simulation s = steps_of(scene, thrown, method, dt);
      s.run_until(3.5);
      EXPECT_EQ(s.totals().wall_impulse[3] > 0.0, std::floor(3.5 / dt) * dt >= 1.0) << method << ' ' << dt;
      // Down with speed 1 from time 1 on.
      EXPECT_NEAR(s.state().positions(1, 0), 15.5 - 2.5 - 2.5 * 2.5 / 2.0, 1e-13) << method << ' ' << dt;
    }
}

Scene granular_scene(std::uint64_t seed, CollisionRule rule) {
  Scene scene = mixture_scene(12, 0.3, Boundary::walls, seed);
  scene.effects.gravity = Gravity{{0.25, -1.0}};
  scene.effects.collision = {.rule = rule, .restitution = 0.8};
  scene.effects.walls[0].restitution = 0.7;
  scene.effects.walls[2].restitution = 0.9;
  return scene;
}

TEST(StepEffects, BacktrackAndSweptHaveTheEventsOfTheExactEngineWithBoth) {
  int backtracks = 0;
  for (const CollisionRule rule : both_rules)
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      const Scene scene = granular_scene(seed, rule);
      const State start = make_simulation(scene).state();
      constexpr double end = 1.5;
      const ExactRun exact = exact_run(scene, start, end);
      ASSERT_EQ(exact.end.time, end);
      ASSERT_GT(exact.events.size(), 10U);
      ASSERT_GT(exact.totals.dissipated, 0.1);
      const auto hold = [&](const FixedStep& step) {
        const std::string what = fmt::format("{}, seed {}, dt = {}", step.method, seed, step.dt);
        Simulation s = make_simulation(scene, start, step);
        s.record_events(true);
        s.run_until(end);
        expect_the_events_of(exact, s, 1e-7, what);
        EXPECT_LT(rms_difference(scene, s.state(), exact.end), 1e-7) << what;
        EXPECT_NEAR(s.totals().dissipated, exact.totals.dissipated, 1e-7) << what;
        for (const std::size_t wall : {0U, 1U, 2U, 3U})
          EXPECT_NEAR(s.totals().wall_energy[wall], exact.totals.wall_energy[wall], 1e-7) << what;
      };
      for (const double dt : {0.01, 0.1, 0.5, 1.5}) hold({"swept", dt});
      if (const std::optional<double> dt = backtrack_step(exact, end)) ++backtracks, hold({"backtrack", *dt});
    }
  EXPECT_GE(backtracks, 6);
}

TEST(StepEffects, EveryBitOfEnergyIsAccountedFor) {
  for (const char* method : {"guarded", "grid", "backtrack", "swept"})
    for (const double dt : {0.003, 0.05}) {
      const Scene scene = granular_scene(3, CollisionRule::specular);
      Simulation s = make_simulation(scene, FixedStep{method, dt});
      const double before = total_energy(scene.box, scene.effects, s.disks(), s.state());
      s.run_until(3.0);
      double taken = s.totals().dissipated;
      for (const double energy : s.totals().wall_energy) taken += energy;
      EXPECT_GT(taken, 1.0) << method;
      EXPECT_NEAR(total_energy(scene.box, scene.effects, s.disks(), s.state()) + taken, before, 1e-12 * before) << method;
    }
}

TEST(StepEffects, GuardedStepsApproachTheEnergyOfExactEventsWithTheFirstOrderOfDt) {
  // A late reversal takes its share of a speed that gravity has changed since.
  const std::vector<Placed> dropped = {{{8.0, at_floor + 2.0}, {0.0, 0.0}}};
  Scene scene = falling_scene(dropped, 16.0);
  scene.effects.walls[2].restitution = 0.5;
  for (const double dt : {0.0101, 0.00101}) {
    // It is found k dt > 2 down, with speed k dt: three quarters of its square are lost, and then it is dt-close below the floor.
    Simulation s = steps_of(scene, dropped, "guarded", dt);
    const double found = std::ceil(2.0 / dt) * dt;
    s.run_until(found);
    EXPECT_NEAR(s.totals().wall_energy[2], 0.75 * found * found / 2.0, 1e-12);
    EXPECT_GT(s.totals().wall_energy[2] - 1.5, 0.0);
    EXPECT_LT(s.totals().wall_energy[2] - 1.5, 1.6 * dt);
  }
}

TEST(StepEffects, ADiskAtRestOnTheFloorSinksAsDerived) {
  // Each step turns the speed v that the disk has at it into e v upward, which gravity makes v again: v = g dt / (1 + e). It goes
  // down by g dt^2 / 2 - e v dt.
  const std::vector<Placed> dropped = {{{8.0, at_floor + 0.5}, {0.0, 0.0}}};
  for (const double restitution : {0.0, 0.5, 0.9})
    for (const double dt : {0.01, 0.002}) {
      Scene scene = falling_scene(dropped, 16.0);
      scene.effects.walls[2].restitution = restitution;
      const double expected = dt * dt * (1.0 - restitution) / (2.0 * (1.0 + restitution));
      for (const char* method : {"guarded", "grid", "backtrack", "swept"}) {
        Simulation s = steps_of(scene, dropped, method, dt);
        s.run_until_sample(20'000, dt);
        const double before = s.state().positions(1, 0);
        s.run_until_sample(21'000, dt);
        EXPECT_NEAR((before - s.state().positions(1, 0)) / 1000.0, expected, 1e-6 * dt * dt) << method << ' ' << restitution;
      }
    }
}

TEST(StepEffects, ThoseThatNoStepKnowsAreRefusedByName) {
  Scene scene = gas_scene(4, 0.1, Boundary::periodic);
  scene.effects.collision.restitution = 0.5;
  scene.effects.shear = Shear{0.0};  // neutral
  (void)make_simulation(scene, FixedStep{"grid", 0.1});
  scene.effects.shear = Shear{0.1};
  scene.effects.drag = Drag{0.0};
  EXPECT_EQ(refusal<std::invalid_argument>([&] {
              return make_simulation(scene, FixedStep{"grid", 0.1});
            }),
            "fixed-step methods know the collision rule, hard walls, restitution, gravity, inelastic_walls, obstacles, "
            "circle; this scene asks for shear besides, which exact events alone simulate");
}

}  // namespace
}  // namespace carom::test
