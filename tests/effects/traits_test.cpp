// The table of effects against what engines and changes do: what each effect conserves, the memory that it takes, and whether a
// run knows it that has it for a while.

#include "observe/mechanics.hpp"
#include "pages/scene_words.hpp"
#include "runner/expected_memory.hpp"
#include "scene/changes.hpp"
#include "scene/effect_traits.hpp"
#include "support/effect_scenes.hpp"
#include "support/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace carom::test {
namespace {

using detail::all_effects;
using detail::EffectTraits;

/// Sets effects that are no tables of numbers, at values at which they act.
const std::map<std::string, std::function<void(Effects&)>> other_effects = {
    {"restitution", [](Effects& e) { e.collision.restitution = 0.5; }},
    {"roughness", [](Effects& e) { e.collision.roughness = 0.25; }},
    {"elastic_below",
     [](Effects& e) {
       e.collision.restitution = 0.5;
       e.collision.elastic_below = 0.125;
     }},
    {"gravity",
     [](Effects& e) {
       e.gravity = Gravity{{0.0, -1.0}};
     }},
    {"inelastic_walls", [](Effects& e) { e.walls[0].restitution = 0.5; }},
    {"thermal_walls", [](Effects& e) { e.walls[0].temperature = 2.0; }},
    {"sliding_walls", [](Effects& e) { e.walls[0] = {.temperature = 2.0, .tangential_velocity = 1.0}; }},
    {"vibrating_walls", [](Effects& e) { e.walls[1].vibration = 0.25; }},
    {"oscillating_walls",
     [](Effects& e) {
       e.walls[1].oscillation = Oscillation{WaveForm::sine, 0.25, 1.0};
     }},
    {"moving_walls", [](Effects& e) { e.walls[1].velocity = -0.25; }},
    {"pistons", [](Effects& e) { e.walls[3] = {.mass = 1e6, .load = 1.0}; }},
    {"stepped_potential",
     [](Effects& e) {
       e.stepped_potential = SteppedPotential{{{1.2, 0.5}, {1.5, -0.5}}};
     }},
    {"obstacles",
     [](Effects& e) {
       e.obstacles = {DiskObstacle{{0.75, 0.5}, 1.0}};
     }},
};

/// Sets the effect so strong that a short run shows it. A circle takes the area of the box.
void set_strong(Scene& scene, const EffectTraits& effect) {
  Effects& effects = scene.effects;
  if (effect.name == "circle") {
    const Box box = scene.box;
    return put_in_circle(scene.box, effects, {0.5 * (box.lower + box.upper), std::sqrt(box.area() / std::numbers::pi)});
  }
  if (effect.numbers.empty()) return other_effects.at(std::string(effect.name))(effects);
  for (const detail::EffectNumber& number : effect.numbers)
    number.set(effects, number.mild == number.neutral ? number.mild : 0.5);
}

/// Eight disks that come together in the middle of a large box, and meet no side of it until time 4.
Scene cluster(const EffectTraits& effect) {
  std::vector<Placed> disks;
  for (int k = 0; k < 8; ++k) {
    const double angle = 0.7853981633974483 * k, speed = 1.0 + 0.125 * k;
    disks.push_back({.r = Eigen::Vector2d(std::cos(angle), std::sin(angle)) * (3.0 + 0.25 * k),
                     .v = Eigen::Vector2d(-speed * std::cos(angle + 0.125), -speed * std::sin(angle + 0.125)),
                     .mass = 1.0 + 0.25 * k});
  }
  Box box{{-100.0, -100.0}, {100.0, 100.0}, {Boundary::walls, Boundary::walls}};
  if (effect.name == "shear") box.boundary = {Boundary::periodic, Boundary::periodic};
  if (effect.name == "circle") box.upper = -(box.lower = {-5.0, -5.0});  // its rim is met, and keeps angular momentum
  Scene scene = scene_of_placed(box, disks);
  set_strong(scene, effect);
  return scene;
}

class EffectTraitsHold : public testing::TestWithParam<std::string> {};

TEST_P(EffectTraitsHold, AngularMomentumAndEnergyAreConservedAsTheTableSays) {
  const EffectTraits& effect = detail::effect_named(GetParam());
  for (const char* engine : engines_with_effects) {
    SCOPED_TRACE(engine);
    Simulation simulation = make_simulation(cluster(effect), engine);
    const double L = angular_momentum(simulation.disks(), simulation.state()), E = energy_of(simulation);
    ASSERT_GT(std::abs(L), 1.0);
    simulation.run_until(4.0);
    ASSERT_GT(simulation.totals().pair, 0U);
    ASSERT_EQ(simulation.totals().wall, 0U);
    const double change = std::abs(angular_momentum(simulation.disks(), simulation.state()) - L);
    if (effect.conserves_angular_momentum) {
      EXPECT_LE(change, 1e-12 * 100.0);
    } else {
      EXPECT_GT(change, 1e-3);
    }
    const bool lossless = std::ranges::all_of(
        simulation.scene().effects.acting(), [](const std::string& name) { return detail::effect_named(name).conserves_energy; });
    if (lossless) {
      EXPECT_NEAR(energy_of(simulation), E, 1e-12 * 100.0);
    }
  }
}

TEST_P(EffectTraitsHold, MomentumAlongAPeriodicAxisIsConservedAsTheTableSays) {
  const EffectTraits& effect = detail::effect_named(GetParam());
  const bool is_sheared = effect.name == "shear";
  const int axis = is_sheared ? 0 : 1;  // images above move along x
  Scene scene = cluster(effect);
  if (effect.name != "circle")
    scene.box = {{-6.0, -6.0}, {6.0, 6.0}, {is_sheared ? Boundary::periodic : Boundary::walls, Boundary::periodic}};
  if (effect.name == "gravity") scene.effects.gravity->acceleration = {-1.0, 0.0};
  if (effect.name == "pistons") std::swap(scene.effects.walls[1], scene.effects.walls[3]);
  const auto momentum = [&](const Simulation& simulation) {
    return total_momentum(simulation.disks(), simulation.state())[axis];
  };
  for (const char* engine : engines_with_effects) {
    SCOPED_TRACE(engine);
    Simulation simulation = make_simulation(scene, engine);
    const double p = momentum(simulation);
    simulation.run_until(effect.name == "growth" ? 4.0 : 8.0);
    ASSERT_GT(simulation.totals().pair, 0U);
    const double change = std::abs(momentum(simulation) - p);
    EXPECT_EQ(effect.conserves_momentum, conserves_momentum(scene.box, scene.effects, axis));
    if (effect.conserves_momentum) {
      EXPECT_LE(change, 1e-12 * 100.0);
    } else {
      EXPECT_GT(change, 1e-3);
    }
  }
}

TEST_P(EffectTraitsHold, AnEffectOfAnyPartOfARunIsOneOfTheWholeRun) {
  const EffectTraits& effect = detail::effect_named(GetParam());
  Scene scene;
  set_strong(scene, effect);
  const Effects with = scene.effects, without;
  for (const Effects& whole : {detail::merged(without, with), detail::merged(with, without)}) {
    EXPECT_TRUE(effect.acts(whole));
    EXPECT_EQ(whole.acting(), with.acting());
    EXPECT_EQ(words_beyond_the_rule(whole), words_beyond_the_rule(with));
  }
}

TEST_P(EffectTraitsHold, MemoryPerDiskIsThatOfTheTable) {
  const EffectTraits& effect = detail::effect_named(GetParam());
  if (effect.name == "circle") GTEST_SKIP() << "disks in another box have other neighbours";
  const auto bytes = [&](bool with, std::int64_t disks) {
    Scene scene = gas_scene(disks, 0.25, effect.name == "shear" ? Boundary::periodic : Boundary::walls);
    scene.species[0].positions = RandomPositions{};
    if (with) set_strong(scene, effect);
    if (with) detail::set_numbers(scene.effects, effect, &detail::EffectNumber::mild);
    if (with && !scene.effects.obstacles.empty()) scene.effects.obstacles = {DiskObstacle{{4.0, 4.0}, 0.25}};
    if (with && scene.effects.square_well) scene.effects.square_well->width = 1.0 + 1e-9;  // no bonds
    if (with && scene.effects.stepped_potential) scene.effects.stepped_potential->steps = {{1.0 + 1e-9, 0.5}};
    return static_cast<double>(make_simulation(scene, "general").bytes());
  };
  // The memory that does not depend on the number of disks cancels in the second difference.
  const double more = bytes(true, 4096) - bytes(true, 2048), without = bytes(false, 4096) - bytes(false, 2048);
  EXPECT_NEAR((more - without) / 2048.0, effect.bytes_per_disk, 1.0);
}

std::vector<std::string> names_of_all() {
  std::vector<std::string> names;
  for (const EffectTraits& effect : all_effects()) names.emplace_back(effect.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(All, EffectTraitsHold, testing::ValuesIn(names_of_all()), [](const auto& name) { return name.param; });

TEST(ExpectedMemory, IsWithinATenthOfThatOfAGas) {
  Scene scene = gas_scene(20'000, 0.5, Boundary::periodic);
  const auto measured = [&] { return static_cast<double>(make_simulation(scene).bytes()) / 20'000.0; };
  EXPECT_NEAR(expected_memory(scene).bytes_per_disk, measured(), 0.1 * measured());
  scene.effects.thermostat = Thermostat{1.0, 1.0};
  scene.effects.collision.roughness = 1.0;
  EXPECT_NEAR(expected_memory(scene).bytes_per_disk, measured(), 0.1 * measured());
}

TEST(CentreOfMass, IsThermalWhereMomentumIsExchangedAtRandom) {
  const Box box{{0.0, 0.0}, {1.0, 1.0}, {Boundary::periodic, Boundary::walls}};
  Effects effects;
  EXPECT_FALSE(centre_of_mass_is_thermal(box, effects, 0));
  EXPECT_TRUE(centre_of_mass_is_thermal(box, effects, 1));
  effects.gravity = Gravity{{1.0, 0.0}};
  EXPECT_FALSE(conserves_momentum(box, effects, 0)) << "disks fall along it";
  effects.gravity = Gravity{{0.0, 1.0}};
  EXPECT_TRUE(conserves_momentum(box, effects, 0));
  effects.gravity.reset();
  effects.drag = Drag{0.5};  // the momentum decays, and heats nothing
  EXPECT_FALSE(centre_of_mass_is_thermal(box, effects, 0));
  EXPECT_FALSE(conserves_momentum(box, effects, 0));
  effects.thermostat = Thermostat{1.0, 0.5};
  EXPECT_TRUE(centre_of_mass_is_thermal(box, effects, 0));
}

TEST(ConservedQuantities, AreNamed) {
  Box box{{0.0, 0.0}, {1.0, 1.0}, {Boundary::periodic, Boundary::walls}};
  Effects effects;
  EXPECT_EQ(conserved(box, effects), "energy, momentum along x, angular momentum in collisions of disks");
  effects.collision.rule = CollisionRule::reversal;
  EXPECT_EQ(conserved(box, effects), "energy, momentum along x");
  effects.drag = Drag{0.5};
  EXPECT_EQ(conserved(box, effects), "nothing");
  effects = {};
  effects.collision.restitution = 0.5;
  box.boundary[1] = Boundary::periodic;
  EXPECT_EQ(conserved(box, effects), "momentum, angular momentum in collisions of disks");
  effects.collision = {.rule = CollisionRule::specular, .roughness = 1.0};
  EXPECT_EQ(conserved(box, effects), "energy, momentum, angular momentum in collisions of disks");
  effects.collision.roughness = 0.5;
  EXPECT_EQ(conserved(box, effects), "momentum, angular momentum in collisions of disks");
  effects.collision.roughness.reset();
  effects.circle = Circle{.centre = {0.5, 0.5}, .radius = 0.5};
  box.is_circle = true;
  box.boundary = {Boundary::walls, Boundary::walls};
  EXPECT_EQ(conserved(box, effects), "energy, angular momentum about the centre");
}

}  // namespace
}  // namespace carom::test
