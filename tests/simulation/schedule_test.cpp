// The schedule: samples where they belong, hooks in order, ends that are exact, and no trace of any of it in the bits.

#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace carom::test {
namespace {

/// Disks that fly side by side and never meet.
Scene parallel_scene(Boundary boundary) {
  const ListedPositions places{{{2.0, 2.0}, {2.0, 5.0}, {5.0, 8.0}}};
  const ListedVelocities same{{{1.0, 0.0}, {1.0, 0.0}, {1.0, 0.0}}};
  return scene_of(box_of(10.0, 10.0, boundary), {species_of(3, 0.5, 1.0, places, same)});
}

Scene resting_scene() {
  Scene scene = parallel_scene(Boundary::periodic);
  scene.species.front().velocities = AtRest{};
  return scene;
}

Scene lone_disk_scene() {
  const ListedVelocities one{{{1.0, 0.3}}};
  return scene_of(box_of(10.0, 10.0, Boundary::walls), {species_of(1, 0.5, 1.0, RandomPositions{}, one)});
}

Scene timed(Scene scene, double time, std::optional<double> sample_every = {}) {
  scene.run.time = time;
  scene.run.sample_every = sample_every;
  return scene;
}

Scene counted(Scene scene, std::uint64_t collisions, std::optional<double> sample_every = {}) {
  scene.run.collisions = collisions;
  scene.run.sample_every = sample_every;
  return scene;
}

State final_state(const Scene& scene, const RunHooks& hooks = {}) {
  Simulation simulation = make_simulation(scene);
  run_schedule(simulation, hooks);
  return simulation.state();
}

/// 10^k as an integer
std::uint64_t power(int k) { return k == 0 ? 1 : 10 * power(k - 1); }

RC_GTEST_PROP(PropertySchedule, LastSampleIsTheFloorOfTheDecimalQuotient, ()) {
  const int p = *rc::gen::inRange(0, 7);
  const int q = *rc::gen::inRange(0, 7);
  const auto a = *rc::gen::inRange<std::uint64_t>(0, 1'000'000);
  const auto b = *rc::gen::inRange<std::uint64_t>(1, 100'000);
  Run run;
  run.time = std::stod(std::to_string(a) + "e-" + std::to_string(p));
  run.sample_every = std::stod(std::to_string(b) + "e-" + std::to_string(q));
  RC_ASSERT(last_sample(run) == a * power(q) / (b * power(p)));
}

TEST(Schedule, LastSampleCountsBothEnds) {
  const auto last = [](double time, double every) { return last_sample(timed({}, time, every).run); };
  EXPECT_EQ(last(0.3, 0.1), 3U);
  EXPECT_EQ(last(5.0, 0.001), 5000U);
  EXPECT_EQ(last(0.7, 0.1), 7U);
  EXPECT_EQ(last(1.0, 0.3), 3U);
  EXPECT_EQ(last(0.0, 0.1), 0U);
  EXPECT_EQ(last(0.05, 0.1), 0U);
  EXPECT_EQ(last(1e6, 1e-6), 1'000'000'000'000U);
  EXPECT_EQ(last(0.3, std::nextafter(0.1, 1.0)), 3U);  // the same decimals to 15 digits
  EXPECT_EQ(last(0.3, 0.1000001), 2U);
  EXPECT_EQ(last(1e300, 1e-300), 1ULL << 53);  // as far as a grid can count
}

TEST(Schedule, SamplesAreTheStatesAtTheProducts) {
  const Scene scene = timed(gas_scene(16, 0.4, Boundary::periodic), 3.0, 0.1);
  Simulation simulation = make_simulation(scene);
  Simulation twin = make_simulation(scene);
  std::uint64_t next = 0;
  RunHooks hooks;
  hooks.sample = [&](std::uint64_t k, const State& state) {
    EXPECT_EQ(k, next++);
    EXPECT_NEAR(state.time, 0.1 * static_cast<double>(k), 1e-15 * static_cast<double>(k));
    twin.run_until_sample(k, 0.1);
    EXPECT_TRUE(same_bits(state, twin.state())) << k;
  };
  const RunResult result = run_schedule(simulation, hooks);
  EXPECT_EQ(next, 31U);
  EXPECT_EQ(result.samples, 31U);
  EXPECT_EQ(result.stopped, StopReason::time);
  EXPECT_EQ(simulation.time(), 3.0);
}

TEST(Schedule, EndsOnManyGridsAfterManyEpochs) {
  // Every engine rounds its own clock: none may wait for a grid time that it already stands at.
  for (const std::string& engine : engine_names()) {
    for (const double every : {0.1, 0.07, 1.0 / 3.0, 0.013}) {
      const Scene scene = timed(gas_scene(9, 0.3, Boundary::walls), 30.0, every);
      Simulation simulation = make_simulation(scene, engine);
      const RunResult result = run_schedule(simulation);
      EXPECT_EQ(result.stopped, StopReason::time) << engine << " " << every;
      EXPECT_EQ(result.samples, last_sample(scene.run) + 1) << engine << " " << every;
      EXPECT_NEAR(simulation.time(), 30.0, engine == "textbook-float" ? 1e-5 : 1e-13) << engine << " " << every;
    }
  }
}

TEST(Schedule, SamplingAndHooksLeaveNoTraceInTheBits) {
  for (const Boundary boundary : {Boundary::walls, Boundary::periodic}) {
    for (const bool equilibrate : {false, true}) {
      Scene scene = mixture_scene(20, 0.4, boundary);
      if (equilibrate) scene.run.equilibrate = {.collisions_per_disk = 3.0, .time = {}};
      const State expected = final_state(timed(scene, 7.3));
      for (const double every : {7.3, 0.1, 0.037, 100.0, 1e-3})
        EXPECT_TRUE(same_bits(final_state(timed(scene, 7.3, every)), expected)) << every;
      RunHooks hooks;
      hooks.start = [](const State&) {};
      hooks.sample = [](std::uint64_t, const State&) {};
      hooks.events = [](std::span<const Event>) {};
      hooks.block = [](const Progress&) {};
      hooks.proceed = [](const Progress&) { return true; };
      EXPECT_TRUE(same_bits(final_state(timed(scene, 7.3, 0.01), hooks), expected));
    }
  }
}

TEST(Schedule, CollisionLimitIsExactAndLeavesTheSameBits) {
  const Scene scene = mixture_scene(20, 0.4, Boundary::periodic);
  for (const std::uint64_t limit : {0U, 1U, 15U, 16U, 17U, 1000U}) {
    std::optional<State> expected;
    for (const std::optional<double> every : {std::optional<double>(), std::optional<double>(0.01), std::optional<double>(1.0)}) {
      Simulation simulation = make_simulation(counted(scene, limit, every));
      const RunResult result = run_schedule(simulation);
      EXPECT_EQ(result.stopped, StopReason::collisions);
      EXPECT_EQ(simulation.totals().pair, limit);
      const std::uint64_t samples = !every ? 0 : static_cast<std::uint64_t>(simulation.time() / *every) + 1;
      EXPECT_EQ(result.samples, samples) << limit;
      EXPECT_TRUE(!expected || same_bits(simulation.state(), *expected)) << limit;
      expected = simulation.state();
    }
  }
}

TEST(Schedule, TheFirstLimitEndsARun) {
  Scene scene = counted(timed(gas_scene(16, 0.4, Boundary::periodic), 1e-3, 1e-4), 1000000);
  Simulation short_run = make_simulation(scene);
  EXPECT_EQ(run_schedule(short_run).stopped, StopReason::time);
  scene = counted(timed(scene, 1e9), 100);
  Simulation counted_run = make_simulation(scene);
  EXPECT_EQ(run_schedule(counted_run).stopped, StopReason::collisions);
  EXPECT_EQ(counted_run.totals().pair, 100U);
}

TEST(Schedule, RecordsNothingAfterAHookHasThrown) {
  Scene scene = gas_scene(40, 0.5, Boundary::periodic);
  scene.run.time = 10.0;
  Simulation simulation = make_simulation(scene);
  RunHooks hooks;
  hooks.events = [](std::span<const Event>) { throw std::runtime_error("no more"); };
  EXPECT_THROW(run_schedule(simulation, hooks), std::runtime_error);
  simulation.run_until(simulation.time() + 1.0);
  EXPECT_TRUE(simulation.take_events().empty());
}

TEST(Schedule, HooksComeInOrderAndEventsBetweenTheirSamples) {
  Scene scene = timed(gas_scene(16, 0.4, Boundary::walls), 5.0, 0.25);
  scene.run.equilibrate = {.collisions_per_disk = {}, .time = 1.0};
  Simulation simulation = make_simulation(scene);
  RunHooks hooks;
  bool started = false;
  double sampled = -1.0;
  double last_event = 0.0;
  std::uint64_t pairs = 0;
  std::uint64_t walls = 0;
  std::uint64_t blocks = 0;
  hooks.start = [&](const State& state) {
    EXPECT_FALSE(started);
    EXPECT_EQ(state.time, 0.0);
    started = true;
  };
  hooks.sample = [&](std::uint64_t, const State& state) {
    EXPECT_TRUE(started);
    EXPECT_LE(last_event, state.time);
    sampled = state.time;
  };
  hooks.events = [&](std::span<const Event> events) {
    EXPECT_FALSE(events.empty());
    for (const Event& event : events) {
      EXPECT_GE(event.time, last_event);
      EXPECT_GE(event.time, sampled);
      last_event = event.time;
      ++(event.partner < 0 ? walls : pairs);
    }
  };
  hooks.block = [&](const Progress& progress) {
    EXPECT_FALSE(progress.equilibrating);
    EXPECT_EQ(progress.totals.pair, 16 * ++blocks);
    EXPECT_EQ(progress.time, last_event);
  };
  EXPECT_EQ(run_schedule(simulation, hooks).stopped, StopReason::time);
  EXPECT_EQ(pairs, simulation.totals().pair);
  EXPECT_EQ(walls, simulation.totals().wall);
  EXPECT_EQ(blocks, pairs / 16);
  EXPECT_GT(blocks, 2U);
}

TEST(Schedule, EquilibrationResetsClockAndTotalsAndGoesOnFromItsState) {
  Scene scene = timed(gas_scene(16, 0.4, Boundary::periodic), 0.0, 1.0);
  Simulation by_hand = make_simulation(scene);
  by_hand.run_until(2.0);
  scene.run.equilibrate = {.collisions_per_disk = {}, .time = 2.0};
  Simulation by_time = make_simulation(scene);
  run_schedule(by_time);
  EXPECT_EQ(by_time.time(), 0.0);
  EXPECT_EQ(by_time.totals().pair, 0U);
  EXPECT_EQ(by_time.totals().virial, 0.0);
  EXPECT_TRUE(same_bits(by_time.state().positions, by_hand.state().positions));
  EXPECT_TRUE(same_bits(by_time.state().velocities, by_hand.state().velocities));

  // 2.5 collisions per disk of 16 disks are 20 collisions of two.
  Simulation counted_by_hand = make_simulation(scene);
  counted_by_hand.run_until(1e9, {.collisions = 20});
  scene.run.equilibrate = {.collisions_per_disk = 2.5, .time = {}};
  Simulation by_count = make_simulation(scene);
  run_schedule(by_count);
  EXPECT_EQ(by_count.totals().pair, 0U);
  EXPECT_TRUE(same_bits(by_count.state().positions, counted_by_hand.state().positions));
}

TEST(Schedule, NoEquilibrationAtAllIsTheSameAsNone) {
  Scene scene = timed(gas_scene(16, 0.4, Boundary::periodic), 3.0);
  const State expected = final_state(scene);
  scene.run.equilibrate = {.collisions_per_disk = 0.0, .time = {}};
  EXPECT_TRUE(same_bits(final_state(scene), expected));
  scene.run.equilibrate = {.collisions_per_disk = {}, .time = 0.0};
  EXPECT_TRUE(same_bits(final_state(scene), expected));
}

TEST(Schedule, WhereNothingWillCollideACountedRunEndsAfterItsFirstSample) {
  for (const std::optional<double> every : {std::optional<double>(), std::optional<double>(0.1)}) {
    Simulation simulation = make_simulation(counted(resting_scene(), 10, every));
    const RunResult result = run_schedule(simulation);
    EXPECT_EQ(result.stopped, StopReason::no_collisions);
    EXPECT_EQ(result.samples, every ? 1U : 0U);
  }
}

TEST(Schedule, EquilibrationThatWaitsForCollisionsInVainEndsTheRun) {
  Scene scene = timed(resting_scene(), 1.0, 0.1);
  scene.run.equilibrate = {.collisions_per_disk = 1.0, .time = {}};
  Simulation simulation = make_simulation(scene);
  const RunResult result = run_schedule(simulation);
  EXPECT_EQ(result.stopped, StopReason::no_collisions);
  EXPECT_EQ(result.samples, 0U);
}

TEST(Schedule, ATimedRunOfDisksThatNeverMeetSamplesToItsEnd) {
  for (const Scene& scene : {resting_scene(), lone_disk_scene(), parallel_scene(Boundary::periodic),
                             scene_of(box_of(1.0, 1.0, Boundary::periodic), std::vector<Species>{})}) {
    Simulation simulation = make_simulation(timed(scene, 3.0, 0.1));
    const RunResult result = run_schedule(simulation);
    EXPECT_EQ(result.stopped, StopReason::time);
    EXPECT_EQ(result.samples, 31U);
    EXPECT_EQ(simulation.time(), 3.0);
    EXPECT_EQ(simulation.totals().pair, 0U);
  }
}

TEST(Schedule, ARunOfNoTimeIsOneSample) {
  Simulation simulation = make_simulation(timed(gas_scene(16, 0.4, Boundary::walls), 0.0, 0.1));
  const State before = simulation.state();
  EXPECT_EQ(run_schedule(simulation).samples, 1U);
  EXPECT_TRUE(same_bits(simulation.state(), before));
}

// Without an answer to `proceed` each of these would take days.

TEST(Schedule, ProceedIsHeardHoweverFineTheSampling) {
  for (const std::optional<double> every : {std::optional<double>(), std::optional<double>(1e-3), std::optional<double>(1e8)}) {
    for (const Scene& scene : {gas_scene(16, 0.4, Boundary::periodic), parallel_scene(Boundary::periodic)}) {
      Simulation simulation = make_simulation(timed(scene, 1e9, every));
      RunHooks hooks;
      hooks.proceed = [](const Progress&) { return false; };
      EXPECT_EQ(run_schedule(simulation, hooks).stopped, StopReason::interrupted);
      EXPECT_LT(simulation.time(), 1e9);
    }
  }
}

TEST(Schedule, ProceedIsHeardWhileEquilibrating) {
  Scene scene = timed(gas_scene(16, 0.4, Boundary::periodic), 1.0, 0.1);
  scene.run.equilibrate = {.collisions_per_disk = {}, .time = 1e9};
  Simulation simulation = make_simulation(scene);
  RunHooks hooks;
  hooks.proceed = [](const Progress& progress) {
    EXPECT_TRUE(progress.equilibrating);
    return false;
  };
  const RunResult result = run_schedule(simulation, hooks);
  EXPECT_EQ(result.stopped, StopReason::interrupted);
  EXPECT_EQ(result.samples, 0U);
}

TEST(Schedule, ProceedIsHeardWhileACountedRunWaitsForCollisions) {
  Simulation simulation = make_simulation(counted(parallel_scene(Boundary::periodic), 10, 1.0));
  RunHooks hooks;
  hooks.proceed = [](const Progress&) { return false; };
  EXPECT_EQ(run_schedule(simulation, hooks).stopped, StopReason::interrupted);
}

}  // namespace
}  // namespace carom::test
