// Which engine runs a scene, why, and how much memory it takes.

#include "support/refusal.hpp"
#include "support/systems.hpp"

#include <carom/simulation.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace carom::test {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(ChoiceOfEngine, FastRunsWhatHasNothingButTheRuleAndHardWalls) {
  const Simulation periodic = make_simulation(gas_scene(100, 0.3, Boundary::periodic));
  EXPECT_EQ(periodic.engine(), "fast");
  EXPECT_EQ(periodic.engine_reason(), "nothing but the collision rule acts");
  const Simulation walled = make_simulation(gas_scene(100, 0.3, Boundary::walls));
  EXPECT_EQ(walled.engine(), "fast");
  EXPECT_EQ(walled.engine_reason(), "nothing but the collision rule and hard walls acts");
}

TEST(ChoiceOfEngine, EffectsAtTheirNeutralValuesCallForNothing) {
  Scene scene = gas_scene(100, 0.3, Boundary::walls);
  scene.effects.collision.restitution = 1.0;
  scene.effects.collision.elastic_below = 0.1;  // of collisions that are elastic anyway
  scene.effects.gravity = Gravity{};
  EXPECT_TRUE(scene.effects.acting().empty());
  EXPECT_EQ(make_simulation(scene).engine(), "fast");
}

TEST(ChoiceOfEngine, NamesTheEffectsThatCallForTheGeneralEngine) {
  Scene scene = gas_scene(100, 0.3, Boundary::walls);
  scene.effects.gravity = Gravity{{0.0, -1.0}};
  scene.effects.collision.restitution = 0.9;
  const Simulation simulation = make_simulation(scene);
  EXPECT_EQ(simulation.engine(), "general");
  EXPECT_EQ(simulation.engine_reason(), "the scene asks for restitution, gravity");
}

TEST(ChoiceOfEngine, TakesTheGeneralEngineForShear) {
  Scene scene = gas_scene(100, 0.3, Boundary::periodic);
  scene.effects.shear = Shear{0.1};
  const Simulation simulation = make_simulation(scene);
  EXPECT_EQ(simulation.engine(), "general");
  EXPECT_EQ(simulation.engine_reason(), "the scene asks for shear");
}

TEST(ChoiceOfEngine, SaysThatABoxIsTooSmall) {
  Scene scene = gas_scene(4, 0.6, Boundary::periodic);
  const Simulation simulation = make_simulation(scene);
  EXPECT_EQ(simulation.engine(), "textbook");
  EXPECT_THAT(simulation.engine_reason(), AllOf(HasSubstr("the periodic box is too small"), HasSubstr("2.5 times 1")));
}

TEST(ChoiceOfEngine, SaysWhyTheOneAskedForCannotRunTheScene) {
  Scene scene = gas_scene(100, 0.3, Boundary::walls);
  EXPECT_EQ(make_simulation(scene, "textbook").engine_reason(), "it was asked for");
  scene.effects.gravity = Gravity{{0.0, -1.0}};
  EXPECT_THAT(refusal<std::invalid_argument>([&] { return make_simulation(scene, "fast"); }),
              AllOf(StartsWith("the engine \"fast\" does not cover this scene: the scene asks for gravity; "),
                    EndsWith("take \"general\"")));
  const Scene small = gas_scene(4, 0.6, Boundary::periodic);
  for (const char* engine : {"fast", "general"})
    EXPECT_THAT(refusal<std::invalid_argument>([&] { return make_simulation(small, engine); }), EndsWith("take \"textbook\""));
}

TEST(ChoiceOfEngine, EnginesThatCoverASceneAreKnownWithoutItsStart) {
  Scene scene = gas_scene(100, 0.85, Boundary::periodic);
  scene.species.front().positions = SquareLattice{};
  EXPECT_THROW(make_simulation(scene), SceneError) << "no square lattice of disks is as dense as this";
  EXPECT_EQ(engines_covering(scene), engine_names());
}

// Records of 64 bytes alone are more than a tenth of what is allowed here; ten times as much would be something forgotten.
TEST(ChoiceOfEngine, EveryEngineTellsItsMemory) {
  const Scene scene = gas_scene(1000, 0.3, Boundary::walls);
  for (const char* engine : {"fast", "general", "textbook", "textbook-float", "textbook-long-double", "textbook-quad"}) {
    const std::size_t bytes = make_simulation(scene, engine).bytes();
    EXPECT_GT(bytes, 100'000U) << engine;
    EXPECT_LT(bytes, 1'000'000U) << engine;
  }
  for (const std::string& method : fixed_step_names())
    EXPECT_GT(make_simulation(scene, FixedStep{method, 0.01}).bytes(), 32'000U) << method;
}

TEST(ChoiceOfEngine, EffectsTakeMemoryOnlyWhereTheyAreThere) {
  Scene scene = gas_scene(1000, 0.3, Boundary::periodic);
  const std::size_t without = make_simulation(scene, "general").bytes();
  scene.effects.collision.roughness = 1.0;
  EXPECT_GE(make_simulation(scene, "general").bytes(), without + 8000);
}

}  // namespace
}  // namespace carom::test
