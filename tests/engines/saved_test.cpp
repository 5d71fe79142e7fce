// A simulation that was written down and brought back goes on to the same bits, on every example scene and every engine: the same
// events, states and totals, down to the counts of what is bookkeeping. What is written holds nothing that the state does not
// say.

#include "core/archive.hpp"
#include "support/engines.hpp"
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

void expect_same_totals(const Totals& a, const Totals& b) {
  EXPECT_EQ(a.pair, b.pair);
  EXPECT_EQ(a.wall, b.wall);
  EXPECT_EQ(a.other, b.other) << "bookkeeping";
  EXPECT_EQ(a.stale, b.stale) << "bookkeeping";
  EXPECT_EQ(a.obstacle, b.obstacle);
  EXPECT_EQ(a.well, b.well);
  EXPECT_EQ(a.thermostat, b.thermostat);
  EXPECT_EQ(a.virial, b.virial);
  EXPECT_EQ(a.wall_impulse, b.wall_impulse);
  EXPECT_EQ(a.wall_shear, b.wall_shear);
  EXPECT_EQ(a.wall_energy, b.wall_energy);
  EXPECT_EQ(a.dissipated, b.dissipated);
  EXPECT_EQ(a.thermostat_energy, b.thermostat_energy);
  EXPECT_EQ(a.growth_energy, b.growth_energy);
  EXPECT_EQ(a.shear_energy, b.shear_energy);
  EXPECT_EQ(a.virial_yx, b.virial_yx);
  EXPECT_EQ(a.obstacle_impulse, b.obstacle_impulse);
  EXPECT_EQ(a.numerics.epochs, b.numerics.epochs);
  EXPECT_EQ(a.numerics.list_rebuilds, b.numerics.list_rebuilds);
}

void expect_same_events(const std::vector<Event>& a, const std::vector<Event>& b) {
  ASSERT_EQ(a.size(), b.size());
  const auto differ = [](const Event& x, const Event& y) {
    return x.time != y.time || x.time_remainder != y.time_remainder || x.disk != y.disk || x.partner != y.partner ||
           x.velocity != y.velocity || x.partner_velocity != y.partner_velocity;
  };
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_FALSE(differ(a[i], b[i])) << "event " << i << " at time " << a[i].time;
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
  expect_same_totals(simulation.totals(), restored.totals());
  expect_same_events(simulation.take_events(), restored.take_events());
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
