// The table of effects: what its rows promise each other and the scene.

#include "scene/effect_traits.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <string_view>

namespace carom::test {
namespace {

using detail::all_effects;
using detail::EffectNumber;
using detail::EffectTraits;

TEST(EffectTraits, HasOneRowForEachName) {
  std::set<std::string_view> names;
  for (const EffectTraits& effect : all_effects()) EXPECT_TRUE(names.insert(effect.name).second) << effect.name;
}

TEST(EffectTraits, ExcludesEffectsThatThereAre) {
  for (const EffectTraits& effect : all_effects())
    for (const detail::Exclusion& exclusion : effect.excludes) {
      EXPECT_NE(exclusion.other, effect.name);
      EXPECT_EQ(detail::effect_named(exclusion.other).name, exclusion.other);
    }
}

TEST(EffectTraits, FindsNothingInASceneThatNamesNothing) {
  const Effects none;
  for (const EffectTraits& effect : all_effects()) {
    EXPECT_FALSE(effect.is_present(none)) << effect.name;
    EXPECT_FALSE(effect.acts(none)) << effect.name;
  }
  EXPECT_TRUE(none.neutral());
  EXPECT_EQ(names_of(none, false).size(), 1U);
}

TEST(EffectTraits, SetsAndTellsTheNumbersOfATable) {
  for (const EffectTraits& effect : all_effects()) {
    if (effect.numbers.empty()) continue;
    SCOPED_TRACE(effect.name);
    Effects effects;
    detail::set_numbers(effects, effect, &EffectNumber::neutral);
    EXPECT_TRUE(effect.is_present(effects));
    EXPECT_FALSE(effect.acts(effects));
    EXPECT_TRUE(effects.neutral());
    double value = 1.0;
    for (const EffectNumber& number : effect.numbers) number.set(effects, value += 1.0);
    value = 1.0;
    for (const EffectNumber& number : effect.numbers) EXPECT_EQ(number.value(effects), value += 1.0) << number.key->name;
    EXPECT_TRUE(effect.acts(effects));
    EXPECT_EQ(effects.acting(), std::vector<std::string>{std::string(effect.name)});
    EXPECT_EQ(names_of(effects, false).back(), effect.name);
    ASSERT_NE(effect.words, nullptr);
    EXPECT_FALSE(effect.words(effects).empty());
  }
}

TEST(EffectTraits, KnowsWhichTablesHaveAKey) {
  EXPECT_EQ(detail::tables_with_key("rate"), "[growth], [thermostat], [tumbling], [brownian], [shear] or [drag]");
  EXPECT_EQ(detail::tables_with_key("depth"), "[square_well]");
  EXPECT_EQ(detail::tables_with_key("until"), "[growth]");
  EXPECT_EQ(detail::tables_with_key("steps"), "[stepped_potential]");
  EXPECT_EQ(detail::tables_with_key("mass"), "");
}

TEST(EffectTraits, TellsTheFirstThatActs) {
  Effects effects;
  effects.shear = Shear{};
  effects.thermostat = Thermostat{1.0, 0.0};
  EXPECT_EQ(detail::first_acting(effects, &EffectTraits::changes_velocities_in_flight), nullptr);
  EXPECT_EQ(detail::first_reason(effects, &EffectTraits::why_no_Z), "");
  effects.shear->rate = 0.5;
  EXPECT_EQ(detail::first_acting(effects, &EffectTraits::changes_velocities_in_flight)->title, "[shear]");
  EXPECT_EQ(detail::first_reason(effects, &EffectTraits::why_no_Z), "shear heats the disks");
  EXPECT_FALSE(detail::any_acting(effects, &EffectTraits::draws_random_numbers));
  effects.thermostat->rate = 0.5;
  EXPECT_TRUE(detail::any_acting(effects, &EffectTraits::draws_random_numbers));
}

TEST(EffectTraits, TellsWhetherAllThatActHaveOne) {
  Effects effects;
  EXPECT_TRUE(detail::all_acting(effects, &EffectTraits::draws_random_numbers)) << "none acts";
  effects.thermostat = Thermostat{1.0, 0.5};
  EXPECT_TRUE(detail::all_acting(effects, &EffectTraits::draws_random_numbers));
  effects.gravity = Gravity{{0.0, 0.0}};
  EXPECT_TRUE(detail::all_acting(effects, &EffectTraits::draws_random_numbers)) << "no weight does not act";
  effects.gravity = Gravity{{0.0, -1.0}};
  EXPECT_FALSE(detail::all_acting(effects, &EffectTraits::draws_random_numbers));
}

TEST(EffectTraits, TellsWhetherEnergyIsConservedAtTheValuesThatThereAre) {
  Effects effects;
  EXPECT_TRUE(detail::conserve_energy(effects));
  effects.collision.roughness = 1.0;
  EXPECT_TRUE(detail::conserve_energy(effects)) << "perfectly rough";
  effects.collision.restitution = 0.9;
  EXPECT_FALSE(detail::conserve_energy(effects));
  effects.collision.restitution = 1.0;
  EXPECT_TRUE(detail::conserve_energy(effects));
  effects.collision.roughness = 0.5;
  EXPECT_FALSE(detail::conserve_energy(effects));
}

TEST(EffectTraits, PassesOverEffectsWithATrait) {
  Effects effects;
  effects.obstacles = {DiskObstacle{{0.0, 0.0}, 0.5}};
  effects.gravity = Gravity{{0.0, -1.0}};
  EXPECT_EQ(detail::first_reason(effects, &EffectTraits::why_no_Z), "pressure and density change with height");
  EXPECT_EQ(detail::first_reason(effects, &EffectTraits::why_no_Z, &EffectTraits::only_varies_density),
            "obstacles carry pressure and take up area");
  effects.gravity.reset();
  EXPECT_EQ(detail::first_reason(effects, &EffectTraits::why_no_Z, &EffectTraits::keeps_speeds), "");
}

TEST(EffectTraits, CountsObstaclesInWords) {
  Effects effects;
  const auto words = [&] { return detail::effect_named("obstacles").words(effects); };
  effects.obstacles = {SegmentObstacle{{0.0, 0.0}, {1.0, 0.0}}};
  EXPECT_EQ(words(), "1 fixed segment");
  effects.obstacles.emplace_back(DiskObstacle{{0.0, 0.0}, 0.5});
  effects.obstacles.emplace_back(DiskObstacle{{2.0, 0.0}, 0.5});
  EXPECT_EQ(words(), "2 fixed disks and 1 fixed segment");
  effects.obstacles = {ArcObstacle{{0.0, 0.0}, 1.0, 0.0, 90.0}, ArcObstacle{{2.0, 0.0}, 1.0, 0.0, 90.0}};
  EXPECT_EQ(words(), "2 fixed arcs");
}

TEST(EffectTraits, TellsTheStepsOfAPotentialInWords) {
  Effects effects;
  effects.stepped_potential = SteppedPotential{{{1.2, 1.5}, {1.6, -0.5}}};
  EXPECT_EQ(detail::effect_named("stepped_potential").words(effects),
            "energy of a pair by its distance in diameters: 1.5 below 1.2, -0.5 below 1.6, 0 beyond");
  effects.stepped_potential->steps.clear();
  for (int k = 0; k < 10; ++k) effects.stepped_potential->steps.push_back({1.1 + 0.1 * k, 1.0 - 0.1 * k});
  EXPECT_TRUE(detail::effect_named("stepped_potential").words(effects).ends_with("0.3 below 1.8, 2 more steps, 0 beyond"));
}

TEST(EffectTraits, TellsWhereSpeedsChangeBetweenCollisions) {
  Effects effects;
  effects.obstacles = {DiskObstacle{{0.0, 0.0}, 0.5}};
  effects.walls[0] = {.restitution = 1.0, .velocity = 0.0};
  EXPECT_EQ(detail::first_reason(effects, &EffectTraits::why_no_path), "");
  effects.walls[1] = {.mass = 2.0, .load = 0.0};
  EXPECT_EQ(detail::first_reason(effects, &EffectTraits::why_no_path), "walls change speeds between two collisions");
  effects.walls[1] = {};
  effects.square_well = SquareWell{1.5, -1.0};
  EXPECT_EQ(detail::first_reason(effects, &EffectTraits::why_no_path), "speeds change at the edges of wells");
}

TEST(EffectTraits, HasMildValuesAtWhichEachTableActs) {
  for (const EffectTraits& effect : all_effects()) {
    if (effect.numbers.empty()) continue;
    Effects effects;
    detail::set_numbers(effects, effect, &EffectNumber::mild);
    EXPECT_TRUE(effect.acts(effects)) << effect.name;
  }
}

}  // namespace
}  // namespace carom::test
