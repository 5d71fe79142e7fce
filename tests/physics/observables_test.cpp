// Observables against what is known of hard disks, within their own errors. Also a test of these errors: a sum of squares of
// deviations over errors is held against chi squared.

#include "observe/observed_system.hpp"

#include "theory/equation_of_state.hpp"
#include "theory/kinetic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace carom::test {
namespace {

constexpr double within = 4.0;  ///< standard errors: one test in 16 000 fails by chance

struct Value {
  double value, error;
};
Value of(const Observed& o, const char* observable, const char* name) {
  const Scalar& scalar = o.scalar(observable, name);
  return {scalar.value.value(), scalar.error.value()};
}

Scene gas(double packing_fraction, const char* rule, int disks, double time) {
  return parse_scene(fmt::format(
      "[box]\naspect = 1.0\nboundary = \"periodic\"\n[[disks]]\ncount = {}\nradius = 0.5\nmass = 1.0\npacking_fraction = "
      "{}\npositions = "
      "\"hexagonal\"\nvelocities = {{ temperature = 1.0 }}\n[collision]\nrule = \"{}\"\n[run]\ntime = {}\nequilibrate = {{ "
      "collisions_per_disk = 100 }}\n[observe]\npressure = true\ncollision_rate = true\nfree_flight = true\nvelocity_moments = "
      "true\n"
      "radial_distribution = true\nstructure_factor = {{ largest = 20.0 }}\nvelocity_autocorrelation = true\n"
      "mean_square_displacement = true\n{}",
      disks, packing_fraction, rule, time,
      rule == std::string("specular") ? "viscosity = true\nheat_conductivity = true\n" : ""));
}

class PhysicsObservables : public ::testing::TestWithParam<double> {};

TEST_P(PhysicsObservables, OfAFluidAgreeWithEachOtherAndWithTheory) {
  const double eta = GetParam();
  const int disks = 256;
  const double N = disks;
  const Observed o = observe(gas(eta, "specular", disks, 1000.0), 1000.0);
  const Value Z = of(o, "pressure", "Z"), rate = of(o, "collision_rate", "rate"),
              contact = of(o, "radial_distribution", "contact");
  EXPECT_NEAR(Z.value, theory::kolafa_rottner_finite(eta, disks), within * Z.error);
  const Value from_rate = of(o, "pressure", "Z_rate");
  EXPECT_NEAR(Z.value, from_rate.value, within * std::hypot(Z.error, from_rate.error));
  // g(sigma+) of the finite system is (Z - 1) / 2 eta times N / (N - 1): g counts pairs against N (N - 1) / 2, and kT is K / (N -
  // 1).
  const double g = (Z.value - 1.0) / (2.0 * eta) * N / (N - 1.0);
  EXPECT_NEAR(contact.value, g, within * std::hypot(contact.error, Z.error / (2.0 * eta)));
  // Mean free path = <v> / omega; the large-N formula is 1 / (2 sqrt2 rho sigma g), with <v> less by 1 / 4 N and more at most 1 /
  // N.
  const Value path = of(o, "free_flight", "mean_free_path"), time = of(o, "free_flight", "mean_free_time");
  const double rho = 4.0 * eta / std::numbers::pi;
  EXPECT_NEAR(path.value * 2.0 * std::numbers::sqrt2 * rho * (Z.value - 1.0) / (2.0 * eta), 1.0,
              1.0 / N + within * std::hypot(path.error / path.value, Z.error / (Z.value - 1.0)));
  // Flights that do not end within the run make the mean shorter by one in as many as a disk has, some thousand.
  EXPECT_NEAR(time.value * rate.value, 1.0,
              1.0 / (rate.value * 1000.0) + within * std::hypot(time.error / time.value, rate.error / rate.value));
  const Value kurtosis = of(o, "velocity_moments", "kurtosis");
  EXPECT_NEAR(kurtosis.value, 2.0 * (N - 1.0) / N, within * kurtosis.error);
  // omega N / (N - 1) d / (d + 1), d = 2 N - 2: mean square of the normal velocity at collisions, with energy and momentum kept.
  const Value slope = of(o, "velocity_autocorrelation", "initial_slope");
  const double d = 2.0 * N - 2.0;
  EXPECT_NEAR(slope.value, rate.value * N / (N - 1.0) * d / (d + 1.0), within * std::hypot(slope.error, rate.error));
}

TEST_P(PhysicsObservables, OfTransportAtOnceFollowFromThePressure) {
  // Twice the growth of the moments at one step less that at two comes to lag 0 along a straight line: half of the correlation at
  // lag 0, less half of that at lag 1. What flows between collisions bends the line by less than 0.1 % (docs/validation.md).
  const double eta = GetParam();
  constexpr int disks = 256;
  const double step = 0.02 / theory::disk_collision_rate(theory::kolafa_rottner(eta));
  const double time = 200'000.0 * step;  // half a million collisions
  Scene scene = gas(eta, "specular", disks, time);
  for (ObservableRequest& request : scene.observe) request.every = step;
  std::erase_if(scene.observe, [](const ObservableRequest& request) {
    return request.name != "viscosity" && request.name != "heat_conductivity";
  });
  const Observed o = observe(scene, time);
  const auto held = [&](const char* name, double expected) {
    const auto &integral = o.column(name, 0, "green_kubo"), &integral_error = o.column(name, 0, "green_kubo_error");
    const auto &products = o.column(name, 0, "correlation"), &products_error = o.column(name, 0, "correlation_error");
    const double scale = integral[0] / products[0];
    const double error = std::hypot(integral_error[0], scale * products_error[1]);
    EXPECT_NEAR(integral[0] - scale * products[1], expected, within * error + 0.001 * expected) << name;
    EXPECT_LT(error, 0.03 * expected) << "an error so large that it would hide everything";
  };
  held("viscosity", theory::instantaneous_viscosity(eta, disks));
  held("heat_conductivity", theory::instantaneous_conductivity(eta, disks));
}

TEST_P(PhysicsObservables, OfTransportAreNearEnskog) {
  const double eta = GetParam();
  const Observed o = observe(gas(eta, "specular", 256, 1000.0), 1000.0);
  // Enskog's theory, which is good to about 10 % at these densities: the whole integrals, whose beginning is held to 0.1 % above.
  const double viscosity = theory::enskog_viscosity(eta), conductivity = theory::enskog_conductivity(eta);
  const double diffusion = theory::enskog_diffusion(eta);
  const Value eta_found = of(o, "viscosity", "green_kubo"), lambda = of(o, "heat_conductivity", "green_kubo");
  EXPECT_NEAR(eta_found.value, viscosity, 0.1 * viscosity + within * eta_found.error);
  EXPECT_NEAR(lambda.value, conductivity, 0.1 * conductivity + within * lambda.error);
  // After its first collisions a disk is carried by the vortex that it has made: the correlation has a tail a / t with a = kT /
  // (8 pi rho m (D + nu)) (Ernst, Hauge & van Leeuwen, Phys. Rev. Lett. 25, 1254 (1970)). So D lies above Enskog's by at most
  // what the tail adds from the first collision on.
  const double rate = o.value("collision_rate", "rate"), rho = 4.0 * eta / std::numbers::pi;
  const double tail = 1.0 / (8.0 * std::numbers::pi * rho * (diffusion + viscosity / rho));
  const auto& until = o.column("velocity_autocorrelation", 0, "integral_to");
  const auto& D = o.column("velocity_autocorrelation", 0, "diffusion");
  std::size_t row = 0;
  while (until[row] < 20.0 / rate) ++row;
  EXPECT_GT(D[row], 0.9 * diffusion);
  EXPECT_LT(D[row], 1.1 * diffusion + tail * std::log(until[row] * rate));
}

INSTANTIATE_TEST_SUITE_P(Physics, PhysicsObservables, ::testing::Values(0.2, 0.4),
                         [](const auto& eta) { return fmt::format("At{:.0f}Percent", 100.0 * eta.param); });

TEST(PhysicsReversal, AutocorrelationFallsOneAndAHalfTimesAsFast) {
  // Both disks change by all of their relative velocity g, so the slope is the rate times <g^2> / 2 <v^2>, pairs counted by how
  // often they meet, in proportion to g: 3/2 in a Maxwell gas. The set of velocities never changes, so the draw tells what it is
  // here.
  const Observed o = observe(gas(0.3, "reversal", 256, 500.0), 500.0);
  const Eigen::Matrix2Xd& v = o.record.states.front().velocities;
  double first = 0.0, third = 0.0;
  for (Eigen::Index i = 0; i < 256; ++i)
    for (Eigen::Index j = 0; j < i; ++j) {
      const double g = (v.col(i) - v.col(j)).norm();
      first += g;
      third += g * g * g;
    }
  const double expected = third / first / (2.0 * v.squaredNorm() / 256.0);
  EXPECT_NEAR(expected, 1.5, 4.0 / std::sqrt(256.0)) << "moments of 256 Maxwell velocities";
  const Value slope = of(o, "velocity_autocorrelation", "initial_slope"), rate = of(o, "collision_rate", "rate");
  EXPECT_NEAR(slope.value / rate.value, expected,
              within * expected * std::hypot(slope.error / slope.value, rate.error / rate.value));
  // Kurtosis is that of the draw at every instant.
  EXPECT_LT(of(o, "velocity_moments", "kurtosis").error, 1e-12);
}

TEST(PhysicsStructure, SmallestWavesTellTheCompressibility) {
  // S(0) = 1 / (Z + eta Z'): 0.4 of the ideal gas's at eta = 0.2, where S(k) is flat to 2 % up to the smallest k of this box.
  const double eta = 0.2, h = 1e-4;
  const Observed o = observe(gas(eta, "specular", 400, 1500.0), 1500.0);
  const double slope = (theory::kolafa_rottner(eta + h) - theory::kolafa_rottner(eta - h)) / (2.0 * h);
  const double expected = 1.0 / (theory::kolafa_rottner(eta) + eta * slope);
  EXPECT_NEAR(o.column("structure_factor", 0, "S")[0], expected,
              0.02 * expected + within * o.column("structure_factor", 0, "S_error")[0]);
}

/// Scatter over reported error, both squared.
double chi_squared_per_run(const std::vector<Value>& values) {
  const double runs = static_cast<double>(values.size());
  double mean = 0.0, scatter = 0.0, reported = 0.0;
  for (const Value& one : values) mean += one.value / runs;
  for (const Value& one : values) {
    scatter += std::pow(one.value - mean, 2) / (runs - 1.0);
    reported += one.error * one.error / runs;
  }
  return scatter / reported;
}

TEST(PhysicsErrors, OfWhatWallsGetAndOfDisplacementsAtLongLagsScatterAsTheySay) {
  constexpr int runs = 48;
  std::vector<Value> left, top, Z_walls, farthest;
  for (int r = 0; r < runs; ++r) {
    Scene scene = parse_scene(
        "[box]\naspect = 1.0\nboundary = \"walls\"\n[[disks]]\ncount = 36\nradius = 0.5\nmass = 1.0\npacking_fraction = 0.3\n"
        "positions = \"random\"\nvelocities = { temperature = 1.0 }\n[collision]\nrule = \"specular\"\n[run]\ntime = 120.0\n"
        "equilibrate = { collisions_per_disk = 30 }\n[observe]\nwall_fluxes = true\npressure = true\n");
    scene.run.seed = static_cast<std::uint64_t>(r + 1);
    const Observed walls = observe(scene, 120.0);
    left.push_back(of(walls, "wall_fluxes", "momentum_left"));
    top.push_back(of(walls, "wall_fluxes", "momentum_top"));
    Z_walls.push_back(of(walls, "pressure", "Z_walls"));
    scene = parse_scene(small_fluid("mean_square_displacement = { every = 0.5 }", "specular", "128.0"));
    scene.run.seed = static_cast<std::uint64_t>(r + 1);
    const Observed fluid = observe(scene, 128.0);
    // 0.5 * 2 * 15 steps: a run of 8.5 of it, the longest whose error is known throughout.
    const auto &lag = fluid.column("mean_square_displacement", 0, "lag"),
               &msd = fluid.column("mean_square_displacement", 0, "msd"),
               &error = fluid.column("mean_square_displacement", 0, "msd_error");
    const auto row = static_cast<std::size_t>(std::ranges::find(lag, 15.0) - lag.begin());
    ASSERT_LT(row, lag.size());
    farthest.push_back({msd[row], error[row]});
    EXPECT_TRUE(std::isnan(error.back()));
  }
  // Chi squared over 47: standard deviation sqrt(2 / 47) = 0.21; the mean of 48 squared errors is known to 0.08 and better.
  for (const std::vector<Value>* values : {&left, &top, &Z_walls, &farthest}) {
    EXPECT_GT(chi_squared_per_run(*values), 1.0 - 3.0 * 0.22);
    EXPECT_LT(chi_squared_per_run(*values), 1.0 + 4.0 * 0.22);
  }
}

/// The first peak of a crystal is as narrow as the gaps between neighbours, and the cubic through it has to follow.
TEST(PhysicsCrystal, ContactValueIsThatOfThePressure) {
  constexpr double N = 100.0, error_of_cubic = 1e-3;
  for (const double eta : {0.74, 0.78, 0.82, 0.86, 0.89}) {
    const Observed o = observe(
        parse_scene(fmt::format(
            "[box]\naspect = 1.1547005383792517\nboundary = \"periodic\"\n[[disks]]\ncount = 100\nradius = 0.5\nmass = 1.0\n"
            "packing_fraction = {}\npositions = \"hexagonal\"\nvelocities = {{ temperature = 1.0 }}\n[collision]\n"
            "rule = \"specular\"\n[run]\ntime = 100.0\nequilibrate = {{ collisions_per_disk = 100 }}\n[observe]\n"
            "pressure = true\nradial_distribution = true\n",
            eta)),
        100.0);
    const Value Z = of(o, "pressure", "Z"), contact = of(o, "radial_distribution", "contact");
    const double g = (Z.value - 1.0) / (2.0 * eta) * N / (N - 1.0);
    EXPECT_NEAR(contact.value, g, within * std::hypot(contact.error, Z.error / (2.0 * eta)) + error_of_cubic * g) << eta;
    EXPECT_LT(contact.error, 0.015 * g) << eta;
  }
}

/// Errors are neither too small nor too large: 24 runs, each against the mean of all.
TEST(PhysicsErrors, OfIndependentRunsScatterAsTheySay) {
  constexpr int runs = 24;
  std::vector<Value> Z, contact, kurtosis;
  for (int r = 0; r < runs; ++r) {
    Scene scene = parse_scene(
        small_fluid("pressure = true\nvelocity_moments = true\nradial_distribution = { range = 3.0 }", "specular", "300.0"));
    scene.run.seed = static_cast<std::uint64_t>(r + 1);
    scene.run.equilibrate = Run::Equilibrate{.collisions_per_disk = 50.0, .time = std::nullopt};
    const Observed o = observe(scene, 300.0);
    Z.push_back(of(o, "pressure", "Z"));
    contact.push_back(of(o, "radial_distribution", "contact"));
    kurtosis.push_back(of(o, "velocity_moments", "kurtosis"));
  }
  for (const std::vector<Value>* values : {&Z, &contact, &kurtosis}) {
    // Chi squared over 23: standard deviation sqrt(2 / 23) = 0.29; errors are themselves known to about a tenth.
    EXPECT_GT(chi_squared_per_run(*values), 1.0 - 3.0 * 0.29);
    EXPECT_LT(chi_squared_per_run(*values), 1.0 + 4.0 * 0.29);
  }
}

TEST(PhysicsDisplacement, BeginsBallisticallyAndBendsAsTheCollisionRateSays) {
  // <dx^2> = v_T^2 t^2 (1 - s t / 3 + ...): the velocity's correlation is v_T^2 (1 - s t) at first, because a collision takes
  // g_n^2 / 2 from v.v' of each disk. Over all velocities that is omega; of N disks at fixed energy and momentum 0, with
  // d = 2 N - 2 degrees of freedom, the mean of g_n^2 in collisions is 4 d / (d + 1), and <v^2> = 2 (N - 1) / N, at kT = 1.
  constexpr int disks = 128, runs = 16;
  for (const double eta : {0.1, 0.4}) {
    constexpr double N = disks, d = 2.0 * N - 2.0;
    const double slope = theory::disk_collision_rate(eta, disks) * N * d / ((N - 1.0) * (d + 1.0)), h = 0.05 / slope;
    double sum = 0.0, squares = 0.0;
    for (int seed = 1; seed <= runs; ++seed) {
      const Observed o = observe(
          parse_scene(fmt::format("[box]\naspect = 1.0\nboundary = \"periodic\"\n[[disks]]\ncount = {}\nradius = 0.5\nmass = "
                                  "1.0\npacking_fraction = {}\npositions = \"hexagonal\"\nvelocities = {{ temperature = 1.0 "
                                  "}}\n[collision]\nrule = \"specular\"\n[run]\nseed = {}\ntime = {}\nequilibrate = {{ "
                                  "collisions_per_disk = 50 }}\n[observe]\nmean_square_displacement = {{ every = {} }}\n",
                                  disks, eta, seed, 6000.0 * h, h)),
          6000.0 * h);
      const std::vector<double>&lag = o.column("mean_square_displacement", 0, "lag"),
            &msd = o.column("mean_square_displacement", 0, "msd");
      const auto bend = [&](double time) {
        const auto row = static_cast<std::size_t>(
            std::find_if(lag.begin(), lag.end(), [&](double at) { return std::abs(at - time) < 1e-9 * time; }) - lag.begin());
        return (1.0 - msd.at(row) / (2.0 * (N - 1.0) / N * time * time)) / time;  // s / 3 - constant * t
      };
      const double found = 3.0 * (2.0 * bend(h) - bend(2.0 * h));
      sum += found / runs, squares += found * found / runs;
    }
    const double error = std::sqrt((squares - sum * sum) / (runs - 1.0));
    RecordProperty(fmt::format("slope_{}", eta), testing::PrintToString(sum / slope));
    RecordProperty(fmt::format("error_{}", eta), testing::PrintToString(error / slope));
    // Of an exponential correlation a straight line through two lags leaves (s h)^2 / 10, 2.5e-4, of the slope; five errors of 16
    // runs are four of a normal variable.
    EXPECT_NEAR(sum, slope, 5.0 * error + 1e-3 * slope) << eta;
    EXPECT_LT(error, 0.005 * slope);
  }
}

}  // namespace
}  // namespace carom::test
