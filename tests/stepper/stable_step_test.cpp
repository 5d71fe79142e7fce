// The longest stable step: the bound on the contacts of a disk against contacts placed at random, the bound on the step against
// the eigenvalues of whole clusters, and a crystal that stands still below it and bursts above.

#include "stepper/stable_step.hpp"
#include "observe/mechanics.hpp"
#include "stepper/grid.hpp"
#include "stepper/soft.hpp"
#include "stepper/stepper.hpp"
#include "support/systems.hpp"

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace carom::test {
namespace {

using Springs = SoftStep<ClosePairs>;

TEST(StableStep, EqualDisksHaveThreeContactsAlongAnyDirection) {
  EXPECT_NEAR(most_contacts_along(0.5, 0.5), 3.0, 1e-12);
  EXPECT_NEAR(most_contacts_along(7.0, 7.0), 3.0, 1e-12);
}

TEST(StableStep, NoContactsThatFitRoundADiskAddUpToMore) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(0.0, 2.0 * std::numbers::pi), step(1.0, 1.5);
  for (const double radius : {1.0, 1.3, 2.0, 5.0, 20.0}) {
    const double apart = 2.0 * std::asin(1.0 / (radius + 1.0)), bound = most_contacts_along(radius, 1.0);
    double most = 0.0;
    for (int trial = 0; trial < 2000; ++trial) {
      const double loose = trial % 2 == 0 ? 0.0 : 1.0;  // half of them as close as can be
      const double first = angle(random), end = first + 2.0 * std::numbers::pi - apart;
      double sum = 0.0;
      for (double at = first; at <= end * (1.0 + 1e-12); at += apart * (1.0 + loose * (step(random) - 1.0)))
        sum += std::cos(at) * std::cos(at);
      most = std::max(most, sum);
    }
    EXPECT_LE(most, bound * (1.0 + 1e-9)) << radius;
    EXPECT_GT(most, 0.9 * bound) << radius;
  }
}

struct Touch {
  std::size_t i, j;
};

/// All pairs in contact.
std::vector<Touch> touches_of(const std::vector<Placed>& disks) {
  std::vector<Touch> touches;
  for (std::size_t i = 0; i < disks.size(); ++i)
    for (std::size_t j = i + 1; j < disks.size(); ++j)
      if ((disks[i].r - disks[j].r).norm() < (disks[i].radius + disks[j].radius) * (1.0 + 1e-9)) touches.push_back({i, j});
  return touches;
}

/// The largest eigenvalue of M^-1 K for springs of stiffness 1 at all contacts.
double fastest_mode(const std::vector<Placed>& disks) {
  const auto n = static_cast<Eigen::Index>(2 * disks.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  for (const auto& [i, j] : touches_of(disks)) {
    Eigen::VectorXd stretch = Eigen::VectorXd::Zero(n);  // by a displacement times the root of each mass
    const Eigen::Vector2d along = (disks[i].r - disks[j].r).normalized();
    stretch.segment<2>(static_cast<Eigen::Index>(2 * i)) = along / std::sqrt(disks[i].mass);
    stretch.segment<2>(static_cast<Eigen::Index>(2 * j)) = -along / std::sqrt(disks[j].mass);
    matrix += stretch * stretch.transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

double bound_of(const std::vector<Placed>& disks, double stiffness, double damping = 0.0) {
  std::vector<double> radius, mass;
  for (const Placed& disk : disks) {
    radius.push_back(disk.radius);
    mass.push_back(disk.mass);
  }
  return stable_below(radius, mass, stiffness, damping);
}

/// All disks of a hexagonal lattice that are within `shells` of its middle.
std::vector<Placed> hexagon(int shells) {
  std::vector<Placed> disks;
  for (int a = -shells; a <= shells; ++a)
    for (int b = -shells; b <= shells; ++b)
      if (std::abs(a + b) <= shells) disks.push_back({{a + b / 2.0, b * std::sqrt(3.0) / 2.0}, {0.0, 0.0}});
  return disks;
}

/// Disks one after the other where each touches two that are there and overlaps none.
std::vector<Placed> random_cluster(std::size_t count, double largest, double heaviest, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto disk = [&] {
    return Placed{{0.0, 0.0}, {0.0, 0.0}, std::pow(largest, unit(random)), std::pow(heaviest, unit(random))};
  };
  std::vector<Placed> disks = {disk(), disk()};
  disks[1].r[0] = disks[0].radius + disks[1].radius;
  while (disks.size() < count) {
    Placed next = disk();
    const Placed &a = disks[random() % disks.size()], &b = disks[random() % disks.size()];
    const double apart = (b.r - a.r).norm(), to_a = a.radius + next.radius, to_b = b.radius + next.radius;
    if (&a == &b || apart >= to_a + to_b) continue;
    const double along = (apart * apart + to_a * to_a - to_b * to_b) / (2.0 * apart), square = to_a * to_a - along * along;
    if (square < 0.0) continue;
    const Eigen::Vector2d direction = (b.r - a.r) / apart, across(-direction[1], direction[0]);
    next.r = a.r + along * direction + std::sqrt(square) * across;
    if (std::ranges::none_of(
            disks, [&](const Placed& other) { return (other.r - next.r).norm() < (other.radius + next.radius) * (1.0 - 1e-10); }))
      disks.push_back(next);
  }
  return disks;
}

TEST(StableStep, IsBelowTwoOverTheFastestModeOfAHexagonAndNearItInALargeOne) {
  for (const int shells : {1, 2, 5}) {
    const std::vector<Placed> disks = hexagon(shells);
    for (const double stiffness : {1.0, 400.0})
      EXPECT_LT(bound_of(disks, stiffness), 2.0 / std::sqrt(stiffness * fastest_mode(disks))) << shells;
  }
  EXPECT_EQ(hexagon(1).size(), 7U);
  EXPECT_EQ(touches_of(hexagon(1)).size(), 12U);
  EXPECT_GT(bound_of(hexagon(5), 1.0), 0.95 * 2.0 / std::sqrt(fastest_mode(hexagon(5))));
}

TEST(StableStep, IsBelowTwoOverTheFastestModeOfAnyMixture) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 120; ++trial) {
    const std::vector<Placed> disks = random_cluster(30,
                                                     trial % 3 == 0   ? 1.0
                                                     : trial % 3 == 1 ? 3.0
                                                                      : 8.0,
                                                     trial % 2 == 0 ? 1.0 : 1000.0, random);
    ASSERT_GE(touches_of(disks).size(), 57U);
    ASSERT_LT(bound_of(disks, 1.0), 2.0 / std::sqrt(fastest_mode(disks))) << trial;
  }
}

TEST(StableStep, IsThatOfTheLightestOfEqualSizesAndShorterWithDashpots) {
  const std::vector<Placed> disks = {{{0, 0}, {0, 0}, 0.5, 2.0}, {{1, 0}, {0, 0}, 0.5, 8.0}};
  EXPECT_NEAR(bound_of(disks, 300.0), std::sqrt(2.0 * 2.0 / (3.0 * 300.0)), 1e-15);
  double before = bound_of(disks, 1.0);
  for (const double restitution : {0.99, 0.5, 0.01}) {
    const double damping = Springs::relative_damping(restitution), bound = bound_of(disks, 1.0, damping);
    EXPECT_LT(bound, before);
    EXPECT_GT(bound, 0.1 * before);
    const double y = bound / std::sqrt(2.0);  // over the root of mass / stiffness
    EXPECT_NEAR(3.0 * y * y + 5.0 * damping * y, 2.0, 1e-14);
    before = bound;
  }
  EXPECT_EQ(bound_of({}, 1.0), std::numeric_limits<double>::infinity());
}

TEST(StableStep, NoDiskTouchesMoreThanThereAre) {
  const std::vector<Placed> disks = {{{0, 0}, {0, 0}, 1.0, 2.0}, {{1001, 0}, {0, 0}, 1000.0, 2.0}};
  EXPECT_NEAR(bound_of(disks, 1.0), std::sqrt(2.0 * 2.0 / 3.0), 1e-15);  // the other and two walls
}

/// A crystal of 16 disks that fills a periodic box and is pressed together by a thousandth. Its rows can move against each other.
System crystal() {
  constexpr double apart = 0.999, height = apart * std::numbers::sqrt3 / 2.0;
  std::mt19937 random(1);
  std::normal_distribution<double> small(0.0, 1e-6);
  std::vector<Placed> disks;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      disks.push_back({{apart * (column + 0.25 + row % 2 / 2.0), height * (row + 0.5)}, {small(random), small(random)}});
  return system_of({{0.0, 0.0}, {4.0 * apart, 4.0 * height}, {Boundary::periodic, Boundary::periodic}}, disks);
}

/// Returns by which factor the kinetic energy of the crystal is larger than at its start, at the most, within `steps` steps.
double growth(double dt, int steps, double restitution = 1.0) {
  constexpr double stiffness = 1.0;
  const System s = crystal();
  Effects effects;
  effects.collision.restitution = restitution;
  Stepper<Springs> stepper(s.box, s.disks, s.state, dt, effects, stiffness);
  const double start = kinetic_energy(s.disks, s.state);
  double most = 0.0;
  for (int k = 0; k < steps; k += 50) {
    run_to(stepper, k * dt);
    most = std::max(most, kinetic_energy(s.disks, stepper.state()) / start);
  }
  return most;
}

TEST(StableStep, ACrystalStandsBelowItAndBurstsAbove) {
  const double bound = std::sqrt(2.0 / 3.0);
  EXPECT_LT(growth(0.99 * bound, 100'000), 100.0);
  EXPECT_GT(growth(1.01 * bound, 1'000), 1e6);
}

TEST(StableStep, ACrystalWithDashpotsStandsBelowItsOwnAndBurstsAtThatWithout) {
  constexpr double restitution = 0.5;
  const double bound = stable_below(std::vector(16, 0.5), std::vector(16, 1.0), 1.0, Springs::relative_damping(restitution));
  EXPECT_LE(growth(0.99 * bound, 20'000, restitution), 1.0);
  EXPECT_GT(growth(0.99 * std::sqrt(2.0 / 3.0), 1'000, restitution), 1e6);
}

}  // namespace
}  // namespace carom::test
