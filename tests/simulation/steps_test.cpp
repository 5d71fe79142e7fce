// A simulation led step by step: each step is the next event of the log, limits end a run at the event itself, and none of it
// leaves a trace in the bits.

#include "support/effect_scenes.hpp"
#include "support/engines.hpp"
#include "support/same_events.hpp"
#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <carom/simulation.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace carom::test {
namespace {

/// Walls, obstacles and wells: every kind of event that a log has.
Scene every_kind_of_event() {
  Scene scene = gas_scene(24, 0.2, Boundary::walls);
  scene.effects.square_well = SquareWell{1.3, 0.5};
  scene.species[0].positions = RandomPositions{};
  scene.effects.obstacles = {DiskObstacle{0.5 * scene.box.upper, 0.4}};
  return scene;
}

TEST(Steps, AreTheEventsOfTheLogOneByOne) {
  for (const char* engine : engines_with_effects) {
    SCOPED_TRACE(engine);
    const Ran ran = run(every_kind_of_event(), engine, 3.0);
    Simulation simulation = make_simulation(every_kind_of_event(), engine);
    for (const Event& expected : ran.events) {
      const std::optional<Event> event = simulation.step(3.0);
      ASSERT_TRUE(event);
      ASSERT_TRUE(same_event(*event, expected));
      ASSERT_EQ(simulation.time(), event->time);
    }
    EXPECT_FALSE(simulation.step(3.0)) << "there are no more up to then";
    EXPECT_EQ(simulation.time(), 3.0);
    EXPECT_TRUE(same_bits(simulation.state(), ran.simulation.state()));
    EXPECT_EQ(simulation.counts().events(), ran.events.size());
    EXPECT_GT(simulation.counts().obstacle, 0U);
    EXPECT_GT(simulation.counts().well, 0U);
    EXPECT_TRUE(simulation.take_events().empty()) << "no log was asked for";
  }
}

TEST(Steps, LeaveTheLogComplete) {
  for (const std::string& engine : engine_names()) {
    SCOPED_TRACE(engine);
    const Scene scene = mixture_scene(20, 0.4, Boundary::walls);
    const std::vector<Event> expected = run(scene, engine, 1.5).events;
    Simulation simulation = make_simulation(scene, engine);
    simulation.record_events(true);
    simulation.run_until(0.5);
    for (int k = 0; k < 10; ++k) simulation.step();
    simulation.run_until(1.5);
    const std::vector<Event> log = simulation.take_events();
    ASSERT_EQ(log.size(), expected.size());
    for (std::size_t k = 0; k < log.size(); ++k) ASSERT_TRUE(same_event(log[k], expected[k])) << k;
    EXPECT_TRUE(simulation.take_events().empty());
  }
}

TEST(Steps, TellOfTheKicksOfAThermostat) {
  Scene scene = gas_scene(12, 0.1, Boundary::walls);
  scene.effects.thermostat = Thermostat{1.0, 1.0};
  Simulation once = make_simulation(scene);
  once.run_until(5.0);
  Simulation simulation = make_simulation(scene);
  std::uint64_t kicks = 0;
  while (const std::optional<Event> event = simulation.step(5.0)) {
    if (event->partner != thermostat_event) continue;
    ++kicks;
    EXPECT_EQ(event->time, simulation.time());
    EXPECT_EQ(event->velocity, simulation.state().velocities.col(event->disk));
  }
  EXPECT_GT(kicks, 0U);
  EXPECT_EQ(kicks, once.counts().thermostat);
  EXPECT_TRUE(same_bits(simulation.state(), once.state()));
}

TEST(Steps, EndWhereNothingIsToCome) {
  const Species resting = species_of(4, 0.5, 1.0, SquareLattice{}, AtRest{});
  for (const std::string& engine : engine_names()) {
    Simulation simulation = make_simulation(scene_of(box_of(9.0, 9.0, Boundary::periodic), {resting}), engine);
    EXPECT_FALSE(simulation.step()) << engine;
    EXPECT_EQ(simulation.time(), 0.0);
    EXPECT_FALSE(simulation.step(2.0));
    EXPECT_EQ(simulation.time(), 2.0);
    EXPECT_FALSE(simulation.step(1.0)) << "an earlier time does nothing";
    EXPECT_EQ(simulation.time(), 2.0);
    EXPECT_THROW(simulation.step(std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
  }
}

TEST(Steps, EndWhereTheSimulationCannotGoOn) {
  Scene scene = gas_scene(12, 0.4, Boundary::periodic);
  scene.effects.growth = Growth{.rate = 0.05, .packing_fraction = 0.41};
  Simulation simulation = make_simulation(scene);
  while (simulation.step()) {
  }
  EXPECT_EQ(simulation.run_until(1e6), StopReason::grown);
}

TEST(RunLimits, EndARunAtAnyEvent) {
  for (const char* engine : engines_with_effects) {
    SCOPED_TRACE(engine);
    const Ran whole = run(every_kind_of_event(), engine, 3.0);
    for (const std::uint64_t limit :
         {std::uint64_t{1}, std::uint64_t{2}, std::uint64_t{17}, whole.simulation.counts().events()}) {
      Simulation simulation = make_simulation(every_kind_of_event(), engine);
      EXPECT_EQ(simulation.run_until(1e9, {.events = limit}), StopReason::events);
      EXPECT_EQ(simulation.counts().events(), limit);
      EXPECT_EQ(simulation.time(), whole.events[limit - 1].time);
      EXPECT_EQ(simulation.run_until(1e9, {.events = limit}), StopReason::events) << "it is there already";
      EXPECT_EQ(simulation.counts().events(), limit);
    }
  }
}

TEST(RunLimits, OfTwoTheFirstCounts) {
  const Scene scene = mixture_scene(20, 0.4, Boundary::walls);
  Simulation simulation = make_simulation(scene);
  EXPECT_EQ(simulation.run_until(1e9, {.collisions = 5, .events = 1'000'000}), StopReason::collisions);
  EXPECT_EQ(simulation.run_until(1e9, {.collisions = 1'000'000, .events = simulation.counts().events() + 1}), StopReason::events);
  EXPECT_EQ(simulation.run_until(simulation.time(), {.collisions = 1'000'000, .events = 1'000'000}), StopReason::time);
}

TEST(RunLimits, AConditionEndsARunAtItsEvent) {
  for (const std::string& engine : engine_names()) {
    SCOPED_TRACE(engine);
    const Scene scene = mixture_scene(20, 0.4, Boundary::walls);
    Simulation simulation = make_simulation(scene, engine);
    std::size_t asked = 0;
    std::optional<Event> last;
    const auto top = [&](const Event& event) {
      ++asked;
      last = event;
      EXPECT_EQ(event.time, simulation.time());
      return event.partner == wall_top && event.disk == 3;
    };
    ASSERT_EQ(simulation.run_until(1e3, {.stop_when = top}), StopReason::condition);
    EXPECT_EQ(last->partner, wall_top);
    EXPECT_EQ(last->disk, 3);
    EXPECT_EQ(asked, simulation.counts().events());
    Simulation plain = make_simulation(scene, engine);
    plain.run_until(1e3, {.events = asked});
    EXPECT_TRUE(same_bits(plain.state(), simulation.state()));
    ASSERT_EQ(simulation.run_until(1e3, {.stop_when = top}), StopReason::condition) << "it goes on to the next one";
    EXPECT_GT(asked, plain.counts().events());
  }
}

TEST(RunLimits, AConditionMayLookAndThrow) {
  Simulation simulation = make_simulation(mixture_scene(20, 0.4, Boundary::walls));
  const auto fails = [&](const Event&) -> bool {
    if (simulation.counts().pair == 10) throw std::runtime_error("enough");
    return false;
  };
  EXPECT_THROW(simulation.run_until(1e3, {.stop_when = fails}), std::runtime_error);
  EXPECT_EQ(simulation.counts().pair, 10U);
  EXPECT_EQ(simulation.run_until(1e3, {.collisions = 20}), StopReason::collisions) << "the simulation is as good as before";
}

TEST(RunLimits, FixedStepsKnowCollisionsAlone) {
  Scene scene = gas_scene(16, 0.3, Boundary::walls);
  scene.run.time = 1.0;
  Simulation simulation = make_simulation(scene, FixedStep{"guarded", 0.01});
  EXPECT_THROW(simulation.run_until(1.0, {.events = 10}), std::invalid_argument);
  EXPECT_THROW(simulation.run_until(1.0, {.stop_when = [](const Event&) { return false; }}), std::invalid_argument);
  EXPECT_THROW(simulation.step(), std::logic_error);
  RunHooks hooks;
  hooks.stop_when = [](const Event&) { return false; };
  EXPECT_THROW(run_schedule(simulation, hooks), std::invalid_argument);
  EXPECT_EQ(simulation.time(), 0.0);
}

TEST(RunLimits, AScheduleEndsWhereItsConditionIsMet) {
  Scene scene = mixture_scene(20, 0.4, Boundary::walls);
  scene.run.equilibrate = Run::Equilibrate{.collisions_per_disk = 5.0};
  scene.run.time = 3.0;
  scene.run.sample_every = 0.1;
  const auto run_with = [&](std::uint64_t most, std::vector<Event>& log) {
    Simulation simulation = make_simulation(scene);
    RunHooks hooks;
    if (most > 0)
      hooks.stop_when = [&, left = most](const Event& event) mutable {
        EXPECT_EQ(event.time, simulation.time());
        return --left == 0;
      };
    hooks.events = [&](std::span<const Event> events) { log.insert(log.end(), events.begin(), events.end()); };
    const RunResult result = run_schedule(simulation, hooks);
    return std::pair(result.stopped, simulation.state());
  };
  std::vector<Event> whole, log, endless;
  EXPECT_EQ(run_with(0, whole).first, StopReason::time);
  const auto [stopped, state] = run_with(25, log);
  EXPECT_EQ(stopped, StopReason::condition);
  ASSERT_EQ(log.size(), 25U) << "none of them from before the measured run";
  for (std::size_t k = 0; k < log.size(); ++k) EXPECT_TRUE(same_event(log[k], whole[k]));
  EXPECT_EQ(state.time, log.back().time);
  EXPECT_EQ(run_with(1'000'000, endless).first, StopReason::time);
  EXPECT_EQ(endless.size(), whole.size());
}

}  // namespace
}  // namespace carom::test
