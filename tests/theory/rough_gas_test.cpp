// The ratio of the temperatures of rough inelastic disks that cool.

#include "theory/rough_gas.hpp"
#include "support/block_means.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace carom::test {
namespace {

using theory::gaussian_spin_ratio;
using theory::RoughGas;

TEST(GaussianSpinRatio, IsEquipartitionWithoutLossAndTheRootOfItsBalance) {
  EXPECT_NEAR(gaussian_spin_ratio(1.0, 1.0), 1.0, 1e-12);
  // e = 0.9, beta = 0: a = 1/3, and the balance times 18 is R^2 + 3.79 R - 2 = 0.
  const double R = gaussian_spin_ratio(0.9, 0.0);
  EXPECT_NEAR(R * R + 3.79 * R - 2.0, 0.0, 1e-12);
  EXPECT_NEAR(R, 0.470, 5e-4);
}

/// The mean of the ratio over replicas, after the disks have forgotten that they began without spin.
BlockMeans ratio_of(double restitution, double roughness, int replicas, double relaxed) {
  BlockMeans ratio(1);
  constexpr std::int64_t disks = 200;
  for (int k = 0; k < replicas; ++k) {
    RoughGas gas(disks, restitution, roughness, 100 + static_cast<std::uint64_t>(k));
    gas.collide(static_cast<std::int64_t>(relaxed) * disks / 2);
    ratio.add(gas.spin_ratio());
  }
  return ratio;
}

TEST(RoughGas, KeepsEnergyAndSharesItWherePerfectlyRough) {
  RoughGas gas(300, 1.0, 1.0, 7);
  const auto energy = [&] { return 299.0 * gas.temperature() + 150.0 * gas.spin_temperature(); };
  const double before = energy();
  EXPECT_EQ(gas.spin_temperature(), 0.0);
  gas.collide(9000);
  EXPECT_NEAR(energy(), before, 1e-11 * before);
  const BlockMeans found = ratio_of(1.0, 1.0, 100, 30);
  EXPECT_NEAR(found.mean(), 1.0, 4.0 * found.error() + 0.015) << "the mean of a ratio is larger by terms of 1 / N";
}

TEST(RoughGas, IsGaussianNearPerfectCollisionsAndNotFarFromThem) {
  const BlockMeans near = ratio_of(0.99, 0.8, 100, 40);
  EXPECT_NEAR(near.mean(), gaussian_spin_ratio(0.99, 0.8), 4.0 * near.error() + 0.02 * near.mean());
  EXPECT_LT(near.error(), 0.02);
  const BlockMeans far = ratio_of(0.9, 0.0, 250, 30);
  EXPECT_LT(far.mean(), gaussian_spin_ratio(0.9, 0.0) - 4.0 * far.error());
}

}  // namespace
}  // namespace carom::test
