// A schedule that is saved at any of its moments and resumed hands on the same samples, events and blocks, and observables find
// the same to the last bit, as if nothing had happened.

#include "support/refusal.hpp"
#include "support/same_measurements.hpp"
#include "support/scenes.hpp"

#include <carom/observe.hpp>
#include <carom/simulation.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace carom::test {
namespace {

const std::string fluid = R"(
[box]
x = [0.0, 10.0]
y = [0.0, 10.0]
boundary = "periodic"
[[disks]]
count = 60
radius = 0.4
mass = 1.0
positions = "random"
velocities = { temperature = 1.0 }
[collision]
rule = "specular"
[run]
time = 40.0
sample_every = 0.7
equilibrate = { collisions_per_disk = 300 }
[observe]
temperature = true
pressure = true
collision_rate = true
contact_values = true
free_flight = true
speeds = true
velocity_moments = true
radial_distribution = true
structure_factor = true
hexatic = true
voronoi = true
clusters = true
density_profile = true
mean_square_displacement = true
intermediate_scattering = { k = [1.5, 6.3, 9.0] }
overlap = true
non_gaussian = true
van_hove = true
velocity_autocorrelation = true
viscosity = true
heat_conductivity = true
h_function = true
)";

/// What a caller of run_schedule is told, as text.
struct Told {
  std::string log;
  std::vector<Measurement> measured;
  RunResult result;
};

struct Saved {
  std::string simulation, schedule, observables;
};

void append(std::string& log, const char* what, double number) {
  char text[80];
  std::snprintf(text, sizeof text, "%s %a\n", what, number);
  log += text;
}

/// Runs to the end, or is saved at moment `stop_at` and stops there.
Told run_observed(Simulation& simulation, Observation& observation, std::optional<int> stop_at, Saved* saved,
                  std::istream* from) {
  Told told;
  RunHooks hooks;
  hooks.start = [&](const State& state) { append(told.log, "start", state.positions.sum()); };
  hooks.sample = [&](std::uint64_t k, const State& state) {
    append(told.log, "sample", static_cast<double>(k));
    append(told.log, "at", state.positions.sum());
  };
  hooks.events = [&](std::span<const Event> events) {
    for (const Event& event : events) append(told.log, "event", event.time);
  };
  hooks.block = [&](const Progress& progress) { append(told.log, "block", progress.totals.virial); };
  int moments = 0;
  hooks.checkpoint = [&](const SavingMoment& moment) {
    if (!stop_at || ++moments < *stop_at) return;
    std::ostringstream simulation_out, schedule_out, observables_out;
    simulation.save(simulation_out);
    moment.save(schedule_out);
    observation.save(observables_out);
    *saved = {simulation_out.str(), schedule_out.str(), observables_out.str()};
    throw 0;  // as sudden as being killed
  };
  hooks.resume = from;
  observation.attach(hooks);
  try {
    told.result = run_schedule(simulation, hooks);
    told.measured = observation.results();
  } catch (int) {
  }
  return told;
}

class ResumedSchedule : public testing::TestWithParam<int> {};

void expect_the_same_resumed_at(int moment, const Scene& scene) {
  Simulation whole = make_simulation(scene);
  Observation of_whole(whole);
  const Told expected = run_observed(whole, of_whole, {}, nullptr, nullptr);

  Saved saved;
  Simulation killed = make_simulation(scene);
  Observation of_killed(killed);
  const Told before = run_observed(killed, of_killed, moment, &saved, nullptr);
  ASSERT_FALSE(saved.simulation.empty()) << "there are fewer moments than that";

  std::istringstream simulation(saved.simulation), schedule(saved.schedule), observables(saved.observables);
  Simulation restored = restore_simulation(scene, simulation);
  Observation of_restored(restored, observables);
  const Told after = run_observed(restored, of_restored, {}, nullptr, &schedule);

  EXPECT_EQ(before.log + after.log, expected.log);
  EXPECT_EQ(after.result.stopped, expected.result.stopped);
  EXPECT_EQ(after.result.samples, expected.result.samples);
  expect_same_measurements(after.measured, expected.measured);
  for (std::size_t m = 0; m < after.measured.size(); ++m) EXPECT_EQ(after.measured[m].note, expected.measured[m].note);
}

TEST_P(ResumedSchedule, TellsTheSameAsOneThatWasNeverStopped) { expect_the_same_resumed_at(GetParam(), parse_scene(fluid)); }

TEST_P(ResumedSchedule, TheSameBetweenWallsUnderGravity) {
  const Scene scene = parse_scene(R"(
[box]
x = [0.0, 10.0]
y = [0.0, 20.0]
boundary = "walls"
[[disks]]
count = 60
radius = 0.4
mass = 1.0
positions = "random"
velocities = { temperature = 1.0 }
[collision]
rule = "specular"
[gravity]
acceleration = [0.0, -0.1]
[run]
collisions = 9000
sample_every = 1.3
[observe]
pressure = true
wall_fluxes = true
density_profile = true
free_flight = true
)");
  expect_the_same_resumed_at(GetParam(), scene);
}

TEST_P(ResumedSchedule, TheSameWithSamplesInBlocksAndCounted) {
  Scene scene = parse_scene(fluid);
  scene.run.sample_every.reset();
  scene.run.sample_log = SampleLog{.base = 1.3, .per_block = 20, .block = 4.0};
  expect_the_same_resumed_at(GetParam(), scene);
  scene.run.sample_log.reset();
  scene.run.sample_every_collisions = 700;
  expect_the_same_resumed_at(GetParam(), scene);
}

TEST_P(ResumedSchedule, TheSameOfFieldsAndFluxesBesideAThermalWall) {
  // The left wall alone exchanges energy, and momentum along itself. Spins are followed from collision to collision.
  const Scene scene = parse_scene(R"(
[box]
x = [0.0, 10.0]
y = [0.0, 10.0]
boundary = { x = "walls", y = "periodic" }
[[disks]]
count = 60
radius = 0.4
mass = 1.0
positions = "random"
velocities = { temperature = 1.0 }
[collision]
rule = "specular"
roughness = 1.0
[walls]
left = { temperature = 1.5, tangential_velocity = 0.5 }
[run]
time = 40.0
sample_every = 0.7
[observe]
fields = { every = 0.3, cells = [4, 2] }
wall_fluxes = { every = 0.3 }
work = { every = 0.3 }
)");
  expect_the_same_resumed_at(GetParam(), scene);
}

TEST_P(ResumedSchedule, TheSameBehindAWallThatRunsAway) {
  // Fields and profile cover where the wall will be, and count the disks that follow it beyond.
  const Scene scene = parse_scene(R"(
[box]
x = [0.0, 10.0]
y = [0.0, 10.0]
boundary = "walls"
[[disks]]
count = 60
radius = 0.4
mass = 1.0
positions = "random"
velocities = { temperature = 1.0 }
[collision]
rule = "specular"
[walls]
left = { velocity = -0.05 }
right = { mass = 20.0, load = 0.2 }
[run]
time = 40.0
sample_every = 0.7
[observe]
fields = { every = 0.3, cells = [4, 2] }
density_profile = { every = 0.3, axis = "x", bins = 10 }
wall_fluxes = { every = 0.3 }
work = { every = 0.3 }
)");
  expect_the_same_resumed_at(GetParam(), scene);
}

TEST_P(ResumedSchedule, TheSameWhereDragSlowsDisks) {
  // What drag takes is the energy since the start that nothing else explains.
  Scene scene = parse_scene(fluid);
  scene.effects.drag = Drag{.rate = 0.01};
  scene.run.equilibrate.reset();
  scene.observe = {{.name = "work", .every = 0.3}};
  expect_the_same_resumed_at(GetParam(), scene);
}

// The equilibration has about 9,000 collisions and as many other events; then there is a moment every few dozen of either.
INSTANTIATE_TEST_SUITE_P(At, ResumedSchedule, testing::Values(1, 2, 3, 10, 40, 100));

/// A run with a sample and collisions that are written down as text, and its end as it is saved.
struct Ended {
  std::string log;
  State state;
  std::string simulation, schedule;
};

Ended run_to_its_end(const Scene& scene, const std::optional<FixedStep>& step, const Ended* from,
                     std::vector<double>* watched = nullptr) {
  std::istringstream simulation_in(from != nullptr ? from->simulation : ""), schedule_in(from != nullptr ? from->schedule : "");
  Simulation simulation = from != nullptr ? restore_simulation(scene, simulation_in)
                          : step          ? make_simulation(scene, *step)
                                          : make_simulation(scene);
  Ended ended;
  RunHooks hooks;
  if (from != nullptr) hooks.resume = &schedule_in;
  const auto write_down = [&](const char* what, const State& state) {
    append(ended.log, what, state.time);
    for (Eigen::Index i = 0; i < state.positions.cols(); ++i) append(ended.log, "x", state.positions(0, i));
  };
  hooks.sample = [&](std::uint64_t, const State& state) { write_down("sample", state); };
  for (const double grid : {0.05, 0.15})
    hooks.grids.push_back({grid, [&](std::uint64_t, const State& state, const Totals&) { write_down("grid", state); }});
  if (watched != nullptr)
    hooks.grids.push_back({0.013, [=](std::uint64_t, const State& state, const Totals&) { watched->push_back(state.time); }});
  hooks.events = [&](std::span<const Event> events) {
    for (const Event& event : events) append(ended.log, "event", event.time);
  };
  hooks.checkpoint = [&](const SavingMoment& moment) {
    if (!moment.ended) return;
    std::ostringstream simulation_out, schedule_out;
    simulation.save(simulation_out);
    moment.save(schedule_out);
    ended.simulation = simulation_out.str();
    ended.schedule = schedule_out.str();
  };
  const RunResult result = run_schedule(simulation, hooks);
  EXPECT_EQ(result.stopped, StopReason::time);
  EXPECT_EQ(result.samples, last_sample(scene.run) + 1);
  EXPECT_TRUE(step || simulation.time() == *scene.run.time);  // a fixed step is taken at its own product
  ended.state = simulation.state();
  return ended;
}

/// What is thrown where a run is resumed from these bytes; empty where nothing is.
std::string refusal_of(const Scene& scene, const Saved& saved) {
  std::istringstream simulation(saved.simulation), schedule(saved.schedule), observables(saved.observables);
  Simulation restored = restore_simulation(scene, simulation);
  return refusal<std::runtime_error>([&] {
    Observation observation(restored, observables);
    RunHooks hooks;
    hooks.resume = &schedule;
    observation.attach(hooks);
    (void)run_schedule(restored, hooks);
  });
}

TEST(ResumedSchedule, ChangedAndMissingBytesAreFoundBeforeAnyIsUsed) {
  const Scene scene = parse_scene(fluid);
  Simulation killed = make_simulation(scene);
  Observation observation(killed);
  Saved saved;
  (void)run_observed(killed, observation, 2, &saved, nullptr);
  ASSERT_EQ(refusal_of(scene, saved), "");
  for (std::string Saved::*part : {&Saved::schedule, &Saved::observables}) {
    const std::size_t size = (saved.*part).size(), stride = size / 100 + 1;
    const char* sentence = part == &Saved::schedule ? "the schedule cannot go on: " : "the observables cannot be continued: ";
    for (std::size_t at = 0; at < size; at += stride) {
      Saved changed = saved;
      (changed.*part)[at] = static_cast<char>((changed.*part)[at] ^ 0x10);
      EXPECT_EQ(refusal_of(scene, changed).find(sentence), 0U) << "byte " << at << " of " << size;
      Saved shorter = saved;
      (shorter.*part).resize(at);
      EXPECT_EQ(refusal_of(scene, shorter).find(sentence), 0U) << at << " bytes of " << size;
    }
  }
}

TEST(ResumedSchedule, EndsAtANewEndAsIfItHadBeenTheFirst) {
  Scene scene = parse_scene(fluid);
  scene.observe.clear();
  scene.run.equilibrate.reset();
  // 0.3 and 0.7 lie before 3 * 0.1 and 7 * 0.1 as they are in binary, 2.0 and 0.45 beside none.
  for (const double every : {0.1, 0.05, 0.07}) {
    for (const std::optional<FixedStep>& step : {std::optional<FixedStep>{}, std::optional(FixedStep{"guarded", 0.01})}) {
      scene.run.sample_every = every;
      std::string log;
      Ended end;
      for (const double time : {0.3, 0.45, 0.7, 1.2, 2.0}) {
        scene.run.time = time;
        end = run_to_its_end(scene, step, log.empty() ? nullptr : &end);
        log += end.log;
        const Ended whole = run_to_its_end(scene, step, nullptr);
        EXPECT_TRUE(log == whole.log) << every << " " << time;
        EXPECT_TRUE(same_bits(end.state, whole.state)) << every << " " << time;
      }
    }
  }
}

/// It may be killed when the engine has jammed and the files of the end are not there yet.
TEST(ResumedSchedule, NamesTheDisksThatHadJammedBefore) {
  Scene scene = scene_of({{0.0, 0.0}, {2.0, 8.0}, {Boundary::walls, Boundary::walls}},
                         {species_of(3, 0.5, 1.0, ListedPositions{{{1.0, 6.0}, {0.5, 1.0}, {1.5, 1.0}}},
                                     ListedVelocities{{{0.0, 1.0}, {1.0, 0.0}, {0.0, 0.0}}})});
  scene.run.time = 1.0;
  Simulation whole = make_simulation(scene);
  std::stringstream simulation, schedule;
  RunHooks hooks;
  hooks.checkpoint = [&](const SavingMoment& moment) {
    if (!moment.ended) return;
    whole.save(simulation);
    moment.save(schedule);
  };
  const RunResult ended = run_schedule(whole, hooks);
  ASSERT_EQ(ended.stopped_disks, (std::vector<std::int32_t>{1, 2}));
  Simulation resumed = restore_simulation(scene, simulation);
  RunHooks from;
  from.resume = &schedule;
  const RunResult again = run_schedule(resumed, from);
  EXPECT_EQ(again.stopped, StopReason::jammed);
  EXPECT_EQ(again.stopped_disks, ended.stopped_disks);
}

/// A view of the run may be there for one of its parts.
TEST(ResumedSchedule, AGridBehindTheOthersMayComeAndGo) {
  Scene scene = parse_scene(fluid);
  scene.observe.clear();
  scene.run.equilibrate.reset();
  scene.run.time = 2.0;
  const Ended whole = run_to_its_end(scene, {}, nullptr);
  for (const bool first_is_watched : {true, false}) {
    std::vector<double> watched;
    scene.run.time = 0.7;
    const Ended first = run_to_its_end(scene, {}, nullptr, first_is_watched ? &watched : nullptr);
    scene.run.time = 2.0;
    const Ended second = run_to_its_end(scene, {}, &first, first_is_watched ? nullptr : &watched);
    EXPECT_TRUE(first.log + second.log == whole.log);
    EXPECT_EQ(watched.front(), first_is_watched ? 0.0 : 54 * 0.013);  // 53 * 0.013 = 0.689
    EXPECT_EQ(watched.back(), first_is_watched ? 53 * 0.013 : 153 * 0.013);
  }
}

TEST(ResumedSchedule, EndsAtANewEndWithSamplesInBlocks) {
  Scene scene = parse_scene(fluid);
  scene.observe.clear();
  scene.run.equilibrate.reset();
  scene.run.sample_every.reset();
  scene.run.sample_log = SampleLog{.base = 1.3, .per_block = 5, .block = 0.1};
  scene.run.time = 0.3;
  const Ended first = run_to_its_end(scene, {}, nullptr);
  scene.run.time = 1.0;
  const Ended second = run_to_its_end(scene, {}, &first), whole = run_to_its_end(scene, {}, nullptr);
  EXPECT_TRUE(first.log + second.log == whole.log);
  EXPECT_TRUE(same_bits(second.state, whole.state));
}

}  // namespace
}  // namespace carom::test
