// Runs that go nowhere end, and name the disks that stop them; starts that overlap run where they are told to.

#include "support/refusal.hpp"
#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <carom/simulation.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <span>
#include <sstream>
#include <utility>

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
  scene.effects.growth = Growth{.rate = 0.0625};
  scene.run.time = 100.0;
  return scene;
}

TEST(EnginesStandstill, DisksThatGrowBeyondJammingEndTheRunAndAreNamed) {
  for (const char* engine : engines_with_effects) {
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

/// Three disks of radius 0.3 in a channel of height 3: at five times their size one of them fills it, at time 80.
Scene growing_in_a_channel(Boundary across) {
  Scene scene;
  scene.box = {{0.0, 0.0}, {16.0, 3.0}, {Boundary::periodic, across}};
  scene.species = {species_of(3, 0.3, 1.0, ListedPositions{{{2.0, 1.0}, {7.0, 1.5}, {13.0, 2.0}}},
                              ListedVelocities{{{0.5, 0.25}, {-0.25, 0.5}, {-0.25, -0.75}}})};
  scene.effects.growth = Growth{.rate = 0.05, .reduced_pressure = 1e9};
  scene.run.collisions = 1'000'000'000;
  return scene;
}

TEST(EnginesStandstill, ADiskThatGrowsUntilItMeetsItsOwnImageEndsTheRunThere) {
  // The general engine does not cover boxes that narrow.
  Simulation simulation = make_simulation(growing_in_a_channel(Boundary::periodic));
  EXPECT_EQ(run_schedule(simulation).stopped, StopReason::jammed);
  EXPECT_NEAR(simulation.time(), 80.0, 1e-13);
  EXPECT_NEAR(simulation.state().scale, 5.0, 1e-12);
  EXPECT_EQ(make_simulation(growing_in_a_channel(Boundary::periodic)).run_until(1e3), StopReason::jammed);
}

TEST(EnginesStandstill, ADiskThatGrowsFromWallToWallEndsTheRunThere) {
  for (const char* engine : engines_with_effects) {
    Scene scene = growing_in_a_channel(Boundary::walls);
    scene.box.boundary[0] = Boundary::walls;
    Simulation simulation = make_simulation(scene, engine);
    EXPECT_EQ(run_schedule(simulation).stopped, StopReason::jammed) << engine;
    EXPECT_NEAR(simulation.state().scale, 5.0 * (1.0 - 0x1p-16), 1e-12) << engine;  // summed over epochs
    EXPECT_THAT(simulation.check_invariants(), IsEmpty()) << engine;
  }
}

TEST(EnginesStandstill, AStateOfDisksThatHaveFilledTheBoxIsAnEnd) {
  const Scene scene = growing_in_a_channel(Boundary::periodic);
  State start = make_simulation(scene).state();
  start.scale = 5.5;
  Simulation simulation = make_simulation(scene, start);
  EXPECT_EQ(run_schedule(simulation).stopped, StopReason::jammed);
  EXPECT_EQ(simulation.time(), 0.0);
}

/// From rest, or under a thermostat, nothing keeps their energy: their speed grows as the number of collisions, and the time to
/// the next falls as its square, long before the last digits of coordinates end the run.
TEST(EnginesStandstill, DisksThatGrowIntoAJamEndTheRunWhateverKeepsTheirEnergy) {
  for (const bool from_rest : {true, false}) {
    for (const char* engine : engines_with_effects) {
      Scene scene = growing_beyond_jamming();
      if (from_rest) scene.species.front().velocities = AtRest{};
      if (!from_rest) scene.effects.thermostat = Thermostat{1.0, 0.1};
      Simulation simulation = make_simulation(scene, engine);
      EXPECT_EQ(run_schedule(simulation).stopped, StopReason::jammed) << engine << from_rest;
      EXPECT_NEAR(simulation.time(), 48.0, 1e-2) << engine << from_rest;
    }
  }
}

TEST(EnginesStandstill, WallsThatCloseInUntilNothingFitsEndTheRun) {
  for (const char* engine : engines_with_effects) {
    Scene scene = gas_scene(8, 0.2, Boundary::walls);
    scene.effects.walls[3].velocity = -0.5;
    scene.run.collisions = 1'000'000'000'000'000;
    Simulation simulation = make_simulation(scene, engine);
    EXPECT_EQ(run_schedule(simulation).stopped, StopReason::jammed) << engine;
    EXPECT_LT(simulation.time(), 2.0 * (scene.box.lengths().y() - 1.0)) << engine;
  }
}

/// A disk between a wall and one of mass `heavy` that comes towards it.
Scene squeezed(double heavy) {
  Scene scene;
  scene.box = {{0.0, 0.0}, {100.0, 1.0}, {Boundary::walls, Boundary::walls}};
  scene.species = {species_of(1, 0.5, 1.0, ListedPositions{{{5.0, 0.5}}}, ListedVelocities{{{0.0, 0.0}}}),
                   species_of(1, 0.5, heavy, ListedPositions{{{10.0, 0.5}}}, ListedVelocities{{{-1.0, 0.0}}})};
  scene.effects.collision.rule = CollisionRule::specular;
  scene.run.time = 50.0;
  return scene;
}

TEST(EnginesStandstill, ASqueezeThatOpensAgainIsNoEnd) {
  // G. Galperin, Playing pool with pi (2003): the number of collisions has the digits of pi. Up to the nearest approach the clock
  // seems to converge.
  for (const char* engine : {"fast", "textbook"}) {
    Simulation simulation = make_simulation(squeezed(1e12), engine);
    EXPECT_EQ(run_schedule(simulation).stopped, StopReason::time) << engine;
    EXPECT_EQ(simulation.counts().pair + simulation.counts().wall, 3'141'592U) << engine;
  }
  Scene lossy = squeezed(1e12);
  lossy.effects.collision.restitution = 1.0 - 1e-10;
  Simulation simulation = make_simulation(lossy);
  EXPECT_EQ(run_schedule(simulation).stopped, StopReason::time);
}

TEST(EnginesStandstill, DisksThatNeverLostAnythingHaveNotCooled) {
  Scene scene;
  scene.box = {{0.0, 0.0}, {8.0, 8.0}, {Boundary::periodic, Boundary::periodic}};
  scene.species = {
      species_of(2, 0.5, 1.0, ListedPositions{{{2.0, 4.0}, {4.0, 4.0}}}, ListedVelocities{{{1.0 + 0x1p-16, 0.0}, {1.0, 0.0}}})};
  scene.effects.collision.restitution = 0.5;
  scene.run.collisions = 1;
  Simulation simulation = make_simulation(scene);
  EXPECT_EQ(run_schedule(simulation).stopped, StopReason::collisions);
  EXPECT_NEAR(simulation.time(), 0x1p16, 1e-9);  // a gap of 1 closes at 2^-16
}

TEST(EnginesStandstill, AGasThatShearHeatsWithoutEndEndsTheRun) {
  for (const char* engine : engines_with_effects) {
    Scene scene = gas_scene(16, 0.4, Boundary::periodic);
    scene.effects.collision.rule = CollisionRule::reversal;
    scene.effects.shear = Shear{.rate = 1.0};
    scene.run.time = 1e9;
    Simulation simulation = make_simulation(scene, engine);
    EXPECT_EQ(run_schedule(simulation).stopped, StopReason::overheated) << engine;
  }
}

/// A specular gas heats up too, but the clock goes on: its speed grows as the time.
TEST(EnginesStandstill, AGasThatShearHeatsSteadilyGoesOn) {
  Scene scene = gas_scene(16, 0.4, Boundary::periodic);
  scene.effects.shear = Shear{.rate = 1.0};
  scene.run.time = 1e15;
  scene.run.collisions = 500'000;  // five times twice as many as the first look at the pace
  Simulation simulation = make_simulation(scene);
  EXPECT_EQ(run_schedule(simulation).stopped, StopReason::collisions);
}

/// Disks on a lattice that grow into a jam.
Scene growing_lattice() {
  Scene scene = gas_scene(36, 0.3, Boundary::periodic);
  scene.species.front().positions = SquareLattice{};
  scene.effects.collision.rule = CollisionRule::reversal;
  scene.effects.growth = Growth{.rate = 0.3};
  scene.run.time = 5.0;
  return scene;
}

TEST(EnginesStandstill, EndsTheRunAtTheSameEventHoweverItIsSampled) {
  const Scene scene = growing_lattice();
  Simulation alone = make_simulation(scene);
  EXPECT_EQ(alone.run_until(5.0), StopReason::jammed);
  const auto expect_same_end = [&](const char* how, const Threads& threads, double stop, const RunLimits& limits) {
    Simulation other = make_simulation(scene);
    other.set_threads(threads);
    EXPECT_EQ(other.run_until(stop), StopReason::time) << how;
    EXPECT_EQ(other.run_until(5.0, limits), StopReason::jammed) << how;
    EXPECT_EQ(other.counts().pair, alone.counts().pair) << how;
    EXPECT_EQ(state_hash(other.state()), state_hash(alone.state())) << how;
  };
  RunLimits may_be_stopped;
  may_be_stopped.proceed = [] { return true; };
  expect_same_end("a program that may stop it", {}, 0.0, may_be_stopped);
  expect_same_end("a stop on the way", {}, 1.0, {});
  expect_same_end("two domains", {.domains = 2}, 0.0, {});
  expect_same_end("three domains", {.domains = 3}, 0.5, may_be_stopped);
}

TEST(EnginesStandstill, IsKnownToASimulationThatWasSaved) {
  const Scene scene = growing_lattice();
  Simulation simulation = make_simulation(scene);
  RunLimits limits;
  limits.collisions = 900'000;  // in the block whose end is the end of the run
  EXPECT_EQ(simulation.run_until(5.0, limits), StopReason::collisions);
  std::stringstream saved;
  simulation.save(saved);
  Simulation restored = restore_simulation(scene, saved);
  EXPECT_EQ(simulation.run_until(5.0), StopReason::jammed);
  EXPECT_EQ(restored.run_until(5.0), StopReason::jammed);
  EXPECT_EQ(restored.counts().pair, simulation.counts().pair);
  EXPECT_EQ(state_hash(restored.state()), state_hash(simulation.state()));
}

TEST(EnginesStandstill, BetweenWallsThatCloseInIsTheSameOnSeveralCores) {
  Scene scene = gas_scene(9, 0.15, Boundary::walls);
  scene.species.front().positions = SquareLattice{};
  scene.effects.walls[3].velocity = -0.5;
  scene.run.collisions = 1'000'000'000'000'000;
  Simulation alone = make_simulation(scene), shared = make_simulation(scene);
  shared.set_threads({.domains = 2});
  EXPECT_EQ(run_schedule(alone).stopped, StopReason::jammed);
  EXPECT_EQ(run_schedule(shared).stopped, StopReason::jammed);
  EXPECT_EQ(shared.counts().pair, alone.counts().pair);
  EXPECT_EQ(state_hash(shared.state()), state_hash(alone.state()));
}

/// A schedule goes on for a thousand collisions, to name the disks.
TEST(EnginesStandstill, EndsAScheduleAtTheSameEventHoweverItIsSampled) {
  Scene scene = growing_lattice();
  const auto end = [&](const Threads& threads, const RunHooks& hooks) {
    Simulation simulation = make_simulation(scene);
    simulation.set_threads(threads);
    EXPECT_EQ(run_schedule(simulation, hooks).stopped, StopReason::jammed);
    return std::pair(simulation.counts().pair, state_hash(simulation.state()));
  };
  RunHooks logs, verifies, samples;
  logs.events = [](std::span<const Event>) {};
  verifies.verify_every = 777;
  samples.grids.emplace_back().step = 0.01;
  const auto alone = end({}, {});
  EXPECT_EQ(end({}, logs), alone);
  EXPECT_EQ(end({}, verifies), alone);
  EXPECT_EQ(end({}, samples), alone);
  EXPECT_EQ(end({.domains = 2}, {}), alone);
  EXPECT_EQ(end({.domains = 3}, logs), alone);
  scene.run.sample_every_collisions = 700;
  EXPECT_EQ(end({}, {}), alone);
}

TEST(EnginesStandstill, OfAGasThatHeatsUpEndsAtTheSameEventHoweverItIsSampled) {
  Scene scene = gas_scene(16, 0.4, Boundary::periodic);
  scene.species.front().positions = HexagonalLattice{};
  scene.effects.collision.rule = CollisionRule::reversal;
  scene.effects.shear = Shear{.rate = 1.0};
  scene.run.time = 1e9;
  const auto end = [&](double every, std::optional<std::uint64_t> collisions) {
    Scene sampled = scene;
    sampled.run.sample_every_collisions = collisions;
    Simulation simulation = make_simulation(sampled);
    RunHooks hooks;
    if (every > 0.0) hooks.grids.emplace_back().step = every;
    EXPECT_EQ(run_schedule(simulation, hooks).stopped, StopReason::overheated);
    return std::pair(simulation.counts().pair, state_hash(simulation.state()));
  };
  const auto alone = end(0.0, {});
  EXPECT_EQ(end(2.04737, {}), alone);
  EXPECT_EQ(end(0.0, 100), alone);
  EXPECT_EQ(end(0.0, 1'000), alone);
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

TEST(EnginesStandstill, DisksAtRestHaveTimeForEverything) {
  Scene scene = scene_of_placed(box_of(10.0, 10.0, Boundary::walls), {{{5.0, 5.0}, {0.0, 0.0}}});
  scene.effects.walls[1].oscillation = Oscillation{WaveForm::sine, 0.5, 1.0};
  Simulation simulation = make_simulation(scene);
  EXPECT_EQ(simulation.run_until(2e7), StopReason::time) << "of a wall that vibrates and reaches no disk";
}

TEST(StoppedDisks, ARunThatEndsInTimeNamesNoDisk) {
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
  EXPECT_THAT(refusal<SceneError>([] { (void)parse_scene(overlapping); }), HasSubstr("disks 0 and 1 overlap by 0.25"));
  Scene scene = parse_scene(overlapping, "scene", {"run.accept_overlap=true"});
  Simulation simulation = make_simulation(scene);
  EXPECT_EQ(simulation.run_until(1.0), StopReason::time);
  EXPECT_EQ(simulation.totals().pair, 1U);
  EXPECT_EQ(simulation.state().velocities.col(1), Eigen::Vector2d(1.0, 0.0));
  scene.run.accept_overlap = false;
  EXPECT_THAT(refusal<SceneError>([&] { (void)make_simulation(scene); }), HasSubstr("disks 0 and 1 overlap by 0.25"));
}

}  // namespace
}  // namespace carom::test
