// Large systems on the fast engine: what only many disks or many collisions could show. Minutes, so labelled slow.

#include "neighbours/disks_at_rest.hpp"
#include "observe/mechanics.hpp"
#include "support/energy_drift.hpp"
#include "support/engines.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace carom::test {
namespace {

/// At contact the distance is off by 16 u (|r| + sigma) from the formula (docs/numerics.md), with |r| a few diameters where lists
/// are; by u times the ways of both lines since the epoch, four spacings; and by the rounding of the time, as much: 1e-14 in all.
constexpr double overlap = 1e-14;

void expect_laws(const System& system, std::uint64_t collisions) {
  const auto engine = make_engine("fast", system);
  const double energy = kinetic_energy(system.disks, system.state);
  for (std::uint64_t k = 1; k <= 10; ++k) {
    engine->run_until(forever, k * collisions / 10, no_limit);
    const State state = engine->state();
    EXPECT_LE(deepest_overlap(system.box, system.disks.radius, state.positions, state.remainders).relative, overlap);
    EXPECT_NEAR(kinetic_energy(system.disks, state) / energy, 1.0, energy_drift(collisions, system.disks.count()));
  }
  EXPECT_EQ(engine->totals().pair, collisions);
  const auto faults = engine->check_invariants();
  EXPECT_TRUE(faults.empty()) << faults.front();
}

TEST(SlowLargeSystem, AHundredThousandDisksKeepTheLawsOverTenMillionCollisions) {
  expect_laws(system_of(gas_scene(102'400, 0.7, Boundary::periodic)), 10'000'000);
  expect_laws(system_of(gas_scene(102'400, 0.2, Boundary::walls)), 10'000'000);
}

TEST(SlowLargeSystem, AMillionDisksKeepTheLaws) {
  expect_laws(system_of(gas_scene(1'000'000, 0.6, Boundary::periodic)), 10'000'000);
}

TEST(SlowLargeSystem, AMixtureOfAHundredThousandKeepsTheLaws) {
  expect_laws(system_of(mixture_scene(102'400, 0.5, Boundary::periodic)), 10'000'000);
}

TEST(SlowLongRun, AHundredDisksKeepTheLawsOverThirtyMillionCollisions) {
  expect_laws(system_of(gas_scene(100, 0.5, Boundary::periodic)), 30'000'000);
}

}  // namespace
}  // namespace carom::test
