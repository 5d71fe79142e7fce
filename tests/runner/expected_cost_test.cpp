// The expected cost of a run: where its trial reaches the end, the counts are those of the run.

#include "runner/expected_cost.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace carom::test {
namespace {

Scene example_scene(const std::string& name, const std::vector<std::string>& overrides) {
  return load_scene(CAROM_SOURCE_DIR "/docs/scenes/" + name + ".toml", overrides);
}

std::size_t logged_by(const Scene& scene) {
  Simulation simulation = make_simulation(scene);
  RunHooks hooks;
  std::size_t events = 0;
  hooks.events = [&](std::span<const Event> some) { events += some.size(); };
  run_schedule(simulation, hooks);
  return events;
}

TEST(ExpectedCost, KnowsHowManyEventsALogHas) {
  for (const std::string name : {"sinai", "box", "stepped", "thermostat"}) {
    const Scene scene = example_scene(name, {"run.time=0.5"});
    const ExpectedCost cost = Trial(scene, "auto").run();
    ASSERT_TRUE(cost.whole) << name;
    EXPECT_EQ(cost.logged, static_cast<double>(logged_by(scene))) << name;
  }
}

/// Where the trial ends before the run, it has as many events per time as its trial had.
TEST(ExpectedCost, ExtrapolatesTheEventsOfALog) {
  const Scene scene = example_scene("sinai", {"run.time=1e9", "run.sample_every=1e9"});
  const ExpectedCost cost = Trial(scene, "auto").run();
  ASSERT_FALSE(cost.whole);
  ASSERT_TRUE(cost.logged);
  const Scene shorter = example_scene("sinai", {"run.time=1e4", "run.sample_every=1e4"});
  EXPECT_NEAR(*cost.logged / 1e9, static_cast<double>(logged_by(shorter)) / 1e4, 0.05 * *cost.logged / 1e9);
}

}  // namespace
}  // namespace carom::test
