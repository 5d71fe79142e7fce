// The fast engine against the textbook engine, event by event, for as long as rounding lets two orders of arithmetic
// agree; and its own plan against an exhaustive search on the way.

#include "support/scenes.hpp"
#include "support/twin_engines.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace carom::test {
namespace {

std::size_t compare_events(const System& system, CollisionRule rule, std::size_t most, std::size_t checks = 20) {
  return compare_with_textbook([&](const std::string& name) { return make_engine(name, system, rule); }, "fast", most, checks);
}

/// Where both engines are at the time of the last of so many events, images counted.
void expect_same_places(const System& system, CollisionRule rule, double time, double tolerance) {
  const auto textbook = make_engine("textbook", system, rule);
  const auto fast = make_engine("fast", system, rule);
  run_to(*textbook, time);
  run_to(*fast, time);
  const Eigen::Matrix2Xd apart = unwrapped(system.box, fast->state()) - unwrapped(system.box, textbook->state());
  EXPECT_LE(apart.cwiseAbs().maxCoeff(), tolerance);
}

/// As many disks as a square lattice of the given spacing takes in a rectangle, at temperature 1, but for those that would come
/// within `spacing` of what is there already.
void fill(std::vector<Placed>& placed, const Eigen::Vector2d& lower, const Eigen::Vector2d& upper, double spacing, double radius,
          double mass, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0.0, 1.0 / std::sqrt(mass));
  const std::vector<Placed> there = placed;
  for (double x = lower[0] + spacing / 2; x < upper[0]; x += spacing)
    for (double y = lower[1] + spacing / 2; y < upper[1]; y += spacing) {
      const double vx = normal(random), vy = normal(random);
      bool free = true;
      for (const Placed& other : there) free = free && (other.r - Eigen::Vector2d(x, y)).norm() > other.radius + radius;
      if (free) placed.push_back({{x, y}, {vx, vy}, radius, mass});
    }
}

struct Gas {
  double packing_fraction;
  double exponent;  ///< Lyapunov, per collision of each disk
};

/// Exponents of the reduced density next below (0.1, 0.2, 0.6, 0.8 for packing fractions of 0.1, 0.3, 0.6, 0.7), where they are
/// larger, measured independently for specular disks; half as many events are asked of reversed ones. Errors start as 1e-16 of
/// the mean spacing and the comparison ends at 1e-2 / 1000 / N of a mean free time; finite-time exponents scatter by some 10 %,
/// and the first rounding may be ten times that: 25 % fewer events.
std::size_t horizon(const Gas& gas, CollisionRule rule, std::size_t disks) {
  const double decades = 16.0 - 5.0 - std::log10(static_cast<double>(disks));
  const double per_disk = (rule == CollisionRule::specular ? 0.75 : 0.35) * decades * std::numbers::ln10 / gas.exponent;
  return static_cast<std::size_t>(per_disk * static_cast<double>(disks) / 2.0);
}

class EnginesTwin : public testing::TestWithParam<CollisionRule> {};

TEST_P(EnginesTwin, PeriodicGasHasTheSameEventsUntilTheHorizon) {
  for (const Gas gas : {Gas{0.1, 3.16}, Gas{0.3, 2.01}, Gas{0.6, 0.71}, Gas{0.7, 0.44}}) {
    const System system = system_of(gas_scene(324, gas.packing_fraction, Boundary::periodic));
    const std::size_t agreed = compare_events(system, GetParam(), 4000);
    EXPECT_GE(agreed, std::min<std::size_t>(4000, horizon(gas, GetParam(), 324))) << gas.packing_fraction;
  }
}

TEST_P(EnginesTwin, WalledGasHasTheSameEventsUntilTheHorizon) {
  for (const Gas gas : {Gas{0.1, 3.16}, Gas{0.3, 2.01}, Gas{0.6, 0.71}}) {
    const System system = system_of(gas_scene(324, gas.packing_fraction, Boundary::walls));
    const std::size_t agreed = compare_events(system, GetParam(), 4000);
    EXPECT_GE(agreed, std::min<std::size_t>(4000, horizon(gas, GetParam(), 324))) << gas.packing_fraction;
  }
}

TEST_P(EnginesTwin, ChannelsHaveTheSameEvents) {
  for (const double packing_fraction : {0.1, 0.4, 0.65}) {
    Scene scene = gas_scene(256, packing_fraction, Boundary::periodic);
    scene.box.boundary = {Boundary::periodic, Boundary::walls};
    scene.box.lower += Eigen::Vector2d(-7.5, 3.25);
    scene.box.upper += Eigen::Vector2d(-7.5, 3.25);
    EXPECT_GE(compare_events(system_of(scene), GetParam(), 2000), 500u);
  }
  std::vector<Placed> row;
  fill(row, {0.0, 0.0}, {400.0, 1.6}, 1.6, 0.5, 1.0, 3);
  EXPECT_GE(compare_events(system_of(box_of(400.0, 1.6, Boundary::periodic, Boundary::walls), row), GetParam(), 2000), 500u);
  EXPECT_GE(compare_events(system_of(box_of(400.0, 2.6, Boundary::walls, Boundary::periodic), row), GetParam(), 2000), 500u);
}

TEST_P(EnginesTwin, MixturesHaveTheSameEvents) {
  for (const Boundary boundary : {Boundary::walls, Boundary::periodic}) {
    EXPECT_GE(compare_events(system_of(mixture_scene(256, 0.5, boundary)), GetParam(), 3000), 1000u);
    std::vector<Placed> placed;  // radius ratio 10, mass ratio 1e4
    fill(placed, {0.0, 0.0}, {40.0, 40.0}, 8.0, 2.0, 1e4, 1);
    fill(placed, {0.0, 0.0}, {40.0, 40.0}, 1.6, 0.2, 1.0, 2);
    EXPECT_GE(compare_events(system_of(square_box(40.0, boundary), placed), GetParam(), 1500), 400u);
  }
}

TEST_P(EnginesTwin, OneDiskAHundredTimesLargerHasTheSameEvents) {
  for (const double mass : {1.0, 1e4}) {
    std::vector<Placed> placed = {{{60.0, 70.0}, {0.5, -0.25}, 50.0, mass}};
    fill(placed, {0.0, 0.0}, {140.0, 140.0}, 8.0, 0.5, 1.0, 5);
    for (const Boundary boundary : {Boundary::walls, Boundary::periodic})
      EXPECT_GE(compare_events(system_of(square_box(140.0, boundary), placed), GetParam(), 500, 5), 150u);
  }
}

TEST_P(EnginesTwin, AGasThatStartsInOneQuarterHasTheSameEventsWhileItSpreads) {
  std::vector<Placed> placed;
  fill(placed, {0.0, 0.0}, {20.0, 20.0}, 1.2, 0.5, 1.0, 7);
  for (const Boundary boundary : {Boundary::walls, Boundary::periodic})
    EXPECT_GE(compare_events(system_of(square_box(40.0, boundary), placed), GetParam(), 2000), 700u);
}

TEST_P(EnginesTwin, MassesTwelveDecadesApartHaveTheSameEvents) {
  // Light disks between slow heavy ones: all at temperature 1, so a million times faster.
  std::vector<Placed> placed;
  fill(placed, {0.0, 0.0}, {24.0, 24.0}, 4.0, 1.0, 1e12, 11);
  for (int i = 0; i < 36; i += 3)
    placed.push_back({{2.0 + 4.0 * (i % 6), 4.0 * (1 + i / 6)}, {std::sin(i), std::cos(i)}, 0.3, 1.0});
  std::erase_if(placed, [](const Placed& disk) { return disk.r[1] > 23.5; });
  for (const Boundary boundary : {Boundary::walls, Boundary::periodic})
    EXPECT_GE(compare_events(system_of(square_box(24.0, boundary), placed), GetParam(), 300), 60u);
}

TEST_P(EnginesTwin, UnwrappedPositionsAreTheTextbooks) {
  // Two collisions per disk at a packing fraction of 0.6 let errors grow by exp(0.71 * 1.25 * 2) < 10; they begin as some ten
  // roundings of coordinates of size 40.
  Scene scene = gas_scene(144, 0.6, Boundary::periodic);
  System system = system_of(scene);
  for (Eigen::Index i = 0; i < 144; ++i) system.state.velocities.col(i) += Eigen::Vector2d(300.0, -200.0);  // many box lengths
  const auto textbook = make_engine("textbook", system, GetParam());
  textbook->run_until(forever, 144, no_limit);
  const double time = textbook->now().high;
  EXPECT_GT(300.0 * time, 2.0 * system.box.lengths()[0]);
  // The common velocity, 360, times the rounding of times that it was predicted with: 1e-16 of a few mean free times each.
  expect_same_places(system, GetParam(), time, 1e-10);
}

TEST_P(EnginesTwin, ImagesOfTheStartAreCarriedOn) {
  System system = system_of(gas_scene(16, 0.2, Boundary::periodic));
  for (Eigen::Index i = 0; i < 16; ++i) system.state.images.col(i) << 5 - i, 1'000'000'000'000 * i;
  const auto textbook = make_engine("textbook", system, GetParam());
  const auto fast = make_engine("fast", system, GetParam());
  EXPECT_EQ(fast->state().images, textbook->state().images);
  run_to(*textbook, 1.0);
  run_to(*fast, 1.0);
  EXPECT_EQ(fast->state().images, textbook->state().images);
}

INSTANTIATE_TEST_SUITE_P(All, EnginesTwin, testing::Values(CollisionRule::specular, CollisionRule::reversal),
                         [](const auto& rule) { return rule.param == CollisionRule::specular ? "Specular" : "Reversal"; });

}  // namespace
}  // namespace carom::test
