// Every example scene on every engine of the catalogue: the same events in the same order for as long as rounding lets
// two precisions agree, and the same physics after.

#include "observe/mechanics.hpp"
#include "support/scene_files.hpp"

#include <carom/simulation.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace carom::test {
namespace {

/// Errors grow by e for every Lyapunov time: at most 3.2 times per collision of each disk (dilute gas). After two
/// collisions per disk, 1e-16 has become less than 1e-12, to be compared with gaps between events of some 1 / events.
constexpr double collisions_per_disk = 2.0;

std::vector<Event> first_events(const Scene& scene, const std::string& engine, std::size_t count) {
  Simulation simulation = make_simulation(scene, engine);
  simulation.record_events(true);
  std::vector<Event> events;
  RunHooks hooks;
  hooks.events = [&](std::span<const Event> more) { events.insert(events.end(), more.begin(), more.end()); };
  hooks.proceed = [&](const Progress&) { return events.size() < count; };
  run_schedule(simulation, hooks);
  events.resize(std::min(count, events.size()));
  return events;
}

/// The leanest engine that runs the scene.
std::string fastest(const Scene& scene) { return scene.effects.neutral() ? "fast" : "general"; }

class EnginesScene : public testing::TestWithParam<std::string> {};

TEST_P(EnginesScene, GivesTheSameEventsOnTheFastEngineAndAtHigherPrecision) {
  Scene scene = load_scene(example_path(GetParam()));
  scene.run.equilibrate.reset();  // from the start itself, before chaos has had its way
  scene.run.sample_every.reset();
  const auto count = static_cast<std::uint64_t>(std::ceil(collisions_per_disk / 2.0 * static_cast<double>(scene.disk_count())));
  scene.run.collisions = std::min(count, scene.run.collisions.value_or(count));
  const std::vector<Event> events = first_events(scene, "textbook", 1'000'000);
  ASSERT_FALSE(events.empty());
  for (const std::string& engine : {fastest(scene), std::string("textbook-long-double"), std::string("textbook-quad")}) {
    const std::vector<Event> precise = first_events(scene, engine, 1'000'000);
    ASSERT_EQ(precise.size(), events.size()) << engine;
    for (std::size_t k = 0; k < events.size(); ++k) {
      ASSERT_EQ(precise[k].disk, events[k].disk) << engine << ", event " << k;
      ASSERT_EQ(precise[k].partner, events[k].partner) << engine << ", event " << k;
      ASSERT_NEAR(precise[k].time, events[k].time, 1e-9 * std::max(1.0, events[k].time)) << engine << ", event " << k;
    }
  }
}

TEST_P(EnginesScene, RunsOnTheFastEngineWithASoundPlanAndItsEnergyKept) {
  Scene scene = load_scene(example_path(GetParam()));
  scene.run.sample_every.reset();
  scene.run.equilibrate.reset();
  scene.run.collisions = std::min<std::uint64_t>(50'000, scene.run.collisions.value_or(50'000));
  Simulation simulation = make_simulation(scene, fastest(scene));
  const double energy = kinetic_energy(simulation.disks(), simulation.state());
  run_schedule(simulation);
  const auto faults = simulation.check_invariants();
  EXPECT_TRUE(faults.empty()) << faults.front();
  // Each collision rounds the energy of two disks a few times: less than 1e-15 of the whole, even were they all the energy and
  // every rounding of one sign.
  const double given = simulation.totals().kick_energy + simulation.totals().growth_energy;
  EXPECT_NEAR(kinetic_energy(simulation.disks(), simulation.state()), energy + given, 50'000 * 1e-15 * energy);
}

TEST_P(EnginesScene, RunsOnTheFastEngineUnlessToldOtherwise) {
  const Scene scene = load_scene(example_path(GetParam()));
  EXPECT_EQ(make_simulation(scene).engine(), fastest(scene));
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
