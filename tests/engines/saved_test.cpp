// A simulation that was written down and brought back goes on to the same bits, on every example scene and every engine: the same
// events, states and totals, down to the counts of what is bookkeeping. What is written holds nothing that the state does not
// say.

#include "core/archive.hpp"
#include "support/engines.hpp"
#include "support/same_events.hpp"
#include "support/same_totals.hpp"
#include "support/scene_files.hpp"
#include "support/scenes.hpp"

#include <carom/simulation.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <malloc.h>

namespace carom::test {
namespace {

void go_on(Simulation& simulation, double until, std::uint64_t pairs) {
  simulation.record_events(true);
  (void)simulation.run_until(until, {.collisions = simulation.totals().pair + pairs});
}

struct Padded {
  double time;
  std::int32_t disk;
};
struct Whole {
  double time;
  std::int32_t disk, partner;
};
struct Pointing {
  const double* time;
};
static_assert(detail::WithoutPadding<Whole>);
static_assert(!detail::WithoutPadding<Padded> && !detail::WithoutPadding<Pointing>);

struct Stopped {
  Simulation simulation;
  std::string saved;
};
/// Runs on for `time` and is saved, in memory that is full of `rubbish` where nothing has been written.
template <class Make>
Stopped stopped_after(double time, std::uint64_t pairs, int rubbish, Make make) {
  ::mallopt(M_PERTURB, rubbish);
  Simulation simulation = make();
  go_on(simulation, time, pairs);
  (void)simulation.take_events();
  std::ostringstream kept;
  simulation.save(kept);
  ::mallopt(M_PERTURB, 0);
  return {std::move(simulation), kept.str()};
}

/// Runs on for `before`, is saved, and then both go on for `after`.
template <class Make>
void expect_the_same_after(Make make, double before, double after, std::uint64_t pairs) {
  auto [simulation, saved] = stopped_after(before, pairs, 0x55, make);
  EXPECT_TRUE(stopped_after(before, pairs, 0xaa, make).saved == saved) << "the same state is the same bytes";
  std::istringstream kept(saved);
  Simulation restored = restore_simulation(simulation.scene(), kept);
  EXPECT_EQ(restored.engine(), simulation.engine());
  EXPECT_EQ(restored.engine_reason(), simulation.engine_reason());
  EXPECT_EQ(restored.time(), simulation.time());
  for (Simulation* one : {&simulation, &restored}) go_on(*one, after, pairs);
  EXPECT_TRUE(same_bits(simulation.state(), restored.state()));
  EXPECT_EQ(simulation.state().spins, restored.state().spins);
  EXPECT_EQ(simulation.state().scale, restored.state().scale);
  EXPECT_EQ(different_totals(simulation.totals(), restored.totals()), "");
  EXPECT_TRUE(same_events(simulation.take_events(), restored.take_events()));
  EXPECT_EQ(simulation.check_invariants(), restored.check_invariants());
}

class EnginesSaved : public testing::TestWithParam<std::string> {};

TEST_P(EnginesSaved, GoesOnToTheSameBits) {
  Scene scene = load_scene(example_path(GetParam()));
  const double end = scene.run.time.value_or(1e3);
  const auto pairs = std::max<std::uint64_t>(20, 5 * static_cast<std::uint64_t>(scene.disk_count()));
  for (const std::string& engine : engines_covering(scene)) {
    if (engine != "fast" && engine != "general" && engine != "textbook") continue;
    SCOPED_TRACE(engine);
    expect_the_same_after([&] { return make_simulation(scene, engine); }, 0.3 * end, end, pairs);
  }
}

INSTANTIATE_TEST_SUITE_P(All, EnginesSaved, testing::ValuesIn(example_scenes()), [](const auto& scene) { return scene.param; });

TEST(EnginesSaved, InEveryPrecision) {
  const Scene scene = load_scene(example_path("box"));
  for (const std::string& engine : engine_names()) {
    SCOPED_TRACE(engine);
    expect_the_same_after([&] { return make_simulation(scene, engine); }, 1.0, 4.0, 50);
  }
}

TEST(EnginesSaved, WithEveryFixedStepMethodBetweenTwoStepsToo) {
  for (const std::string& method : fixed_step_names()) {
    SCOPED_TRACE(method);
    Scene scene = load_scene(example_path("box"));
    if (method == "soft") scene.effects.collision.rule = CollisionRule::specular;  // the one that springs know
    expect_the_same_after([&] { return make_simulation(scene, FixedStep{method, 0.01}); }, 1.005, 4.0, 1'000'000);
  }
}

}  // namespace
}  // namespace carom::test
