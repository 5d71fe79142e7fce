// What a program may ask for that no file can say, and what only files must say.

#include "simulation/refused_cases.hpp"
#include "support/refusal.hpp"

#include <carom/simulation.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>
#include <string>

namespace carom::test {
namespace {

using testing::HasSubstr;

TEST(ProgramChecks, RefusesStatesOfAnotherSize) {
  const Scene scene = parse_scene(base_text("walls"));
  const auto refused = [&](const std::function<void(State&)>& change) {
    State start = make_simulation(scene).state();
    change(start);
    return refusal<std::invalid_argument>([&] { return make_simulation(scene, start); });
  };
  EXPECT_EQ(refused([](State&) {}), "");
  EXPECT_EQ(refused([](State& s) { s.images.resize(2, 0); }), "");
  EXPECT_THAT(refused([](State& s) { s.images.conservativeResize(2, s.images.cols() - 1); }), HasSubstr("images is given for"));
  EXPECT_THAT(refused([](State& s) { s.spins = Eigen::VectorXd::Zero(s.images.cols() + 1); }), HasSubstr("spins is given for"));
  EXPECT_THAT(refused([](State& s) { s.walls.resize(2); }), HasSubstr("a state of 2 walls is given; give all four, or none"));
}

/// What no file can say.
TEST(ProgramChecks, RefusesListsOfTheWrongLengthAndNumbersThatAreNone) {
  const Scene sound = parse_scene(base_text("walls"));
  const auto refused = [&](const std::function<void(Scene&)>& change) {
    Scene scene = sound;
    change(scene);
    const std::string sentence = refusal<SceneError>([&] { check(scene); });
    EXPECT_EQ(refusal<SceneError>([&] { (void)make_simulation(scene); }), sentence);
    return sentence;
  };
  EXPECT_EQ(refused([](Scene& s) {
              s.species[1].positions = FilePositions{"start.csv", {{0.0, 0.0}}};
            }),
            "disks.1.count is 2, but positions has 1; make them agree, or leave count out");
  EXPECT_EQ(refused([](Scene& s) {
              s.species[1].velocities = FileVelocities{{{0.0, 0.0}}};
            }),
            "disks.1.velocities has length 1, but there are 2 disks; give one [vx, vy] per disk");
  EXPECT_EQ(refused([](Scene& s) { s.run.sample_every = 0.1, s.run.sample_every_collisions = 10; }),
            "run.sample_every is both a time and a number of collisions; give one of them");
  EXPECT_EQ(refused([](Scene& s) { s.observe = {observable("density_profile")}, s.observe[0].axis = 2; }),
            "observe.density_profile.axis is 2; it must be 0 or 1");
}

/// What only files must say.
TEST(ProgramChecks, LeavesNamesAndTheEndToAProgram) {
  Scene scene = parse_scene(base_text("walls"));
  scene.species[0].name = scene.species[1].name = "";
  scene.run.time.reset();
  Simulation simulation = make_simulation(scene);
  EXPECT_EQ(simulation.run_until(0.1), StopReason::time);
  Simulation other = make_simulation(scene);
  EXPECT_EQ(refusal<SceneError>([&] { (void)run_schedule(other); }),
            "[run] has no end; give time = 5.0, collisions = 1_000_000, or both");
}

}  // namespace
}  // namespace carom::test
