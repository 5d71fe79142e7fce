// Start velocities: temperatures met, momentum removed where it is kept, and the distributions that were asked for.
// Statistical bounds are 5 standard errors: one test in 2e6 fails by chance, and seeds are fixed.

#include "observe/mechanics.hpp"
#include "simulation/start.hpp"
#include "support/refusal.hpp"
#include "support/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace carom::test {
namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

const Box walled = box_of(1000.0, 1000.0, Boundary::walls);
const Box periodic = box_of(1000.0, 1000.0, Boundary::periodic);

/// On a lattice, so that positions take no time.
Species moving(std::int64_t count, double mass, Velocities velocities) {
  return species_of(count, 0.01, mass, SquareLattice{}, std::move(velocities));
}

struct Drawn {
  Scene scene;
  Start start;

  [[nodiscard]] const Eigen::Matrix2Xd& v() const { return start.state.velocities; }
  [[nodiscard]] double temperature() const { return kinetic_temperature(scene.box, start.disks, start.state); }
  [[nodiscard]] double momentum() const { return total_momentum(start.disks, start.state).norm(); }
  [[nodiscard]] double mass() const {
    double sum = 0.0;
    for (const double m : start.disks.mass) sum += m;
    return sum;
  }
  /// sum of m |v|: what rounding of the momentum is relative to
  [[nodiscard]] double momentum_scale() const {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < v().cols(); ++i) sum += start.disks.mass[static_cast<std::size_t>(i)] * v().col(i).norm();
    return sum;
  }
  /// of disks [first, first + count)
  [[nodiscard]] double kinetic(Eigen::Index first, Eigen::Index count) const {
    double sum = 0.0;
    for (Eigen::Index i = first; i < first + count; ++i)
      sum += 0.5 * start.disks.mass[static_cast<std::size_t>(i)] * v().col(i).squaredNorm();
    return sum;
  }
};

Drawn draw(const Box& box, std::vector<Species> species, std::uint64_t seed = 1, bool keep_momentum = false) {
  Drawn drawn{scene_of(box, std::move(species), seed), {}};
  drawn.scene.run.keep_momentum = keep_momentum;
  drawn.start = draw_start(drawn.scene);
  return drawn;
}

// A sum of N terms of one sign, added one by one, is off by less than N eps.

TEST(Velocities, TemperatureIsMetExactlyBetweenWalls) {
  for (const std::int64_t n : {1, 2, 3, 10, 1000}) {
    const Drawn drawn = draw(walled, {moving(n, 2.5, MaxwellVelocities{1.7})});
    EXPECT_NEAR(drawn.kinetic(0, n), 1.7 * static_cast<double>(n), 2.0 * 1.7 * static_cast<double>(n * n) * eps + 4 * eps);
    EXPECT_NEAR(drawn.temperature(), 1.7, 1.7 * static_cast<double>(n + 4) * eps);
  }
}

TEST(Velocities, TemperatureIsMetExactlyWithoutMomentumInAPeriodicBox) {
  for (const std::int64_t n : {2, 3, 10, 1000}) {
    const Drawn drawn = draw(periodic, {moving(n, 2.5, MaxwellVelocities{1.7})});
    EXPECT_NEAR(drawn.kinetic(0, n), 1.7 * static_cast<double>(n - 1), 4.0 * 1.7 * static_cast<double>(n * n) * eps);
    EXPECT_NEAR(drawn.temperature(), 1.7, 1.7 * static_cast<double>(n + 4) * eps);
    EXPECT_LE(drawn.momentum(), static_cast<double>(n) * eps * drawn.momentum_scale());
  }
}

TEST(Velocities, OneDiskAloneInAPeriodicBoxRests) {
  const Drawn drawn = draw(periodic, {moving(1, 2.5, MaxwellVelocities{1.7})});
  EXPECT_EQ(drawn.v().norm(), 0.0);
  EXPECT_EQ(drawn.temperature(), 0.0);
}

TEST(Velocities, SpeciesAtOneTemperatureStartInEquipartition) {
  // kT (1 - m/M) per disk at zero momentum; the exponents of mass ratio and number on which it settles fast.
  const Drawn drawn = draw(periodic, {moving(100, 1.0, MaxwellVelocities{2.0}), moving(50, 30.0, MaxwellVelocities{2.0})});
  const double mass = drawn.mass();
  EXPECT_NEAR(drawn.kinetic(0, 100), 2.0 * (100.0 - 100.0 / mass), 1e-11);
  EXPECT_NEAR(drawn.kinetic(100, 50), 2.0 * (50.0 - 1500.0 / mass), 1e-11);
  EXPECT_NEAR(drawn.temperature(), 2.0, 1e-12);
  EXPECT_LE(drawn.momentum(), 150 * eps * drawn.momentum_scale());
}

TEST(Velocities, SpeciesAtTwoTemperaturesMeetBoth) {
  const Drawn hot_and_cold = draw(periodic, {moving(100, 1.0, MaxwellVelocities{5.0}), moving(100, 4.0, MaxwellVelocities{0.1})});
  EXPECT_NEAR(hot_and_cold.kinetic(0, 100), 5.0 * (100.0 - 0.2), 1e-10);
  EXPECT_NEAR(hot_and_cold.kinetic(100, 100), 0.1 * (100.0 - 0.8), 1e-10);
  const Drawn between_walls = draw(walled, {moving(100, 1.0, MaxwellVelocities{5.0}), moving(1, 4.0, MaxwellVelocities{0.1})});
  EXPECT_NEAR(between_walls.kinetic(0, 100), 500.0, 1e-10);
  EXPECT_NEAR(between_walls.kinetic(100, 1), 0.1, 1e-14);
}

TEST(Velocities, TwoDisksOfAnyMassesShareAsMomentumDemands) {
  // p and -p: kinetic energies as the inverse masses, adding up to kT.
  const Drawn drawn = draw(periodic, {moving(1, 1.0, MaxwellVelocities{3.0}), moving(1, 9.0, MaxwellVelocities{3.0})});
  EXPECT_NEAR(drawn.kinetic(0, 1), 2.7, 1e-14);
  EXPECT_NEAR(drawn.kinetic(1, 1), 0.3, 1e-14);
}

TEST(Velocities, AHeavyDiskAmongLightOnesLeavesTheTotalExact) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Drawn drawn = draw(periodic, {moving(1, 1e6, MaxwellVelocities{1.0}), moving(20, 1.0, MaxwellVelocities{1.0})}, seed);
    EXPECT_NEAR(drawn.temperature(), 1.0, 1e-13);
    EXPECT_LE(drawn.momentum(), 40 * eps * drawn.momentum_scale());
  }
}

TEST(Velocities, MomentumIsRemovedFromEveryKindOfDraw) {
  const Drawn drawn = draw(periodic, {moving(40, 1.0, UniformVelocities{1.0}), moving(30, 2.0, FixedSpeed{3.0}),
                                      moving(5, 7.0, MaxwellVelocities{1.0})});
  EXPECT_LE(drawn.momentum(), 75 * eps * drawn.momentum_scale());
}

TEST(Velocities, KeepMomentumKeepsTheDrawsAsTheyAre) {
  const std::vector<Species> species = {moving(200, 2.0, UniformVelocities{1.5}), moving(300, 3.0, MaxwellVelocities{2.0})};
  const Drawn kept = draw(periodic, species, 1, true);
  EXPECT_GT(kept.momentum(), 1e-3);
  EXPECT_TRUE(same_bits(kept.v(), draw(walled, species, 1, true).v()));
  // Between walls nothing is removed; the Maxwellian ones are scaled by one common factor.
  const Drawn scaled = draw(walled, species);
  EXPECT_TRUE(same_bits(kept.v().leftCols(200), scaled.v().leftCols(200)));
  const double factor = scaled.v()(0, 200) / kept.v()(0, 200);
  EXPECT_LT((scaled.v().rightCols(300) - factor * kept.v().rightCols(300)).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(Velocities, LaterSpeciesLeaveEarlierDrawsAlone) {
  const std::vector<Species> one = {moving(100, 1.0, MaxwellVelocities{1.0})};
  std::vector<Species> two = one;
  two.push_back(moving(50, 5.0, UniformVelocities{2.0}));
  for (const bool keep : {true, false})
    EXPECT_TRUE(same_bits(draw(walled, one, 3, keep).v(), draw(walled, two, 3, keep).v().leftCols(100)));
  EXPECT_TRUE(same_bits(draw(periodic, one, 3, true).v(), draw(periodic, two, 3, true).v().leftCols(100)));
}

TEST(Velocities, SameSeedSameBitsAndAnotherSeedOtherVelocities) {
  const std::vector<Species> species = {moving(30, 1.0, MaxwellVelocities{1.0}), moving(30, 1.0, FixedSpeed{1.0})};
  EXPECT_TRUE(same_bits(draw(periodic, species, 5).v(), draw(periodic, species, 5).v()));
  EXPECT_TRUE(((draw(periodic, species, 5).v() - draw(periodic, species, 6).v()).array() != 0.0).all());
}

TEST(Velocities, GivenVelocitiesAreUntouchedAndDisksAtRestRest) {
  const ListedVelocities given{{{1.0, 2.0}, {-3.0, 0.1}}};
  const Drawn drawn = draw(periodic, {moving(2, 1.0, given), moving(20, 1.0, UniformVelocities{1.0}), moving(3, 1.0, AtRest{})});
  EXPECT_EQ(drawn.v().col(0), given.values[0]);
  EXPECT_EQ(drawn.v().col(1), given.values[1]);
  EXPECT_EQ(drawn.v().rightCols(3).norm(), 0.0);
  const Drawn alone = draw(periodic, {moving(2, 1.0, FileVelocities{given.values})});
  EXPECT_EQ(alone.v().col(1), given.values[1]);
}

TEST(Velocities, UniformComponentsFillTheirRange) {
  const double n = 20000;
  const Drawn drawn = draw(walled, {moving(20000, 1.0, UniformVelocities{1.5})});
  EXPECT_LE(drawn.v().cwiseAbs().maxCoeff(), 1.5);
  EXPECT_GT(drawn.v().cwiseAbs().maxCoeff(), 1.499);  // missed by 4e4 draws with probability exp(-27)
  for (int a = 0; a < 2; ++a) {
    EXPECT_NEAR(drawn.v().row(a).mean(), 0.0, 5.0 * 1.5 / std::sqrt(3.0 * n));
    EXPECT_NEAR(drawn.v().row(a).array().square().mean(), 0.75, 5.0 * 2.25 * std::sqrt(4.0 / 45.0 / n));
  }
  EXPECT_NEAR(drawn.v().row(0).cwiseProduct(drawn.v().row(1)).mean(), 0.0, 5.0 * 0.75 / std::sqrt(n));
}

TEST(Velocities, MaxwellComponentsAreGaussianAndIndependent) {
  const double n = 20000;
  const double square = 2.0 / 0.5;  // kT / m
  const Drawn drawn = draw(walled, {moving(20000, 0.5, MaxwellVelocities{2.0})}, 1, true);
  for (int a = 0; a < 2; ++a) {
    EXPECT_NEAR(drawn.v().row(a).mean(), 0.0, 5.0 * std::sqrt(square / n));
    EXPECT_NEAR(drawn.v().row(a).array().square().mean(), square, 5.0 * square * std::sqrt(2.0 / n));
    EXPECT_NEAR(drawn.v().row(a).array().pow(4).mean(), 3.0 * square * square, 5.0 * square * square * std::sqrt(96.0 / n));
  }
  EXPECT_NEAR(drawn.v().row(0).cwiseProduct(drawn.v().row(1)).mean(), 0.0, 5.0 * square / std::sqrt(n));
  // Energies are exponential with mean kT, uncorrelated between neighbours in id.
  const Eigen::ArrayXd energy = 0.25 * drawn.v().colwise().squaredNorm().transpose().array() - 2.0;
  EXPECT_NEAR((energy.head(19999) * energy.tail(19999)).mean(), 0.0, 5.0 * 4.0 / std::sqrt(n));
}

TEST(Velocities, FixedSpeedsAreExactAndPointAnywhere) {
  const double n = 20000;
  const Drawn drawn = draw(walled, {moving(20000, 1.0, FixedSpeed{3.0})});
  const Eigen::ArrayXd speed = drawn.v().colwise().norm().transpose();
  EXPECT_LE((speed - 3.0).abs().maxCoeff(), 3.0 * 4.0 * eps);
  for (int a = 0; a < 2; ++a) {
    EXPECT_NEAR(drawn.v().row(a).mean() / 3.0, 0.0, 5.0 * std::sqrt(0.5 / n));
    EXPECT_NEAR(drawn.v().row(a).array().square().mean() / 9.0, 0.5, 5.0 * std::sqrt(0.125 / n));
  }
  // cos 4 phi, which a square that was cut wrongly would show
  const Eigen::ArrayXd c = drawn.v().row(0).transpose().array() / 3.0;
  EXPECT_NEAR((8.0 * c.pow(4) - 8.0 * c.square() + 1.0).mean(), 0.0, 5.0 * std::sqrt(0.5 / n));
}

TEST(Velocities, ADiskThatFillsTheBoxFromWallToWallMustNotMoveThatWay) {
  // It would bounce for ever at one instant. Along the channel it may move: so a line is realised in two dimensions.
  const Box channel = box_of(10.0, 1.0, Boundary::walls);
  const auto start = [&](double vx, double vy) {
    const ListedPositions place{{{5.0, 0.5}}};
    return refusal<SceneError>([&] {
      (void)draw_start(scene_of(channel, {species_of(1, 0.5, 1.0, place, ListedVelocities{{{vx, vy}}})}));
    });
  };
  EXPECT_EQ(start(1.0, 0.0), "");
  EXPECT_EQ(start(1.0, 0.1),
            "disk 0 of diameter 1 fills the box from wall to wall in y and cannot move along it; give it more room, or no "
            "velocity there");
  EXPECT_NE(start(std::nan(""), 0.0), "");
}

TEST(Velocities, ZeroOfAnyKindIsRest) {
  const Drawn drawn = draw(periodic, {moving(5, 1.0, UniformVelocities{0.0}), moving(5, 1.0, MaxwellVelocities{0.0}),
                                      moving(5, 1.0, FixedSpeed{0.0})});
  EXPECT_EQ(drawn.v().norm(), 0.0);
}

}  // namespace
}  // namespace carom::test
