// Brownian dynamics by redraws: equilibrium at any rate, and two disks against the diffusion equation of their separation.

#include "observe/observed_system.hpp"
#include "support/block_means.hpp"
#include "support/scenes.hpp"
#include "theory/equation_of_state.hpp"

#include <carom/scene.hpp>
#include <carom/simulation.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>

#include <boost/math/special_functions/bessel.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace carom::test {
namespace {

TEST(PhysicsBrownian, ZAndTheContactValueAreThoseOfEquilibriumAtAnyRate) {
  // Redraws leave positions as they are and velocities Maxwellian, so that both stay as they are in equilibrium, at kT = 1.
  constexpr double eta = 0.4;
  constexpr int disks = 100;
  for (const double rate : {0.1, 5.0, 50.0}) {  // a disk collides some 4 times in a unit of time
    const double time = rate > 10.0 ? 1000.0 : 400.0;
    const Observed run = observe(
        parse_scene(fmt::format(
            "[box]\naspect = 1.0\nboundary = \"periodic\"\n[[disks]]\ncount = {}\nradius = 0.5\nmass = 1.0\npacking_fraction = "
            "{}\npositions = \"hexagonal\"\nvelocities = {{ temperature = 1.0 }}\n[collision]\nrule = \"specular\"\n[brownian]\n"
            "temperature = 1.0\nrate = {}\n[run]\ntime = {}\nequilibrate = {{ time = 100.0 }}\n[observe]\n"
            "radial_distribution = {{ every = 0.25 }}\n",
            disks, eta, rate, time)),
        1.0);
    BlockMeans Z(static_cast<std::size_t>(time / 40.0));
    for (std::size_t k = 1; k < run.record.totals.size(); ++k)
      Z.add(1.0 + (run.record.totals[k].virial - run.record.totals[k - 1].virial) / (2.0 * disks));
    const double expected = theory::kolafa_rottner_finite(eta, disks);
    RecordProperty(fmt::format("Z_{}", rate), testing::PrintToString(Z.mean()));
    EXPECT_NEAR(Z.mean(), expected, 4.5 * Z.error()) << rate;
    EXPECT_LT(Z.error(), 0.02 * expected);
    const Scalar& contact = run.scalar("radial_distribution", "contact");
    const double g = (expected - 1.0) / (2.0 * eta) * disks / (disks - 1.0);  // pairs are counted against N (N - 1) / 2
    EXPECT_NEAR(contact.value.value(), g, 4.5 * contact.error.value()) << rate;
    EXPECT_LT(contact.error.value(), 0.05 * g);
  }
}

/// The separation of two disks of diameter 1 on a square torus: the autocorrelation of cos k x, k the smallest wave number, after
/// the time t in which <x^2> of free disks' separation would be 2 D t. The diffusion equation outside of the circle, with no flux
/// through it, by Galerkin's method: products of cosines with up to `cutoff` waves, whose integrals over the circle are Bessel
/// functions.
double correlation_by_diffusion(double side, double Dt, int cutoff) {
  const double unit = 2.0 * std::numbers::pi / side;
  const int each = cutoff + 1, size = each * each;
  // The integral of cos(unit (p x + q y)) over the torus outside of the circle.
  const auto outside = [&](int p, int q) {
    const double wave = unit * std::hypot(p, q);
    return p == 0 && q == 0 ? side * side - std::numbers::pi
                            : -2.0 * std::numbers::pi * boost::math::cyl_bessel_j(1, wave) / wave;
  };
  Eigen::MatrixXd mass(size, size), stiffness(size, size);
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) {
      const int a = i / each, b = i % each, c = j / each, d = j % each;
      // cos a cos c = (cos(a - c) + cos(a + c)) / 2, sin a sin c = (cos(a - c) - cos(a + c)) / 2; likewise along y.
      double products = 0.0, along_x = 0.0, along_y = 0.0;
      for (const int s : {-1, 1})
        for (const int t : {-1, 1}) {
          const double part = 0.25 * outside(std::abs(a + s * c), std::abs(b + t * d));
          products += part;
          along_x += -s * part;
          along_y += -t * part;
        }
      mass(i, j) = products;
      stiffness(i, j) = unit * unit * (a * c * along_x + b * d * along_y);
    }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(stiffness, mass);
  Eigen::VectorXd wave = Eigen::VectorXd::Zero(size), constant = wave;
  wave[each] = 1.0;  // cos(unit x)
  constant[0] = 1.0;
  const double area = outside(0, 0), mean = constant.dot(mass * wave) / area;
  const Eigen::VectorXd parts = modes.eigenvectors().transpose() * (mass * wave);
  const double later = parts.cwiseAbs2().dot((-Dt * modes.eigenvalues()).array().exp().matrix());
  return (later / area - mean * mean) / (parts.squaredNorm() / area - mean * mean);
}

TEST(PhysicsBrownian, TheDiffusionEquationIsSolvedWithFewWaves) {
  const double free = std::exp(-0.2 * std::pow(2.0 * std::numbers::pi / 3.0, 2));
  EXPECT_NEAR(correlation_by_diffusion(3.0, 0.2, 6), correlation_by_diffusion(3.0, 0.2, 4), 1e-4);
  EXPECT_GT(std::abs(correlation_by_diffusion(3.0, 0.2, 6) - free), 0.02) << "the circle is felt";
  EXPECT_NEAR(correlation_by_diffusion(1000.0, 1e4, 1), std::exp(-1e4 * std::pow(2.0 * std::numbers::pi / 1000.0, 2)), 1e-4)
      << "on a large torus it is not";
}

struct Correlation {
  double value, error;
};

/// The same of a run with so many redraws, in each of which a component of the separation of free disks changes by `length`.
Correlation correlation_by_redraws(double side, double Dt, double length, int redraws) {
  // The variance of the separation is 2 kT dt^2 / m in one redraw: 2 D dt.
  const double dt = length / std::numbers::sqrt2;
  Scene scene =
      scene_of(box_of(side, side, Boundary::periodic), {species_of(2, 0.5, 1.0, RandomPositions{}, MaxwellVelocities{1.0})}, 11);
  scene.effects.brownian = Brownian{1.0, 1.0 / dt};
  Simulation simulation = make_simulation(scene);
  const auto lag = static_cast<std::size_t>(std::lround(2.0 * Dt / (length * length)));
  std::vector<double> x, y;
  const double unit = 2.0 * std::numbers::pi / side;
  for (int k = 1; k <= redraws; ++k) {
    simulation.run_until(k * dt);
    const Eigen::Vector2d apart = simulation.state().positions.col(1) - simulation.state().positions.col(0);
    x.push_back(std::cos(unit * apart.x()));
    y.push_back(std::cos(unit * apart.y()));
  }
  // Exact mean and mean square: only the product of different times is measured.
  const double area = side * side - std::numbers::pi, wave = unit;
  const double mean = -2.0 * std::numbers::pi * boost::math::cyl_bessel_j(1, wave) / wave / area;
  const double square = 0.5 + 0.5 * (-2.0 * std::numbers::pi * boost::math::cyl_bessel_j(1, 2.0 * wave) / (2.0 * wave) / area);
  BlockMeans products(x.size() / 50);
  for (std::size_t k = lag; k < x.size(); ++k)
    products.add(0.5 * ((x[k] - mean) * (x[k - lag] - mean) + (y[k] - mean) * (y[k - lag] - mean)) / (square - mean * mean));
  return {products.mean(), products.error()};
}

TEST(PhysicsBrownian, TwoDisksDiffuseAsTheDiffusionEquationOfTheirSeparationSays) {
  // A straight wall reflects steps exactly. A curved one errs in a layer as thick as a step, by its curvature: to the square of
  // the step, which two lengths of steps extrapolate.
  constexpr double side = 3.0, Dt = 0.18;
  const double expected = correlation_by_diffusion(side, Dt, 6);
  const Correlation coarse = correlation_by_redraws(side, Dt, 0.3, 200'000),
                    fine = correlation_by_redraws(side, Dt, 0.15, 600'000);
  const double limit = (4.0 * fine.value - coarse.value) / 3.0, error = std::hypot(4.0 * fine.error, coarse.error) / 3.0;
  RecordProperty("expected", testing::PrintToString(expected));
  RecordProperty("coarse", testing::PrintToString(coarse.value));
  RecordProperty("fine", testing::PrintToString(fine.value));
  RecordProperty("error", testing::PrintToString(error));
  EXPECT_NEAR(limit, expected, 4.5 * error);
  EXPECT_LT(error, 0.02 * expected);
  EXPECT_GT(std::abs(expected - std::exp(-Dt * std::pow(2.0 * std::numbers::pi / side, 2))), 5.0 * error)
      << "disks that pass through each other diffuse otherwise";
}

}  // namespace
}  // namespace carom::test
