// A program's own collision rule: that of the scene, written as a function, leads to the same trajectory; what it gives is
// checked.

#include "support/effect_scenes.hpp"
#include "support/refusal.hpp"
#include "support/scenes.hpp"
#include "support/systems.hpp"

#include "observe/mechanics.hpp"

#include <carom/observe.hpp>
#include <carom/simulation.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace carom::test {
namespace {

using testing::HasSubstr;

/// Smooth hard disks with a restitution.
CollisionFunction smooth(double restitution) {
  return [restitution](CollidingPair& contact) {
    const double u = contact.normal.dot(contact.velocity - contact.partner_velocity);
    const double reduced = contact.mass * contact.partner_mass / (contact.mass + contact.partner_mass);
    const Eigen::Vector2d impulse = -(1.0 + restitution) * reduced * u * contact.normal;
    contact.velocity += impulse / contact.mass;
    contact.partner_velocity -= impulse / contact.partner_mass;
  };
}

TEST(OwnRule, AsAFunctionIsTheRuleOfTheScene) {
  for (const double restitution : {1.0, 0.75}) {
    Scene scene = mixture_scene(20, 0.3, Boundary::walls);
    scene.effects.collision.restitution = restitution;
    for (const char* engine : engines_with_effects) {
      SCOPED_TRACE(engine);
      Simulation expected = make_simulation(scene, engine), own = make_simulation(scene, engine);
      own.set_collision_rule(smooth(restitution));
      for (int step = 0; step < 60; ++step) {
        const std::optional<Event> a = expected.step(), b = own.step();
        ASSERT_EQ(a->disk, b->disk);
        ASSERT_EQ(a->partner, b->partner);
        ASSERT_NEAR(a->time, b->time, 1e-9);
        ASSERT_TRUE(a->velocity.isApprox(b->velocity, 1e-8));
      }
      EXPECT_NEAR(own.totals().virial, expected.totals().virial, 1e-8 * expected.totals().virial);
      EXPECT_NEAR(own.totals().dissipated, expected.totals().dissipated, 1e-8);
    }
  }
}

TEST(OwnRule, IsToldWhichDisksMeetTheLowerOneFirst) {
  const Scene scene = mixture_scene(20, 0.3, Boundary::walls);
  for (const char* engine : {"auto", "textbook"}) {
    Simulation simulation = make_simulation(scene, engine);
    std::vector<CollidingPair> seen;
    simulation.set_collision_rule([&](CollidingPair& contact) {
      seen.push_back(contact);
      smooth(1.0)(contact);
    });
    while (simulation.counts().pair < 50) {
      const std::optional<Event> event = simulation.step();
      if (event->partner < 0) continue;
      ASSERT_EQ(seen.size(), simulation.counts().pair);
      const CollidingPair& contact = seen.back();
      EXPECT_EQ(contact.disk, event->disk);
      EXPECT_EQ(contact.partner, event->partner);
      EXPECT_LT(contact.disk, contact.partner);
      const auto i = static_cast<std::size_t>(contact.disk), j = static_cast<std::size_t>(contact.partner);
      EXPECT_EQ(contact.mass, simulation.disks().mass[i]);
      EXPECT_EQ(contact.partner_radius, simulation.disks().radius[j]);
      const State state = simulation.state();
      const Eigen::Vector2d apart = state.positions.col(contact.disk) - state.positions.col(contact.partner);
      EXPECT_TRUE(contact.normal.isApprox(apart.normalized(), 1e-9));
    }
  }
}

TEST(OwnRule, TakesTheGeneralEngineAndLeavesItAgain) {
  Simulation simulation = make_simulation(gas_scene(16, 0.3, Boundary::periodic));
  EXPECT_EQ(simulation.engine(), "fast");
  EXPECT_TRUE(simulation.supports_collision_records());
  simulation.set_collision_rule(smooth(1.0));
  EXPECT_TRUE(simulation.has_collision_rule());
  EXPECT_EQ(simulation.engine(), "general");
  EXPECT_EQ(simulation.engine_reason(), "a collision rule of the program acts");
  EXPECT_FALSE(simulation.supports_collision_records());
  simulation.run_until(1.0);
  Effects effects = simulation.scene().effects;
  effects.thermostat = Thermostat{1.0, 0.5};
  simulation.set_effects(effects);
  EXPECT_TRUE(simulation.has_collision_rule()) << "a change of what acts leaves it";
  simulation.set_effects({});
  simulation.set_collision_rule({});
  EXPECT_EQ(simulation.engine(), "fast");
  EXPECT_EQ(simulation.time(), 1.0);
}

TEST(OwnRule, MayLetEnergyInAndOut) {
  Simulation simulation = make_simulation(gas_scene(16, 0.3, Boundary::periodic));
  const double before = kinetic_energy(simulation.disks(), simulation.state());
  simulation.set_collision_rule([](CollidingPair& contact) {
    smooth(1.0)(contact);
    contact.velocity *= 1.01;
  });
  simulation.run_until(1e3, {.collisions = 100});
  const double after = kinetic_energy(simulation.disks(), simulation.state());
  EXPECT_GT(after, before);
  EXPECT_NEAR(simulation.totals().dissipated, before - after, 1e-12 * after);
  EXPECT_THAT(simulation.check_invariants(), testing::IsEmpty());
}

TEST(OwnRule, IsHeldToNumbersThatAreFiniteAndDisksThatPart) {
  for (const char* engine : engines_with_effects) {
    Simulation simulation = make_simulation(gas_scene(16, 0.3, Boundary::periodic), engine);
    const auto said = [&](CollisionFunction rule) {
      simulation.set_collision_rule(std::move(rule));
      const State before = simulation.state();
      const std::string sentence = refusal<std::domain_error>([&] { simulation.run_until(10.0); });
      EXPECT_TRUE(simulation.state().velocities == before.velocities) << "it stands before the collision";
      return sentence;
    };
    EXPECT_THAT(said([](CollidingPair& contact) { contact.velocity[0] = std::numeric_limits<double>::quiet_NaN(); }),
                HasSubstr("the collision rule gives velocities that are not finite to disks"));
    EXPECT_THAT(said([](CollidingPair&) {}), HasSubstr("the collision rule leaves approaching each other disks"));
    EXPECT_THAT(said([](CollidingPair& contact) {
                  smooth(1.0)(contact);
                  contact.velocity *= 1e145;
                  contact.partner_velocity *= 1e145;
                }),
                HasSubstr("the collision rule gives velocities that are too large to compute with to disks"));
    simulation.set_collision_rule([](CollidingPair&) { throw std::length_error("thrown by the rule"); });
    EXPECT_THROW(simulation.run_until(10.0), std::length_error);
    simulation.set_collision_rule(smooth(1.0));
    EXPECT_EQ(simulation.run_until(10.0), StopReason::time) << "the simulation is as good as before";
    EXPECT_THAT(simulation.check_invariants(), testing::IsEmpty());
  }
}

TEST(OwnRule, IsRefusedWhereItCannotAct) {
  const Scene scene = gas_scene(16, 0.3, Boundary::periodic);
  Simulation fast = make_simulation(scene, "fast");
  EXPECT_THROW(fast.set_collision_rule(smooth(1.0)), std::invalid_argument);
  Simulation stepped = make_simulation(scene, FixedStep{"guarded", 0.01});
  EXPECT_THROW(stepped.set_collision_rule(smooth(1.0)), std::logic_error);
  Scene growing = scene;
  growing.effects.growth = Growth{.rate = 0.01};
  Simulation grown = make_simulation(growing);
  EXPECT_THROW(grown.set_collision_rule(smooth(1.0)), std::invalid_argument);
}

TEST(OwnRule, IsNotKnownToObservablesThatFollowCollisions) {
  Scene scene = gas_scene(16, 0.3, Boundary::periodic);
  scene.observe = {{.name = "free_flight"}};
  Simulation simulation = make_simulation(scene);
  simulation.set_collision_rule(smooth(1.0));
  EXPECT_THAT(refusal<SceneError>([&] { const Observation observation(simulation); }),
              HasSubstr("knows the collision rules of scenes only"));
}

}  // namespace
}  // namespace carom::test
