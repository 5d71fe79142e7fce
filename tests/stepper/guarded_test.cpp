// The guarded method: what it does to one pair in closed form, and that it converges to the exact trajectory with the first order
// of dt.

#include "support/scenes.hpp"
#include "support/systems.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace carom::test {
namespace {

TEST(Guarded, AHeadOnPairTurnsAtTheFirstStepInContactAndIsLateByJustThat) {
  Scene scene = scene_of(square_box(16.0, Boundary::walls), {species_of(2, 0.5, 1.0, ListedPositions{{{6.0, 8.0}, {10.0, 8.0}}},
                                                                        ListedVelocities{{{1.0, 0.0}, {-1.0, 0.0}}})});
  for (const CollisionRule rule : both_rules) {
    scene.effects.collision.rule = rule;
    for (const char* method : {"guarded", "grid"}) {
      // They meet at 1.5. With dt = 0.4375 the first step after that is at 1.75: a quarter late, half a length deep.
      Simulation s = make_simulation(scene, FixedStep{method, 0.4375});
      s.run_until(1.75);
      EXPECT_EQ(s.totals().pair, 1U);
      EXPECT_EQ(s.state().positions(0, 1) - s.state().positions(0, 0), 0.5);
      EXPECT_EQ(s.totals().virial, 1.0);  // r . dp = 0.5 * 2; the exact one is sigma * 2
      s.run_until(4.0);
      EXPECT_EQ(s.totals().pair, 1U);  // parting, they are left alone though they still overlap
      Simulation exact = make_simulation(scene);
      exact.run_until(4.0);
      EXPECT_EQ(s.state().positions(0, 1) - exact.state().positions(0, 1), -0.5);  // 2 u (1.75 - 1.5) behind
    }
  }
}

TEST(Guarded, AWallTurnsOnlyDisksThatMoveOut) {
  Scene scene = scene_of(square_box(8.0, Boundary::walls),
                         {species_of(1, 0.5, 3.0, ListedPositions{{{7.0, 4.0}}}, ListedVelocities{{{1.0, 0.0}}})});
  Simulation s = make_simulation(scene, FixedStep{"guarded", 0.75});
  s.run_until(0.75);
  EXPECT_EQ(s.state().positions(0, 0), 7.75);
  EXPECT_EQ(s.state().velocities(0, 0), -1.0);
  EXPECT_EQ(s.totals().wall_impulse[1], 6.0);
  s.run_until(6.0);
  EXPECT_EQ(s.totals().wall, 1U);
}

/// The slope of y against x by least squares, with its standard error.
struct Slope {
  double value, error;
};
Slope fitted_slope(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double mx = 0.0, my = 0.0, sxx = 0.0, sxy = 0.0, rest = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) mx += x[k] / n, my += y[k] / n;
  for (std::size_t k = 0; k < x.size(); ++k) sxx += (x[k] - mx) * (x[k] - mx), sxy += (x[k] - mx) * (y[k] - my);
  const double slope = sxy / sxx;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double residual = y[k] - my - slope * (x[k] - mx);
    rest += residual * residual;
  }
  return {slope, std::sqrt(rest / (n - 2.0) / sxx)};
}

/// The largest error of a position at the end, over all disks.
double largest_error(const Scene& scene, const std::string& method, double dt, double end, const State& exact) {
  Simulation s = make_simulation(scene, FixedStep{method, dt});
  s.run_until(end);
  return (s.state().positions - exact.positions).colwise().norm().maxCoeff();
}

TEST(Guarded, PositionsConvergeWithTheFirstOrderOfDt) {
  // Five disks, some collisions with each other and with walls, and steps so short that none is missed. Where in its step a
  // collision falls is as good as random, so the logarithm of the error scatters about its mean alike at every dt: a fit by least
  // squares knows its own error.
  Scene scene = scene_of(square_box(6.0, Boundary::walls),
                         {species_of(5, 0.5, 1.0, ListedPositions{{{1.0, 1.1}, {3.0, 1.0}, {5.0, 1.3}, {1.5, 4.0}, {4.1, 4.3}}},
                                     ListedVelocities{{{1.0, 0.3}, {-0.7, 0.9}, {-0.4, -0.6}, {0.8, -0.5}, {-0.9, -0.2}}})});
  constexpr double end = 4.0;  // some collisions of every disk
  for (const CollisionRule rule : both_rules) {
    scene.effects.collision.rule = rule;
    Simulation quad = make_simulation(scene, "textbook-quad");
    quad.run_until(end);
    ASSERT_GE(quad.totals().pair, 4U);
    const State exact = quad.state();
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> exponent(std::log(3e-5), std::log(1e-3));
    for (const char* method : {"guarded", "grid"}) {
      std::vector<double> x, y;
      for (int k = 0; k < 150; ++k) {
        x.push_back(exponent(random));
        y.push_back(std::log(largest_error(scene, method, std::exp(x.back()), end, exact)));
      }
      const Slope order = fitted_slope(x, y);
      EXPECT_LT(order.error, 0.1) << method;  // tells 1 from 1/2 and 3/2 by five errors
      EXPECT_NEAR(order.value, 1.0, 3.0 * order.error) << method;
    }
  }
}

}  // namespace
}  // namespace carom::test
