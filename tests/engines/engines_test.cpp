// Every example scene on every engine of the catalogue: the same events in the same order for as long as rounding lets
// two precisions agree, and the same physics after.

#include "support/engines.hpp"
#include "observe/effects_report.hpp"
#include "observe/energy.hpp"
#include "support/scene_files.hpp"

#include <carom/simulation.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace carom::test {
namespace {

/// Errors grow by e for every Lyapunov time: 3.2 times per collision of each disk at reduced density 0.1, and more often the
/// thinner the gas. After as many events as there are disks, two collisions of each, 1e-16 has become less than 1e-12 for most
/// disks and a hundred times that for one which has collided six times; where less than a twentieth is covered, so it has after
/// half as many. That is to be compared with gaps between events of some 1 / events.
/// Eight hits of a single disk on round obstacles, each of which may double or triple an angle, do no more.
std::size_t comparable_events(const Scene& scene) {
  const auto disks = static_cast<std::size_t>(scene.disk_count());
  return std::max<std::size_t>(8, scene.packing_fraction() < 0.05 ? disks / 2 : disks);
}

std::vector<Event> first_events(const Scene& scene, const std::string& engine) {
  const auto running = make_engine(engine, scene);
  const Instant until = scene.run.time ? Instant{*scene.run.time, 0.0} : forever;
  return next_events(*running, comparable_events(scene), until, 100);
}

class EnginesScene : public testing::TestWithParam<std::string> {};

TEST_P(EnginesScene, GivesTheSameEventsOnEveryEngineAndAtHigherPrecision) {
  Scene scene = load_scene(example_path(GetParam()));
  const std::vector<Event> events = first_events(scene, "textbook");
  ASSERT_FALSE(events.empty());
  for (const std::string& engine : engines_covering(scene)) {
    if (engine == "textbook-float") continue;  // 1e-7 is too much to begin with
    const std::vector<Event> other = first_events(scene, engine);
    ASSERT_EQ(other.size(), events.size()) << engine;
    for (std::size_t k = 0; k < events.size(); ++k) {
      ASSERT_EQ(other[k].disk, events[k].disk) << engine << ", event " << k;
      ASSERT_EQ(other[k].partner, events[k].partner) << engine << ", event " << k;
      ASSERT_NEAR(other[k].time, events[k].time, 1e-10 * std::max(1.0, events[k].time)) << engine << ", event " << k;
    }
  }
}

TEST_P(EnginesScene, RunsWithASoundPlanAndItsEnergyAccountedFor) {
  Scene scene = load_scene(example_path(GetParam()));
  scene.run.sample_every.reset();
  scene.run.equilibrate.reset();
  scene.run.collisions = std::min<std::uint64_t>(50'000, scene.run.collisions.value_or(50'000));
  Simulation simulation = make_simulation(scene);
  const auto energies = [&] { return energies_of(scene.box, scene.effects, simulation.disks(), simulation.state()); };
  const Energies before = energies();
  run_schedule(simulation);
  const auto faults = simulation.check_invariants();
  EXPECT_TRUE(faults.empty()) << faults.front();
  const Totals& totals = simulation.totals();
  const double given = effects_report(scene, simulation.disks(), totals, simulation.state()).energy_supplied.value_or(0.0);
  const Energies after = energies();
  // Each collision rounds the energy of two disks a few times: less than 1e-15 of the whole, even were they all the energy and
  // every rounding of one sign.
  const auto events = static_cast<double>(totals.pair + totals.wall + totals.obstacle + totals.well);
  EXPECT_NEAR(after.total() - given, before.total(), std::max(events, 100.0) * 1e-15 * std::max(before.scale(), after.scale()));
}

TEST_P(EnginesScene, RunsOnTheLeanestEngineThatCoversIt) {
  const Scene scene = load_scene(example_path(GetParam()));
  const std::string engine = make_simulation(scene).engine();
  EXPECT_EQ(engine, engines_covering(scene).front());
  EXPECT_EQ(engine == "fast", scene.effects.neutral());
}

TEST_P(EnginesScene, RunsInSinglePrecisionWithoutOverlapBeyondItsRounding) {
  Scene scene = load_scene(example_path(GetParam()));
  scene.run.sample_every.reset();
  scene.run.equilibrate.reset();
  scene.run.collisions = std::min<std::uint64_t>(20'000, scene.run.collisions.value_or(20'000));
  Simulation simulation = make_simulation(scene, "textbook-float");
  run_schedule(simulation);
  EXPECT_TRUE(simulation.state().positions.allFinite());
  EXPECT_TRUE(simulation.check_invariants().empty()) << simulation.check_invariants().front();
}

INSTANTIATE_TEST_SUITE_P(All, EnginesScene, testing::ValuesIn(example_scenes()), [](const auto& scene) { return scene.param; });

}  // namespace
}  // namespace carom::test
