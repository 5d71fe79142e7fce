#include "theory/single_file.hpp"

#include <gtest/gtest.h>
#include <boost/math/quadrature/gauss.hpp>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace carom::test {
namespace {

using theory::single_file;

TEST(SingleFile, OfFewDisksHasTheirSecondVirialCoefficient) {
  // The mean of the closest distance along the channel over both heights; the next term is of the order of its square.
  using Rule = boost::math::quadrature::gauss<double, 30>;
  constexpr double h = 0.7, length = 1e4;
  const double closest = Rule::integrate(
      [&](double y) { return Rule::integrate([&](double z) { return std::sqrt(1.0 - (y - z) * (y - z)); }, 0.0, h); }, 0.0, h);
  EXPECT_NEAR(length * (single_file(1.0 + h, length).force * length - 1.0), closest / (h * h), 5.0 / length);
  EXPECT_NEAR(single_file(1.0 + h, length).wall_pressure * length * h, 1.0, 5.0 / length);
}

TEST(SingleFile, ForcesAreSlopesOfOneFreeEnergy) {
  // The force is -df/dl and the pressure times the length -df/dh of one function f(l, h). Central differences err by step^2.
  constexpr double h = 0.6, length = 1.1, step = 1e-4;
  const auto force = [&](double range) { return single_file(1.0 + range, length).force; };
  const auto wall_force = [&](double l) { return single_file(1.0 + h, l).wall_pressure * l; };
  EXPECT_NEAR((force(h + step) - force(h - step)) / (2 * step),
              (wall_force(length + step) - wall_force(length - step)) / (2 * step), 1e-5);
}

TEST(SingleFile, NearClosePackingHasTwoDegreesOfFreedomForEachDisk) {
  // F (l - l_min) comes to 2 (Montero & Santos, arXiv:2212.08932), where hard rods on a line have 1.
  const double closest = std::sqrt(1.0 - 0.8 * 0.8);
  const double near = single_file(1.8, closest + 0.04).force * 0.04, nearer = single_file(1.8, closest + 0.02).force * 0.02;
  EXPECT_NEAR(2.0 * nearer - near, 2.0, 0.005) << near << ' ' << nearer;
}

TEST(SingleFile, InAChannelWithoutRoomIsThatOfRodsForAnyNumberOfDisks) {
  // N rods on a ring of length N l have l (l - 1)^(N - 1) to be in: force 1 / N l + (1 - 1/N) / (l - 1), with no further terms.
  for (const double length : {1.2, 1.5, 3.0})
    EXPECT_NEAR(single_file(1.001, length, 10).force, 0.1 / length + 0.9 / (length - 1.0), 2e-6 / (length - 1.0)) << length;
}

TEST(SingleFile, OfSixDisksIsTheIntegralOverTheirHeights) {
  // Six disks on a ring leave L - sum a to be shared by six distances, in (L - sum a)^5 / 5! ways, if L is longer than six
  // diameters, and the first may be anywhere on the ring: forces are slopes of the logarithm of the integral over six heights.
  using Rule = boost::math::quadrature::gauss<double, 10>;
  constexpr double h = 0.8;
  std::vector<double> y, weights;
  for (std::size_t k = 0; k < Rule::abscissa().size(); ++k)
    for (const double side : {-0.5, 0.5}) y.push_back(side * Rule::abscissa()[k]), weights.push_back(0.5 * Rule::weights()[k]);
  const auto log_of_volume = [&](double ring, double range) {
    const std::size_t n = y.size();
    std::vector<double> apart(n * n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) apart[i * n + j] = std::sqrt(1.0 - std::pow(range * (y[i] - y[j]), 2));
    double sum = 0.0;
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b)
        for (std::size_t c = 0; c < n; ++c)
          for (std::size_t d = 0; d < n; ++d)
            for (std::size_t e = 0; e < n; ++e)
              for (std::size_t f = 0; f < n; ++f) {
                const double free = ring - apart[a * n + b] - apart[b * n + c] - apart[c * n + d] - apart[d * n + e] -
                                    apart[e * n + f] - apart[f * n + a];
                sum += weights[a] * weights[b] * weights[c] * weights[d] * weights[e] * weights[f] * std::pow(free, 5);
              }
    return std::log(ring * std::pow(range, 6) * sum);
  };
  constexpr double length = 1.1, step = 1e-4;
  const theory::SingleFile six = single_file(1.0 + h, length, 6);
  EXPECT_NEAR(six.force, (log_of_volume(6.0 * length + step, h) - log_of_volume(6.0 * length - step, h)) / (2.0 * step), 1e-6);
  EXPECT_NEAR(six.wall_pressure,
              (log_of_volume(6.0 * length, h + step) - log_of_volume(6.0 * length, h - step)) / (2.0 * step) / (6.0 * length),
              1e-6);
}

TEST(SingleFile, OfManyDisksIsThatOfInfinitelyMany) {
  // Corrections fall as 1/N.
  for (const auto& potential : {std::vector<PotentialStep>{}, std::vector<PotentialStep>{{1.4, -0.5}}}) {
    const theory::SingleFile infinite = single_file(1.6, 1.1, potential), many = single_file(1.6, 1.1, 500, potential),
                             twice = single_file(1.6, 1.1, 1000, potential);
    EXPECT_NEAR(2.0 * twice.force - many.force, infinite.force, 1e-4);
    EXPECT_NEAR(2.0 * twice.wall_pressure - many.wall_pressure, infinite.wall_pressure, 1e-4);
    EXPECT_NEAR(2.0 * twice.energy - many.energy, infinite.energy, 1e-5);
  }
}

/// Steps of a potential for channels of width up to 1.6, where second neighbours are 1.6 apart at least, to rounding.
const std::vector<PotentialStep> steps = {{1.2, 0.9}, {1.59, -0.7}};

TEST(SingleFile, OfStepsOfNoEnergyIsThatOfHardDisks) {
  const theory::SingleFile hard = single_file(1.6, 1.1, 50), same = single_file(1.6, 1.1, 50, {{1.2, 0.0}, {1.5, 0.0}});
  EXPECT_NEAR(same.force, hard.force, 1e-12 * hard.force);
  EXPECT_NEAR(same.wall_pressure, hard.wall_pressure, 1e-12 * hard.wall_pressure);
  EXPECT_EQ(same.energy, 0.0);
  const theory::SingleFile one = single_file(1.6, 1.1, {{1.4, -0.5}}), split = single_file(1.6, 1.1, {{1.2, -0.5}, {1.4, -0.5}});
  EXPECT_NEAR(split.force, one.force, 1e-12);
  EXPECT_NEAR(split.energy, one.energy, 1e-12);
}

TEST(SingleFile, OfStepsInAChannelWithoutRoomIsTheIntegralOverDistances) {
  // On a line the mean distance and energy of neighbours at force p are those of the weight exp(-p x - u(x)).
  using Rule = boost::math::quadrature::gauss<double, 30>;
  for (const double length : {1.15, 1.4, 3.0}) {
    const theory::SingleFile found = single_file(1.001, length, steps);
    double weight = 0.0, distance = 0.0, energy = 0.0, from = 1.0;
    const auto add = [&](double to, double u) {
      const auto w = [&](double x) { return std::exp(-found.force * x - u); };
      weight += Rule::integrate(w, from, to);
      distance += Rule::integrate([&](double x) { return x * w(x); }, from, to);
      energy += u * Rule::integrate(w, from, to);
      from = to;
    };
    for (const PotentialStep& step : steps) add(step.width, step.energy);
    for (int k = 1; k <= 200; ++k) add(1.59 + 0.5 * k / found.force, 0.0);
    EXPECT_NEAR(distance / weight, length, 1e-6) << "the channel leaves 1e-6 / 4";
    EXPECT_NEAR(energy / weight, found.energy, 2e-6);
  }
}

TEST(SingleFile, OfFewDisksWithStepsHasTheirSecondVirialCoefficient) {
  using Rule = boost::math::quadrature::gauss<double, 30>;
  constexpr double h = 0.6, length = 1e4;
  const auto excluded = [&](double dy) {
    double sum = 0.0, before = 0.0, weight = 0.0;
    const auto add = [&](double width, double next) {
      const double a = std::sqrt(width * width - dy * dy);
      sum += (1.0 - weight) * (a - before);
      before = a, weight = next;
    };
    add(1.0, std::exp(-0.9));
    add(1.2, std::exp(0.7));
    add(1.59, 1.0);
    return sum;
  };
  const double mean =
      Rule::integrate([&](double y) { return Rule::integrate([&](double z) { return excluded(y - z); }, 0.0, h); }, 0.0, h) /
      (h * h);
  EXPECT_NEAR(length * (single_file(1.0 + h, length, steps).force * length - 1.0), mean, 10.0 / length);
}

TEST(SingleFile, ForcesAndEnergyOfStepsAreSlopesOfOneFreeEnergy) {
  // ln Z per disk is a function f(l, h, beta) with slopes p, l P and -u. Central differences err by step^2.
  constexpr double h = 0.6, length = 1.1, step = 1e-4;
  for (const bool few : {false, true}) {
    const auto at = [few](double l, double range, double beta) {
      std::vector<PotentialStep> scaled = steps;
      for (PotentialStep& one : scaled) one.energy *= beta;
      return few ? single_file(1.0 + range, l, 12, scaled) : single_file(1.0 + range, l, scaled);
    };
    const auto slope = [](auto&& f) { return (f(step) - f(-step)) / (2.0 * step); };
    EXPECT_NEAR(slope([&](double d) { return at(length, h + d, 1.0).force; }),
                slope([&](double d) { return at(length + d, h, 1.0).wall_pressure * (length + d); }), 1e-5);
    EXPECT_NEAR(slope([&](double d) { return at(length + d, h, 1.0).energy; }),
                -slope([&](double d) { return at(length, h, 1.0 + d).force; }), 1e-5);
    EXPECT_NEAR(slope([&](double d) { return at(length, h + d, 1.0).energy; }),
                -slope([&](double d) { return at(length, h, 1.0 + d).wall_pressure * length; }), 1e-5);
  }
}

TEST(SingleFile, StepsThatReachSecondNeighboursAreRefused) {
  EXPECT_NO_THROW((void)single_file(1.6, 1.1, {{1.59, 1.0}}));
  EXPECT_THROW((void)single_file(1.6, 1.1, {{1.61, 1.0}}), std::invalid_argument);
  EXPECT_THROW((void)single_file(1.6, 1.1, {{1.4, 1.0}, {1.3, 1.0}}), std::invalid_argument);
  EXPECT_THROW((void)single_file(1.6, 1.1, {{1.0, 1.0}}), std::invalid_argument);
  EXPECT_THROW((void)single_file(1.6, 1.1, {{1.3, std::nan("")}}), std::invalid_argument);
}

TEST(SingleFile, WhereDisksCanPassOrDoNotFitIsRefused) {
  EXPECT_THROW((void)single_file(1.0, 2.0), std::invalid_argument);
  EXPECT_THROW((void)single_file(1.87, 2.0), std::invalid_argument);
  EXPECT_THROW((void)single_file(1.8, 0.599), std::invalid_argument);
  EXPECT_THROW((void)single_file(1.8, 0.6001), std::invalid_argument) << "too close to be resolved";
  EXPECT_THROW((void)single_file(1.8, std::nan("")), std::invalid_argument);
  EXPECT_THROW((void)single_file(std::nan(""), 1.0), std::invalid_argument);
  EXPECT_THROW((void)single_file(1.8, 1.0, 5), std::invalid_argument) << "too few disks";
}

}  // namespace
}  // namespace carom::test
