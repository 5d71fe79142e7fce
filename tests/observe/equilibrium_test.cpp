// For which scenes Z is one number.

#include "observe/equilibrium.hpp"
#include "support/systems.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

namespace carom::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

Effects with(const std::function<void(Effects&)>& change) {
  Effects effects;
  change(effects);
  return effects;
}

TEST(Equilibrium, EveryEffectAtItsNeutralValueKeepsZ) {
  const Effects neutral = with([](Effects& e) {
    e.collision.restitution = 1.0;
    e.collision.roughness = -1.0;
    e.gravity = Gravity{};
    e.walls[0].restitution = 1.0;
    e.walls[1].velocity = 0.0;
    e.growth = Growth{};
    e.thermostat = Thermostat{.temperature = 2.0, .rate = 0.0};
    e.shear = Shear{};
    e.square_well = SquareWell{.width = 2.0, .depth = 0.0};
  });
  EXPECT_THAT(why_no_Z(neutral), IsEmpty());
  EXPECT_FALSE(temperature_fluctuates(neutral));
}

TEST(Equilibrium, TumblesThatKeepAllSpeedsKeepZ) {
  const Effects effects = with([](Effects& e) { e.tumbling = Tumbling{.rate = 1.0}; });
  EXPECT_THAT(why_no_Z(effects), IsEmpty());
  EXPECT_FALSE(temperature_fluctuates(effects));
}

TEST(Equilibrium, ABathSpinsAndWellsKeepZAndLetTheTemperatureFluctuate) {
  for (const Effects& effects : {with([](Effects& e) { e.thermostat = Thermostat{.temperature = 2.0, .rate = 0.1}; }),
                                 with([](Effects& e) { e.walls[0].temperature = e.walls[3].temperature = 2.0; }),
                                 with([](Effects& e) { e.collision.roughness = 1.0; }),
                                 with([](Effects& e) { e.square_well = SquareWell{.width = 2.0, .depth = -1.0}; })}) {
    EXPECT_THAT(why_no_Z(effects), IsEmpty());
    EXPECT_TRUE(temperature_fluctuates(effects));
  }
}

TEST(Equilibrium, ErrorsAreOfOneStartWhereReversalExchangesVelocities) {
  Scene scene = gas_scene(4, 0.1, Boundary::walls);
  scene.effects.collision.rule = CollisionRule::reversal;
  EXPECT_THAT(std::string(why_errors_are_of_one_start(scene)), HasSubstr("another start may differ"));
  scene.effects.obstacles.emplace_back();
  EXPECT_THAT(std::string(why_errors_are_of_one_start(scene)), HasSubstr("another start may differ"));
  const auto is_silent = [&](const std::function<void(Scene&)>& change) {
    Scene changed = scene;
    change(changed);
    return why_errors_are_of_one_start(changed).find("only exchange velocities") == std::string_view::npos;
  };
  EXPECT_TRUE(is_silent([](Scene& s) { s.effects.collision.rule = CollisionRule::specular; }));
  EXPECT_TRUE(is_silent([](Scene& s) { s.effects.walls[2].temperature = 1.0; }));
  EXPECT_TRUE(is_silent([](Scene& s) { s.effects.thermostat = Thermostat{.temperature = 2.0, .rate = 1.0}; }));
  EXPECT_TRUE(is_silent([](Scene& s) { s.effects.gravity = Gravity{.acceleration = {0.0, -1.0}}; }));
  EXPECT_TRUE(is_silent([](Scene& s) { s.effects.walls[0].mass = 3.0; }));
  EXPECT_TRUE(is_silent([](Scene& s) { s.species.push_back(s.species.front()), s.species.back().mass *= 2.0; }));
  EXPECT_TRUE(is_silent([](Scene& s) { s.species.front().masses = {1.0, 1.0, 1.0, 1.5}; }));
  EXPECT_FALSE(is_silent([](Scene& s) { s.species.front().masses = {1.5, 1.5, 1.5, 1.5}; }));
}

TEST(Equilibrium, ErrorsAreOfOneStartWhereEnergyIsConservedAndStoredInPlaces) {
  Scene scene = gas_scene(4, 0.1, Boundary::walls);
  const auto says_so = [&](const std::function<void(Effects&)>& change) {
    Scene changed = scene;
    change(changed.effects);
    return why_errors_are_of_one_start(changed).find("where the disks of the start are") != std::string_view::npos;
  };
  const auto falls = [](Effects& e) { e.gravity = Gravity{.acceleration = {0.0, -1.0}}; };
  EXPECT_FALSE(says_so([](Effects& e) { e.gravity = Gravity{}; }));
  EXPECT_TRUE(says_so(falls));
  EXPECT_TRUE(says_so([](Effects& e) { e.square_well = SquareWell{.width = 2.0, .depth = -1.0}; }));
  EXPECT_FALSE(says_so([](Effects& e) { e.walls[0].mass = 3.0; })) << "a piston begins at the same place in every start";
  const auto falls_and = [&](const std::function<void(Effects&)>& change) {
    return says_so([&](Effects& e) { falls(e), change(e); });
  };
  EXPECT_TRUE(falls_and([](Effects& e) { e.tumbling = Tumbling{.rate = 1.0}; }));
  EXPECT_FALSE(falls_and([](Effects& e) { e.thermostat = Thermostat{.temperature = 1.0, .rate = 1.0}; }));
  EXPECT_FALSE(falls_and([](Effects& e) { e.walls[2].temperature = 1.0; }));
  EXPECT_FALSE(falls_and([](Effects& e) { e.collision.restitution = 0.9; }));
}

TEST(Equilibrium, ErrorsAreOfOneStartWhereNoDisksHaveCollided) {
  Scene scene = gas_scene(64, 0.3, Boundary::walls);
  EXPECT_FALSE(note_on_errors(scene, 0.0).empty());
  EXPECT_TRUE(note_on_errors(scene, 1.0).empty());
  scene.effects.walls[0].temperature = 1.0;
  EXPECT_TRUE(note_on_errors(scene, 0.0).empty()) << "the wall gives disks other velocities";
  EXPECT_EQ(note_on_errors(gas_scene(1, 0.01, Boundary::periodic), 0.0), "") << "there is no other disk";
}

TEST(Equilibrium, ErrorsAreLowerBoundsWhereMassesExchangeEnergyMoreSlowlyThanBlocksLast) {
  Scene scene = mixture_scene(64, 0.3, Boundary::periodic);
  const auto is_lower_bound = [&](double mass, double collisions_per_disk) {
    scene.species.front().mass = mass * scene.species.back().mass;
    return !why_errors_are_lower_bounds(scene, collisions_per_disk).empty();
  };
  EXPECT_FALSE(is_lower_bound(1.0, 1.0)) << "equal masses have one mean energy";
  EXPECT_TRUE(is_lower_bound(3.0, 85.0)) << "3/8 of the difference passes at a collision: 85.3 are 32 times as many as 8/3";
  EXPECT_FALSE(is_lower_bound(3.0, 86.0));
  EXPECT_TRUE(is_lower_bound(1000.0, 10'000.0));
  EXPECT_FALSE(is_lower_bound(1e-3, 20'000.0)) << "whichever of the species is the heavier";
  scene.effects.thermostat = Thermostat{.temperature = 1.0, .rate = 0.5};
  EXPECT_FALSE(is_lower_bound(1000.0, 10'000.0)) << "the bath gives each its energy";
}

TEST(Equilibrium, ErrorsAreLowerBoundsWhereDomainsFormAndDissolveMoreSlowlyThanBlocksLast) {
  const auto is_lower_bound = [](double packing_fraction, double collisions_per_disk) {
    return !why_errors_are_lower_bounds(gas_scene(64, packing_fraction, Boundary::periodic), collisions_per_disk).empty();
  };
  EXPECT_TRUE(is_lower_bound(0.7, 2047.0)) << "32 times 64 collisions of each disk are enough";
  EXPECT_FALSE(is_lower_bound(0.7, 2049.0));
  EXPECT_FALSE(is_lower_bound(0.69, 100.0)) << "a liquid";
  EXPECT_FALSE(is_lower_bound(0.73, 100.0)) << "a crystal";
}

TEST(Equilibrium, ErrorsAreLowerBoundsWhereDisksThatCannotPassEachOtherSpreadHeatMoreSlowlyThanBlocksLast) {
  Scene scene = gas_scene(63, 0.1, Boundary::walls);
  scene.box.boundary[0] = Boundary::periodic;
  const auto is_lower_bound = [&](double height_over_radius, double collisions_per_disk) {
    scene.box.upper.y() = scene.box.lower.y() + height_over_radius * scene.species.front().radius;
    return !why_errors_are_lower_bounds(scene, collisions_per_disk).empty();
  };
  EXPECT_TRUE(is_lower_bound(3.9, 3200.0)) << "32 (63 / 2 pi)^2 = 3217 collisions of each disk are enough";
  EXPECT_FALSE(is_lower_bound(3.9, 3230.0));
  EXPECT_FALSE(is_lower_bound(4.1, 10.0)) << "two pass each other";
}

TEST(Equilibrium, EqualDisksAreACrystalBeyondThePackingFractionOfTheSolid) {
  for (const double fraction : {0.71, 0.73}) EXPECT_EQ(is_crystal(gas_scene(64, fraction, Boundary::periodic)), fraction > 0.72);
}

/// Two sizes do not crystallise: they keep the arrangement that they begin with for long.
TEST(Equilibrium, ErrorsAreOfOneStartInADenseMixture) {
  for (const double fraction : {0.71, 0.73}) {
    Scene scene = gas_scene(64, fraction, Boundary::periodic);
    EXPECT_THAT(std::string(why_errors_are_of_one_start(scene)), IsEmpty()) << "equal disks, " << fraction;
    // A quarter of the disks twice as large and the others smaller, at the same packing fraction.
    Species& species = scene.species.front();
    const double small = species.radius * std::sqrt(4.0 / 7.0);
    species.radii.assign(64, small);
    for (std::size_t i = 0; i < 16; ++i) species.radii[i] = 2.0 * small;
    ASSERT_NEAR(scene.packing_fraction(), fraction, 1e-12);
    EXPECT_EQ(why_errors_are_of_one_start(scene).empty(), fraction < 0.72);
    EXPECT_FALSE(is_crystal(scene));
  }
}

TEST(Equilibrium, OutOfItThereIsNoZ) {
  EXPECT_THAT(why_no_Z(with([](Effects& e) { e.collision.restitution = 0.9; })), HasSubstr("collisions"));
  EXPECT_THAT(why_no_Z(with([](Effects& e) { e.collision.roughness = 0.5; })), HasSubstr("collisions"));
  EXPECT_THAT(why_no_Z(with([](Effects& e) { e.gravity = Gravity{.acceleration = {0.0, -1.0}}; })), HasSubstr("height"));
  EXPECT_THAT(why_no_Z(with([](Effects& e) { e.walls[3].velocity = 0.1; })), HasSubstr("area"));
  EXPECT_THAT(why_no_Z(with([](Effects& e) { e.walls[3].mass = 1.0; })), HasSubstr("area"));
  EXPECT_THAT(why_no_Z(with([](Effects& e) { e.walls[3].restitution = 0.5; })), HasSubstr("walls take"));
  EXPECT_THAT(why_no_Z(with([](Effects& e) {
                e.walls[0].temperature = 1.0;
                e.walls[1].temperature = 2.0;
              })),
              StartsWith("walls have different temperatures"));
  EXPECT_THAT(why_no_Z(with([](Effects& e) { e.obstacles.emplace_back(); })), HasSubstr("obstacles"));
  EXPECT_THAT(why_no_Z(with([](Effects& e) { e.growth = Growth{.rate = 0.1}; })), HasSubstr("grow"));
  EXPECT_THAT(why_no_Z(with([](Effects& e) {
                e.walls[0].temperature = 4.0;
                e.thermostat = Thermostat{.temperature = 1.0, .rate = 0.5};
              })),
              HasSubstr("thermostat"));
  EXPECT_THAT(why_no_Z(with([](Effects& e) { e.shear = Shear{.rate = 0.1}; })), HasSubstr("shear"));
}

}  // namespace
}  // namespace carom::test
