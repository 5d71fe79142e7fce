// Runs that go nowhere end, and say who holds them up; starts that overlap run where they are told to.

#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <carom/simulation.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace carom::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSubsetOf;
using ::testing::Not;

/// Four disks that fill the box when they have grown fourfold, at t = 48.
Scene growing_beyond_jamming() {
  Scene scene;
  scene.box = {{0.0, 0.0}, {4.0, 4.0}, {Boundary::walls, Boundary::walls}};
  Species four = species_of(4, 0.25, 1.0, ListedPositions{{{1.0, 1.0}, {3.0, 1.0}, {1.0, 3.0}, {3.0, 3.0}}},
                            ListedVelocities{{{0.1, 0.2}, {-0.3, 0.1}, {0.2, -0.1}, {-0.1, -0.2}}});
  scene.species = {four};
  scene.effects.growth = Growth{.rate = 0.0625, .packing_fraction = {}, .reduced_pressure = {}, .where = {}};
  scene.run.time = 100.0;
  return scene;
}

TEST(EnginesStandstill, DisksThatGrowBeyondJammingEndTheRunAndAreNamed) {
  for (const char* engine : {"general", "textbook"}) {
    Simulation simulation = make_simulation(growing_beyond_jamming(), engine);
    const RunResult result = run_schedule(simulation);
    EXPECT_EQ(result.stopped, StopReason::jammed) << engine;
    EXPECT_GE(result.stopped_disks.size(), 2U) << engine;  // which of the four still collide, last digits decide
    // A million events at an ulp of 48 each, 7e-15, are 7e-9 of a unit of time.
    EXPECT_NEAR(simulation.time(), 48.0, 1e-7) << engine;
  }
}

TEST(EnginesStandstill, RunningToATimeEndsTooWhereTheClockCreeps) {
  Simulation simulation = make_simulation(growing_beyond_jamming());
  EXPECT_EQ(simulation.run_until(100.0), StopReason::jammed);
}

TEST(EnginesStandstill, DisksThatJamAtOneInstantAreNamedAndNoOthers) {
  Scene scene;
  scene.box = {{0.0, 0.0}, {2.0, 8.0}, {Boundary::walls, Boundary::walls}};
  scene.species = {species_of(3, 0.5, 1.0, ListedPositions{{{1.0, 6.0}, {0.5, 1.0}, {1.5, 1.0}}},
                              ListedVelocities{{{0.0, 1.0}, {1.0, 0.0}, {0.0, 0.0}}})};
  scene.run.time = 1.0;
  Simulation simulation = make_simulation(scene);
  const RunResult result = run_schedule(simulation);
  EXPECT_EQ(result.stopped, StopReason::jammed);
  EXPECT_THAT(result.stopped_disks, ElementsAre(1, 2));
}

TEST(StoppedDisks, ARunThatEndsInTimeNamesNobody) {
  Scene scene = gas_scene(4, 0.1, Boundary::walls);
  scene.run.time = 1.0;
  Simulation simulation = make_simulation(scene);
  EXPECT_TRUE(run_schedule(simulation).stopped_disks.empty());
}

const std::string overlapping = R"([box]
x = [0, 8]
y = [0, 8]
boundary = "walls"
[[disks]]
radius = 0.5
mass = 1
positions = [[3, 4], [3.75, 4]]
velocities = [[1, 0], [0, 0]]
[collision]
rule = "specular"
[run]
time = 1.0
)";

TEST(AcceptOverlap, AnOverlappingStartIsRefusedUnlessItIsAccepted) {
  EXPECT_THAT(refusal([] { (void)parse_scene(overlapping); }), HasSubstr("disks 0 and 1 overlap by 0.25"));
  Scene scene = parse_scene(overlapping, "scene", {"run.accept_overlap=true"});
  Simulation simulation = make_simulation(scene);
  EXPECT_EQ(simulation.run_until(1.0), StopReason::time);
  EXPECT_EQ(simulation.totals().pair, 1U);
  EXPECT_EQ(simulation.state().velocities.col(1), Eigen::Vector2d(1.0, 0.0));
  scene.run.accept_overlap = false;
  EXPECT_THAT(refusal([&] { (void)make_simulation(scene); }), HasSubstr("disks 0 and 1 overlap by 0.25"));
}

}  // namespace
}  // namespace carom::test
