// The library's main door: stopping anywhere, reading the state and logging events change nothing.

#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace carom::test {
namespace {

TEST(Simulation, OneRunOrManyLeaveTheSameBits) {
  for (const Boundary boundary : {Boundary::walls, Boundary::periodic}) {
    const Scene scene = mixture_scene(20, 0.5, boundary);
    Simulation once = make_simulation(scene);
    once.run_until(9.7);
    Simulation often = make_simulation(scene);
    for (int k = 1; k <= 970; ++k) {
      often.run_until_sample(static_cast<std::uint64_t>(k), 0.01);
      if (k % 10 == 0) (void)often.state();
    }
    often.run_until(9.7);
    EXPECT_EQ(often.totals().pair, once.totals().pair);
    EXPECT_EQ(often.totals().virial, once.totals().virial);
    // 970 * 0.01 may be an ulp from 9.7: look where both are exactly.
    once.run_until(10.0);
    often.run_until(10.0);
    EXPECT_TRUE(same_bits(once.state(), often.state()));
  }
}

TEST(Simulation, StoppingAtEveryCollisionLeavesTheSameBits) {
  const Scene scene = mixture_scene(20, 0.5, Boundary::periodic);
  Simulation once = make_simulation(scene);
  EXPECT_EQ(once.run_until(1e9, {.collisions = 500}), StopReason::collisions);
  EXPECT_EQ(once.totals().pair, 500U);
  Simulation often = make_simulation(scene);
  for (std::uint64_t k = 1; k <= 500; ++k) {
    EXPECT_EQ(often.run_until(1e9, {.collisions = k}), StopReason::collisions);
    ASSERT_EQ(often.totals().pair, k);
  }
  EXPECT_TRUE(same_bits(once.state(), often.state()));
}

TEST(Simulation, AnEarlierTimeDoesNothing) {
  Simulation simulation = make_simulation(gas_scene(16, 0.4, Boundary::walls));
  simulation.run_until(2.0);
  const State before = simulation.state();
  EXPECT_EQ(simulation.run_until(1.0), StopReason::time);
  EXPECT_EQ(simulation.run_until(-1.0), StopReason::time);
  EXPECT_EQ(simulation.run_until_sample(3, 0.5), StopReason::time);
  EXPECT_EQ(simulation.run_until(2.0), StopReason::time);
  EXPECT_TRUE(same_bits(simulation.state(), before));
}

TEST(Simulation, StatesAreTheSameInMemoryThatIsUsedAgain) {
  Scene rich = gas_scene(16, 0.2, Boundary::walls);
  rich.effects.collision.roughness = 0.5;
  rich.effects.walls[1] = {.velocity = 0.1};
  State used;
  used.bonds = 7;
  used.shear_displacement = 0.5;
  const auto expect_same = [&](const Simulation& simulation) {
    simulation.state(used);
    const State fresh = simulation.state();
    EXPECT_TRUE(same_bits(used, fresh));
    EXPECT_TRUE(same_bits(used.remainders, fresh.remainders));
    EXPECT_EQ(used.spins, fresh.spins);
    EXPECT_EQ(used.scale, fresh.scale);
    EXPECT_EQ(used.walls.size(), fresh.walls.size());
    EXPECT_EQ(used.bonds, fresh.bonds);
    EXPECT_EQ(used.shear_displacement, fresh.shear_displacement);
  };
  for (const std::string& engine : engine_names()) {
    SCOPED_TRACE(engine);
    if (engine != "fast") expect_same(make_simulation(rich, engine));
    expect_same(make_simulation(gas_scene(16, 0.4, Boundary::walls), engine));
    const double* memory = used.positions.data();
    expect_same(make_simulation(gas_scene(16, 0.3, Boundary::walls), engine));
    EXPECT_EQ(used.positions.data(), memory);
  }
  expect_same(make_simulation(rich, "general"));
  expect_same(make_simulation(gas_scene(16, 0.4, Boundary::walls), FixedStep{"guarded", 0.01}));
}

TEST(Simulation, TimesThatAreNotFiniteAreRefused) {
  Simulation simulation = make_simulation(gas_scene(16, 0.4, Boundary::walls));
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_THROW(simulation.run_until(infinite), std::invalid_argument);
  EXPECT_THROW(simulation.run_until(std::nan("")), std::invalid_argument);
  EXPECT_THROW(simulation.run_until_sample(1, infinite), std::invalid_argument);
  EXPECT_THROW(simulation.run_until_sample(0, std::nan("")), std::invalid_argument);
  EXPECT_THROW(simulation.run_until_sample(10, 1e308), std::invalid_argument);
  EXPECT_EQ(simulation.time(), 0.0);
}

TEST(Simulation, EventsAreCompleteAndInOrderAndTellTheFinalVelocities) {
  Scene scene = mixture_scene(20, 0.4, Boundary::walls);
  scene.effects.collision.rule = CollisionRule::reversal;
  Simulation simulation = make_simulation(scene);
  simulation.record_events(true);
  Eigen::Matrix2Xd velocities = simulation.state().velocities;
  std::vector<Event> log;
  for (int k = 1; k <= 20; ++k) {
    simulation.run_until(0.5 * k);
    for (const Event& event : simulation.take_events()) log.push_back(event);
    EXPECT_TRUE(simulation.take_events().empty());
  }
  const auto walls =
      static_cast<std::uint64_t>(std::count_if(log.begin(), log.end(), [](const Event& e) { return e.partner < 0; }));
  EXPECT_EQ(walls, simulation.totals().wall);
  EXPECT_EQ(log.size() - walls, simulation.totals().pair);
  EXPECT_TRUE(std::is_sorted(log.begin(), log.end(), [](const Event& a, const Event& b) { return a.time < b.time; }));
  for (const Event& event : log) {
    EXPECT_TRUE(event.partner < 0 || event.disk < event.partner);
    EXPECT_LE(std::abs(event.time_remainder), 1.2e-16 * event.time);
    velocities.col(event.disk) = event.velocity;
    if (event.partner >= 0) velocities.col(event.partner) = event.partner_velocity;
  }
  EXPECT_TRUE(same_bits(velocities, simulation.state().velocities));
}

TEST(Simulation, EventsAreNotRecordedUnlessAsked) {
  Simulation simulation = make_simulation(gas_scene(16, 0.4, Boundary::walls));
  simulation.run_until(1.0);
  EXPECT_TRUE(simulation.take_events().empty());
  simulation.record_events(true);
  simulation.run_until(2.0);
  const std::size_t recorded = simulation.take_events().size();
  EXPECT_GT(recorded, 0U);
  simulation.record_events(false);
  simulation.run_until(3.0);
  EXPECT_TRUE(simulation.take_events().empty());
}

TEST(Simulation, ResetClockKeepsTheStateAndForgetsTheTotals) {
  Simulation simulation = make_simulation(gas_scene(16, 0.4, Boundary::periodic));
  simulation.run_until(3.0);
  State before = simulation.state();
  simulation.reset_clock();
  before.time = 0.0;
  EXPECT_TRUE(same_bits(simulation.state(), before));
  EXPECT_EQ(simulation.totals().pair + simulation.totals().wall + simulation.totals().other + simulation.totals().stale, 0U);
  EXPECT_EQ(simulation.totals().virial, 0.0);
  EXPECT_TRUE(simulation.check_invariants().empty());
  simulation.run_until(1.0);
  EXPECT_GT(simulation.totals().pair, 0U);
  EXPECT_EQ(simulation.time(), 1.0);
}

TEST(Simulation, OneDiskBetweenWallsIsATriangleWave) {
  // Dyadic numbers: nothing is rounded. Centre between 0.25 and 0.75, two crossings of that way per period of 1.
  const ListedPositions place{{{0.25, 0.5}}};
  const ListedVelocities velocity{{{1.0, 0.0}}};
  Simulation simulation =
      make_simulation(scene_of(box_of(1.0, 1.0, Boundary::walls), {species_of(1, 0.25, 3.0, place, velocity)}));
  for (const auto& [time, x] : {std::pair{0.125, 0.375}, {0.5, 0.75}, {0.625, 0.625}, {1.25, 0.5}, {1000.125, 0.375}}) {
    simulation.run_until(time);
    EXPECT_EQ(simulation.state().positions(0, 0), x) << time;
    EXPECT_EQ(simulation.state().positions(1, 0), 0.5) << time;
  }
  // 1000 hits of either wall, each with an impulse of 2 m v.
  EXPECT_EQ(simulation.totals().wall, 2000U);
  EXPECT_EQ(simulation.totals().wall_impulse[0], 6000.0);
  EXPECT_EQ(simulation.totals().wall_impulse[1], 6000.0);
  EXPECT_EQ(simulation.totals().wall_impulse[2], 0.0);
}

TEST(Simulation, OneDiskInAPeriodicBoxCountsItsRounds) {
  const ListedPositions place{{{0.5, 0.25}}};
  const ListedVelocities velocity{{{1.0, -0.5}}};
  Simulation simulation =
      make_simulation(scene_of(box_of(1.0, 1.0, Boundary::periodic), {species_of(1, 0.25, 1.0, place, velocity)}));
  simulation.run_until(1000.75);
  const State state = simulation.state();
  EXPECT_EQ(state.positions.col(0), Eigen::Vector2d(0.25, 0.875));
  EXPECT_EQ(state.images(0, 0), 1001);
  EXPECT_EQ(state.images(1, 0), -501);
  EXPECT_EQ(simulation.totals().pair + simulation.totals().wall, 0U);
}

TEST(Simulation, SystemsWithoutEventsStandAtTheTimeAskedFor) {
  const Species resting = species_of(4, 0.5, 1.0, SquareLattice{}, AtRest{});
  for (const Scene& scene : {scene_of(box_of(1.0, 1.0, Boundary::walls), std::vector<Species>{}),
                             scene_of(box_of(9.0, 9.0, Boundary::periodic), {resting})}) {
    for (const std::string& engine : engine_names()) {
      Simulation simulation = make_simulation(scene, engine);
      const State before = simulation.state();
      EXPECT_EQ(simulation.run_until(1e6), StopReason::time);
      EXPECT_EQ(simulation.time(), 1e6);
      EXPECT_TRUE(same_bits(simulation.state().positions, before.positions));
      EXPECT_TRUE(simulation.check_invariants().empty());
      simulation.reset_clock();
      EXPECT_EQ(simulation.time(), 0.0);
    }
  }
}

TEST(Simulation, OnlyNamesOfTheCatalogueChooseAnEngine) {
  const Scene scene = gas_scene(4, 0.1, Boundary::walls);
  EXPECT_EQ(make_simulation(scene).engine(), engine_names().front());
  for (const std::string& name : engine_names()) EXPECT_EQ(make_simulation(scene, name).engine(), name);
  EXPECT_THROW(make_simulation(scene, "abacus"), std::invalid_argument);
}

TEST(Simulation, KeepsRunningAfterBeingMoved) {
  Simulation first = make_simulation(gas_scene(16, 0.4, Boundary::walls));
  first.run_until(1.0);
  Simulation second = std::move(first);
  second.run_until(2.0);
  Simulation twin = make_simulation(gas_scene(16, 0.4, Boundary::walls));
  twin.run_until(2.0);
  EXPECT_TRUE(same_bits(second.state(), twin.state()));
}

}  // namespace
}  // namespace carom::test
