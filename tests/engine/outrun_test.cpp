// A disk that a collision makes faster than its epoch allows, late in that epoch: its line is longer than half the box.

#include "effects/elastic.hpp"
#include "effects/plain_world.hpp"
#include "effects/specular.hpp"
#include "engine/engine_impl.hpp"
#include "support/systems.hpp"

#include <gtest/gtest.h>

namespace carom::test {
namespace {

/// Where the sum of all disks has got to, across periodic edges.
Eigen::Vector2d unwrapped_sum(const Box& box, const State& state) {
  return state.positions.rowwise().sum() + state.images.cast<double>().rowwise().sum().cwiseProduct(box.lengths());
}

template <class Engine>
void expect_sound(const System& start, std::uint64_t collisions) {
  Engine engine(start.box, start.disks, start.state);
  for (std::uint64_t k = 1; k <= collisions; ++k) {
    engine.run_until(forever, k, 1'000'000);
    const auto faults = engine.check_invariants();
    ASSERT_TRUE(faults.empty()) << "collision " << k << ": " << faults.front();
  }
}

TEST(EngineOutrun, CountsImagesInAThinBox) {
  const Box box{{0.0, 0.0}, {1000.0, 3.0}, {Boundary::periodic, Boundary::periodic}};
  const System start = system_of(box, {{{100.0, 1.5}, {1.0, 0.0}}, {{200.0, 0.8}, {0.0, 0.0}}});
  Engine<Elastic<Specular>, EqualDisks, PlainWorld> engine(start.box, start.disks, start.state);
  engine.run_until(Instant{99.5, 0.0}, no_limit, no_limit);
  ASSERT_EQ(engine.totals().pair, 1U);
  EXPECT_NEAR(unwrapped_sum(box, engine.state())[1], 1.5 + 0.8, 1e-9);
}

TEST(EngineOutrun, KeepsHeavyAndLightDisksApart) {
  const Box box{{0.0, 0.0}, {0x1.cfec63c5b38acp+3, 0x1.cfec63c5b38acp+3}, {Boundary::walls, Boundary::periodic}};
  expect_sound<Engine<Elastic<Specular>, AnyDisks, PlainWorld>>(
      system_of(box, {{{0x1.aea74e31f6f88p+1, 0x1.5ffc90714d51ap+3},
                       {0x1.142f5c94c9561p-2, 0x1.ed069c3b0504bp-1},
                       0x1.05c75e94c903dp+0,
                       0x1.34877c54246b7p+9},
                      {{0x1.f8b7a863193cdp+2, 0x1.ce6418d2a86d6p+2}, {-1.0, 0.0}, 0x1.05924cd665658p+0, 0x1.e8f2d9ec0c9e2p+13}}),
      4);
}

TEST(EngineOutrun, KeepsEqualDisksApart) {
  const double half = 0x1.7be587ab0b804p+1;
  const Box box{{-half, half}, {half, 0x1.1cec25c048a03p+3}, {Boundary::periodic, Boundary::walls}};
  expect_sound<Engine<Elastic<Specular>, AnyDisks, PlainWorld>>(
      system_of(box, {{{0x1.19632794d0494p-1, 0x1.8c1eb00e52c08p+2}, {-0x1.1049afd15ccf3p-29, -0x1.4aea4f0392578p-34}, 1.0},
                      {{-0x1.a887c33370054p-1, 0x1.03942269e37eep+2}, {-0x1.7ea9f718220ebp-38, -0x1.076b5aaf1df9p-38}, 1.0},
                      {{0x1.7022f36b485ap+0, 0x1.157400e26024p+2}, {-0x1.74c20c28fb117p-36, 0x1.381fb4fa1a564p-38}, 1.0},
                      {{-0x1.37e6cee8725ecp+1, 0x1.efeac20b02266p+2}, {0.0, -0x1.0742e6f08fa5dp-22}, 1.0}}),
      8);
}

TEST(EngineSlowest, ADiskThatReachesNoWallBeforeTimesOverflowExpectsNothing) {
  // The way to the wall over the speed is more than the largest number, as is the time to leave a neighbourhood.
  const Box box = square_box(1e6, Boundary::walls);
  const System start = system_of(box, {{{5e5, 5e5}, {1e-304, 0.0}}, {{2e5, 2e5}, {0.0, 1e-304}}});
  Engine<Elastic<Specular>, AnyDisks, PlainWorld> engine(start.box, start.disks, start.state);
  EXPECT_TRUE(engine.run_until(Instant{1e9, 0.0}, no_limit, no_limit));
  EXPECT_EQ(engine.totals().wall, 0U);
  EXPECT_TRUE(engine.check_invariants().empty());
}

/// Bytes per disk where n disks crowd in a small part of the box.
double bytes_per_disk(std::int64_t n, double emptiness) {
  System start = system_of(gas_scene(n, 0.5, Boundary::periodic));
  start.box.upper *= emptiness;
  const Engine<Elastic<Specular>, EqualDisks, PlainWorld> engine(start.box, start.disks, start.state);
  return static_cast<double>(engine.bytes()) / static_cast<double>(n);
}

TEST(EngineCluster, TakesNoMoreMemoryInAVeryWideBox) {
  // At most what a gas takes, with a block of cells for every other disk instead of every fourth: 64 bytes more, and lists as
  // long again.
  for (const double emptiness : {3.0, 30.0, 1000.0})
    EXPECT_LT(bytes_per_disk(4096, emptiness), bytes_per_disk(4096, 1.0) + 200.0) << emptiness;
}

}  // namespace
}  // namespace carom::test
