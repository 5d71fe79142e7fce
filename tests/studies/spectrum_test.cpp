// All Lyapunov exponents of few disks: their symmetries, and what is known of some.

#include "studies/horizon/spectrum.hpp"
#include "studies/horizon/lyapunov.hpp"
#include "support/systems.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace carom::test {
namespace {

LyapunovSpectrum spectrum_of(const Scene& scene, std::uint64_t collisions) {
  const std::optional<LyapunovSpectrum> found =
      measure_spectrum(scene, make_simulation(scene).state(), {.collisions = collisions});
  EXPECT_TRUE(found);
  return found.value_or(LyapunovSpectrum{});
}

TEST(LyapunovSpectrumOf, APeriodicBoxIsPairedAndHasSixZeros) {
  for (const int disks : {4, 9}) {
    const LyapunovSpectrum found = spectrum_of(gas_scene(disks, 0.4, Boundary::periodic), 4000);
    const std::size_t all = 4 * static_cast<std::size_t>(disks);
    ASSERT_EQ(found.exponents.size(), all);
    EXPECT_LT(found.pairing, 1e-6 * found.collision_rate) << disks;
    for (std::size_t k = 0; k < all; ++k)
      EXPECT_NEAR(found.exponents[k] + found.exponents[all - 1 - k], 0.0, 1e-6 * found.collision_rate) << disks << ", " << k;
    // Four conserved numbers (momentum, energy, and the time at which it all began) and the centre of mass. Their vectors grow as
    // the time t at most, which is ln(t) / t as an exponent.
    const double small = 0.01 * found.collision_rate;
    for (std::size_t k = all / 2 - 3; k < all / 2 + 3; ++k) EXPECT_LT(std::abs(found.exponents[k]), small) << disks << ", " << k;
    EXPECT_GT(found.exponents[all / 2 - 4], 5.0 * small) << disks;
    const auto half = found.exponents.begin() + static_cast<std::ptrdiff_t>(all / 2 - 3);
    EXPECT_NEAR(found.entropy, std::accumulate(found.exponents.begin(), half, 0.0), 4.0 * small);
    EXPECT_GT(found.entropy_error.value_or(0.0), 0.0);
  }
}

TEST(LyapunovSpectrumOf, WallsLeavesTwoZeros) {
  // Energy, and the time at which it all began.
  const LyapunovSpectrum found = spectrum_of(gas_scene(4, 0.3, Boundary::walls), 4000);
  ASSERT_EQ(found.exponents.size(), 16U);
  EXPECT_LT(found.pairing, 1e-6 * found.collision_rate);
  EXPECT_LT(std::abs(found.exponents[7]), 0.01 * found.collision_rate);
  EXPECT_GT(found.exponents[6], 0.05 * found.collision_rate);
}

TEST(LyapunovSpectrumOf, DifferentMassesIsPairedToo) {
  const LyapunovSpectrum found = spectrum_of(mixture_scene(6, 0.3, Boundary::periodic), 3000);
  EXPECT_EQ(found.exponents.size(), 24U);
  EXPECT_LT(found.pairing, 1e-6 * found.collision_rate);
}

/// Between two collisions of pairs, disks meet the obstacle many times, and each time differences grow several times.
TEST(LyapunovSpectrumOf, SmallDisksRoundAnObstacleIsPairedToo) {
  const Scene scene = parse_scene(R"(
[box]
x = [-1.0, 1.0]
y = [-1.0, 1.0]
boundary = "periodic"
[[disks]]
count = 4
positions = "random"
radius = 0.02
mass = 1.0
velocities = { temperature = 1.0 }
[collision]
rule = "specular"
[[obstacles]]
disk = { centre = [0.0, 0.0], radius = 0.5 }
[run]
time = 1.0
)",
                                  "obstacle.toml");
  const LyapunovSpectrum found = spectrum_of(scene, 2000);
  ASSERT_EQ(found.exponents.size(), 16U);
  EXPECT_LT(found.pairing, 1e-6 * found.collision_rate);
  EXPECT_LT(std::abs(found.exponents[7]), 0.01 * found.exponents[0]);  // energy, and the time at which it all began
  EXPECT_GT(found.exponents[6], 0.05 * found.exponents[0]);
}

/// Reversible in time, and no Hamiltonian: pairs have the sum 0 in the limit alone.
TEST(LyapunovSpectrumOf, ReversalIsPairedInTheLimit) {
  Scene scene = gas_scene(4, 0.4, Boundary::periodic);
  scene.effects.collision.rule = CollisionRule::reversal;
  const LyapunovSpectrum found = spectrum_of(scene, 40'000);
  double largest = 0.0;
  for (std::size_t k = 0; k < 16; ++k) largest = std::max(largest, std::abs(found.exponents[k] + found.exponents[15 - k]));
  EXPECT_EQ(found.pairing, largest);
  EXPECT_GT(found.pairing, 1e-9 * found.collision_rate);
  EXPECT_LT(found.pairing, 5.0 * std::hypot(found.errors[0].value(), found.errors[15].value()));
}

TEST(LyapunovSpectrumOf, AGasBeginsWithItsLargestExponent) {
  const Scene scene = gas_scene(8, 0.3, Boundary::periodic);
  const State start = make_simulation(scene).state();
  const auto alone = measure_lyapunov(scene, start, measure_event_rates(scene, start), {.collisions = 60'000});
  const LyapunovSpectrum found = spectrum_of(scene, 6000);
  ASSERT_TRUE(alone && alone->per_time_error && found.errors.front());
  EXPECT_NEAR(found.exponents.front(), alone->per_time, 4.0 * std::hypot(*alone->per_time_error, *found.errors.front()));
}

TEST(LyapunovSpectrumOf, DisksThatLoseEnergyIsRefused) {
  Scene scene = gas_scene(4, 0.3, Boundary::periodic);
  scene.effects.collision.restitution = 0.9;
  EXPECT_FALSE(measure_spectrum(scene, make_simulation(scene).state()));
}

}  // namespace
}  // namespace carom::test
