// An effect at its neutral value leaves the same bits as the engine without it, on every example scene and every engine; and an
// engine that has every effect gives the same bits as one that has none, where none acts.

#include "scene/effect_traits.hpp"
#include "support/engines.hpp"
#include "support/same_totals.hpp"
#include "support/scene_files.hpp"
#include "support/scenes.hpp"

#include <carom/simulation.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace carom::test {
namespace {

/// Some collisions of every disk are enough for a single different bit to have spread to all.
constexpr double collisions_per_disk = 10.0;

struct End {
  State state;
  Totals totals;
};

End end_of(const Scene& scene, const std::string& engine) {
  const auto running = make_engine(engine, scene);
  const auto pairs = static_cast<std::uint64_t>(collisions_per_disk / 2.0 * static_cast<double>(scene.disk_count()));
  running->run_until(scene.run.time ? Instant{*scene.run.time, 0.0} : forever, pairs, 200'000);
  return {running->state(), running->totals()};
}

void expect_same(const End& one, const End& other, const std::string& what) {
  EXPECT_TRUE(same_bits(one.state, other.state)) << what;
  EXPECT_EQ(different_events(one.totals, other.totals), "") << what;
}

bool is_valid(const Scene& scene) {
  try {
    check(scene);
    return true;
  } catch (const SceneError&) {
    return false;
  }
}

/// The scene with one effect more, at its neutral value, where it may have that. Tables that it has already stay as they are.
struct Neutral {
  std::string name;
  Scene scene;
};

std::vector<Neutral> with_neutral_effects(const Scene& scene) {
  std::vector<Neutral> all;
  const auto add = [&](const std::string& name, auto&& change) {
    all.push_back({name, scene});
    change(all.back().scene.effects);
  };
  const Effects& effects = scene.effects;
  if (!effects.collision.restitution) add("restitution", [](Effects& e) { e.collision.restitution = 1.0; });
  if (!effects.collision.roughness && effects.collision.rule == CollisionRule::specular)
    add("roughness", [](Effects& e) { e.collision.roughness = -1.0; });
  if (!effects.collision.elastic_below) add("elastic_below", [](Effects& e) { e.collision.elastic_below = 0.0; });
  if (!effects.gravity) add("gravity", [](Effects& e) { e.gravity = Gravity{}; });
  for (std::size_t wall = 0; wall < 4; ++wall) {
    const WallProperties& properties = effects.walls[wall];
    if (scene.box.periodic(static_cast<int>(wall / 2))) continue;
    if (properties.temperature) {
      if (!properties.tangential_velocity)
        add("wall tangential velocity", [&](Effects& e) { e.walls[wall].tangential_velocity = 0.0; });
      continue;
    }
    if (!properties.restitution) add("wall restitution", [&](Effects& e) { e.walls[wall].restitution = 1.0; });
    if (!properties.velocity && !properties.mass) add("wall velocity", [&](Effects& e) { e.walls[wall].velocity = 0.0; });
    if (!properties.velocity && !properties.mass && !properties.vibration && !properties.oscillation) {
      add("wall vibration", [&](Effects& e) { e.walls[wall].vibration = 0.0; });
      add("wall oscillation", [&](Effects& e) { e.walls[wall].oscillation = Oscillation{WaveForm::sine, 0.0, 1.0}; });
    }
  }
  for (const detail::EffectTraits& effect : detail::all_effects())
    if (!effect.numbers.empty() && !effect.is_present(effects))
      add(std::string(effect.name), [&](Effects& e) { detail::set_numbers(e, effect, &detail::EffectNumber::neutral); });
  std::erase_if(all, [](const Neutral& neutral) { return !is_valid(neutral.scene); });
  return all;
}

class EnginesNeutral : public testing::TestWithParam<std::string> {
 protected:
  const Scene scene = load_scene(example_path(GetParam()));
};

TEST_P(EnginesNeutral, EveryEffectAtItsNeutralValueLeavesTheSameBits) {
  for (const std::string& engine : engines_covering(scene)) {
    if (engine != "general" && engine != "textbook") continue;
    const End plain = end_of(scene, engine);
    for (const Neutral& neutral : with_neutral_effects(scene)) {
      End end = end_of(neutral.scene, engine);
      if (neutral.name == "roughness") end.totals.thermostat_energy = plain.totals.thermostat_energy;  // spins are redrawn too
      expect_same(plain, end, engine + ": " + neutral.name);
    }
  }
}

TEST_P(EnginesNeutral, TheEngineWithEveryEffectGivesTheBitsOfTheLeanOne) {
  if (!scene.effects.neutral()) GTEST_SKIP() << "something acts";
  expect_same(end_of(scene, "fast"), end_of(scene, "general"), "fast and general");
}

TEST_P(EnginesNeutral, TheChoiceOfTheEngineDoesNotDependOnNeutralEffects) {
  if (!scene.effects.neutral()) GTEST_SKIP() << "something acts";
  for (const Neutral& neutral : with_neutral_effects(scene))
    EXPECT_EQ(make_simulation(neutral.scene).engine(), "fast") << neutral.name;
}

TEST(EnginesNeutralValues, AreEachTriedOnSomeExampleScene) {
  std::set<std::string> tried;
  for (const std::string& name : example_scenes())
    for (const Neutral& neutral : with_neutral_effects(load_scene(example_path(name)))) tried.insert(neutral.name);
  for (const char* by_hand : {"restitution", "roughness", "elastic_below", "gravity", "wall restitution", "wall velocity",
                              "wall vibration", "wall oscillation", "wall tangential velocity"})
    EXPECT_TRUE(tried.contains(by_hand)) << by_hand;
  for (const detail::EffectTraits& effect : detail::all_effects())
    EXPECT_TRUE(effect.numbers.empty() || tried.contains(std::string(effect.name))) << effect.name;
}

INSTANTIATE_TEST_SUITE_P(All, EnginesNeutral, testing::ValuesIn(example_scenes()), [](const auto& scene) { return scene.param; });

}  // namespace
}  // namespace carom::test
