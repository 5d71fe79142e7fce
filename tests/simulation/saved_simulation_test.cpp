// A saved simulation is checked before it is used: what kind of file it is, which version wrote it, with which scene, whether all
// of it is there. A simulation that was changed goes on to the same bits, from the scene that it was made with and from the one
// that it has.

#include "support/effect_scenes.hpp"
#include "support/refusal.hpp"
#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <carom/simulation.hpp>
#include <carom/version.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>

namespace carom::test {
namespace {

using testing::HasSubstr;

Scene walled_gas() { return gas_scene(24, 0.3, Boundary::walls); }

std::string saved(const Simulation& simulation) {
  std::ostringstream out;
  simulation.save(out);
  return out.str();
}

Simulation restored(const Scene& scene, const std::string& bytes) {
  std::istringstream in(bytes);
  return restore_simulation(scene, in);
}

/// What is said of a stream; empty where it is restored.
std::string said_of(const Scene& scene, const std::string& bytes) {
  return refusal<std::runtime_error>([&] { return restored(scene, bytes); });
}

void expect_same_way(Simulation& a, Simulation& b) {
  EXPECT_EQ(a.engine(), b.engine());
  EXPECT_EQ(a.engine_reason(), b.engine_reason());
  for (int step = 0; step < 100; ++step) {
    const std::optional<Event> one = a.step(), other = b.step();
    ASSERT_EQ(one->time, other->time);
    ASSERT_EQ(one->disk, other->disk);
    ASSERT_EQ(one->velocity, other->velocity);
  }
  EXPECT_TRUE(same_bits(a.state(), b.state()));
  EXPECT_EQ(a.totals().virial, b.totals().virial);
  EXPECT_EQ(a.counts().events(), b.counts().events());
}

TEST(SavedSimulation, GoesOnAfterAChangeFromEitherScene) {
  Scene scene = walled_gas();
  scene.effects.walls[0].temperature = 1.0;
  for (const char* engine : {"auto", "textbook"}) {
    Simulation simulation = make_simulation(scene, engine);
    simulation.run_until(1.0);
    Effects effects = scene.effects;
    effects.gravity = Gravity{{0.0, -0.5}};
    effects.obstacles = {DiskObstacle{scene.box.lower + Eigen::Vector2d(0.05, 0.05), 0.01}};
    effects.walls[1].velocity = 0.01;
    effects.thermostat = Thermostat{1.0, 0.1};
    simulation.set_effects(effects);
    simulation.run_until(2.0);
    effects.walls[1] = {};
    effects.thermostat.reset();
    simulation.set_effects(effects);
    simulation.run_until(3.0);
    const std::string bytes = saved(simulation);
    Simulation from_first = restored(scene, bytes), from_last = restored(simulation.scene(), bytes);
    EXPECT_EQ(from_first.scene().box.upper, simulation.scene().box.upper);
    Simulation copy = restored(scene, bytes);
    expect_same_way(simulation, from_first);
    expect_same_way(copy, from_last);
    // The streams are known to those that go on, of what has been taken away too.
    effects.thermostat = Thermostat{1.0, 5.0};
    simulation.set_effects(effects);
    from_first.set_effects(effects);
    expect_same_way(simulation, from_first);
  }
}

TEST(SavedSimulation, KnowsDisksThatHaveGrown) {
  Scene scene = gas_scene(24, 0.2, Boundary::periodic);
  scene.effects.growth = Growth{.rate = 0.05};
  Simulation simulation = make_simulation(scene);
  simulation.run_until(2.0);
  Effects effects = scene.effects;
  effects.growth.reset();
  simulation.set_effects(effects);
  simulation.run_until(3.0);
  Simulation back = restored(scene, saved(simulation));
  EXPECT_EQ(back.disks().radius, simulation.disks().radius);
  expect_same_way(simulation, back);
}

TEST(SavedSimulation, KnowsEveryRadiusOfAListThatHasGrown) {
  Scene scene = gas_scene(24, 0.2, Boundary::periodic);
  Species& species = scene.species.front();
  species.radii.assign(24, species.radius);
  species.radii.back() = 0.5 * species.radius;
  scene.effects.growth = Growth{.rate = 0.05};
  Simulation simulation = make_simulation(scene);
  simulation.run_until(2.0);
  Effects effects = scene.effects;
  effects.growth.reset();
  simulation.set_effects(effects);
  EXPECT_DOUBLE_EQ(simulation.disks().radius.back(), 1.1 * scene.species.front().radii.back());
  Simulation back = restored(scene, saved(simulation));
  EXPECT_EQ(back.disks().radius, simulation.disks().radius);
  expect_same_way(simulation, back);
}

TEST(SavedSimulation, KnowsWhereEveryWallHasStopped) {
  const Scene scene = walled_gas();
  Simulation simulation = make_simulation(scene);
  Effects effects = scene.effects;
  effects.walls[0].velocity = -0.25;  // outward, as the others are
  effects.walls[1].velocity = 0.5;
  effects.walls[2].velocity = -0.125;
  effects.walls[3].velocity = 0.75;
  simulation.set_effects(effects);
  simulation.run_until(1.0);
  for (WallProperties& wall : effects.walls) wall = {};
  simulation.set_effects(effects);
  Simulation back = restored(scene, saved(simulation));
  const Box& box = back.scene().box;
  EXPECT_NEAR(box.lower.x(), scene.box.lower.x() - 0.25, 1e-12);
  EXPECT_NEAR(box.upper.x(), scene.box.upper.x() + 0.5, 1e-12);
  EXPECT_NEAR(box.lower.y(), scene.box.lower.y() - 0.125, 1e-12);
  EXPECT_NEAR(box.upper.y(), scene.box.upper.y() + 0.75, 1e-12);
  expect_same_way(simulation, back);
}

TEST(SavedSimulation, WantsItsCollisionRuleAgain) {
  const auto back_and_forth = [](CollidingPair& contact) { std::swap(contact.velocity, contact.partner_velocity); };
  Simulation simulation = make_simulation(walled_gas());
  simulation.set_collision_rule(back_and_forth);
  simulation.run_until(1.0);
  Simulation back = restored(walled_gas(), saved(simulation));
  EXPECT_TRUE(back.has_collision_rule());
  EXPECT_THROW(back.run_until(2.0), std::logic_error);
  EXPECT_THROW(back.step(), std::logic_error);
  EXPECT_THROW(back.set_velocities(back.state().velocities), std::logic_error);
  back.set_collision_rule(back_and_forth);
  expect_same_way(simulation, back);
}

TEST(SavedSimulation, MayHaveAnotherEndAndOtherFiles) {
  Simulation simulation = make_simulation(walled_gas());
  simulation.run_until(1.0);
  Scene scene = walled_gas();
  scene.title = "another title";
  scene.run.time = 77.0;
  scene.run.sample_every = 0.5;
  scene.output.events = true;
  scene.observe = {{.name = "pressure"}};
  EXPECT_EQ(said_of(scene, saved(simulation)), "");
}

TEST(SavedSimulation, OfAnotherSceneIsRefusedByTheFirstDifference) {
  Simulation simulation = make_simulation(walled_gas());
  simulation.run_until(1.0);
  const std::string bytes = saved(simulation);
  const auto said = [&](auto change) {
    Scene scene = walled_gas();
    change(scene);
    return said_of(scene, bytes);
  };
  EXPECT_THAT(said([](Scene& s) { s.effects.collision.restitution = 0.9; }), HasSubstr("restitution = 0.9"));
  EXPECT_THAT(said([](Scene& s) { s.run.seed = 99; }), HasSubstr("\"seed = 1\" in place of \"seed = 99\""));
  EXPECT_THAT(said([](Scene& s) { s.species[0].mass = 3.0; }), HasSubstr("\"mass = 1.0\" in place of \"mass = 3.0\""));
  EXPECT_THAT(said([](Scene& s) { --s.species[0].count; }), HasSubstr("count = 24"));
  EXPECT_THAT(said([](Scene& s) { s.box.upper.x() += 0.5; }), HasSubstr("saved with another scene: it had \"x = "));
  EXPECT_THAT(said([](Scene& s) { s.species[0].masses.assign(24, 1.0); }), HasSubstr("checksum of radii and masses"));
}

TEST(SavedSimulation, OfAnotherKindIsRefused) {
  EXPECT_THAT(said_of(walled_gas(), ""), HasSubstr("this was not written by Simulation::save()"));
  EXPECT_THAT(said_of(walled_gas(), "a file of somebody else, and long enough"), HasSubstr("was not written by"));
}

TEST(SavedSimulation, OfAnotherBuildIsRefusedForThatWhateverFollows) {
  const Simulation simulation = make_simulation(walled_gas());
  const std::string bytes = saved(simulation);
  const std::string version = std::string("carom ") + build_info().version + " (";
  const auto said = [&](const std::string& other) {
    return said_of(walled_gas(), std::string(bytes).replace(bytes.find(version), version.size(), other));
  };
  EXPECT_THAT(said("carom 99.5 ("),
              AllOf(HasSubstr("restored: carom 99.5 ("), HasSubstr("has saved it"), HasSubstr("this is " + version)));
  EXPECT_THAT(said_of(walled_gas(), "carom simulation 3\nwhat was there"), HasSubstr("an earlier carom has saved it"));
}

TEST(SavedSimulation, IsRefusedWhereverItWasCutShort) {
  for (const char* engine : {"fast", "textbook"}) {
    Simulation simulation = make_simulation(walled_gas(), engine);
    simulation.run_until(1.0);
    const std::string bytes = saved(simulation);
    for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 64)
      ASSERT_THAT(said_of(walled_gas(), bytes.substr(0, size)), HasSubstr("the simulation cannot be restored: ")) << size;
    ASSERT_THAT(said_of(walled_gas(), bytes.substr(0, bytes.size() - 1)), HasSubstr("the end of what was written is missing"));
    ASSERT_EQ(said_of(walled_gas(), bytes), "");
  }
}

TEST(SavedSimulation, IsRefusedWhereverAByteHasChanged) {
  Simulation simulation = make_simulation(walled_gas());
  simulation.run_until(1.0);
  const std::string bytes = saved(simulation);
  std::mt19937_64 random(1);
  for (std::size_t at = 0; at < bytes.size(); at += 1 + at / 64) {
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ (1 << (random() % 8)));
    ASSERT_THAT(said_of(walled_gas(), changed), HasSubstr("the simulation cannot be restored: ")) << at;
  }
}

}  // namespace
}  // namespace carom::test
