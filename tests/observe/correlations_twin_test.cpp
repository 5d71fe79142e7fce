// Observables that follow disks through time against sums over all pairs of the states that they saw.

#include "observe/observed_system.hpp"
#include "support/systems.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

namespace carom::test {
namespace {

constexpr double rounding_of_correlations = 1e-11;  // of sums over 1e4 terms of order one

const Observed& fluid_with_correlations() {
  static const Observed observed = observe(
      parse_scene(small_fluid("mean_square_displacement = { every = 0.05 }\nvelocity_autocorrelation = { every = 0.05 }")), 0.05);
  return observed;
}

/// Mean of f(earlier, later) over pairs of states k steps apart, the first at a multiple of `stride`.
template <class F>
double over_pairs(const Observed& o, std::size_t k, std::size_t stride, F f) {
  double sum = 0.0, count = 0.0;
  for (std::size_t t = 0; t + k < o.record.states.size(); t += stride) {
    sum += f(o.record.states[t], o.record.states[t + k]);
    count += 1.0;
  }
  return sum / count;
}

TEST(ObservedCorrelations, MeanSquareDisplacementIsThatOfAllPairsOfStates) {
  const Observed& o = fluid_with_correlations();
  const auto& lags = o.column("mean_square_displacement", 0, "lag");
  ASSERT_GT(lags.size(), 25U);
  for (std::size_t r = 0; r < lags.size(); ++r) {
    const auto k = static_cast<std::size_t>(std::lround(lags[r] / 0.05));
    // Beyond 15 steps pairs are those on a grid of 2, 4, 8, ... steps: the smallest power that leaves fewer than 16 of them.
    std::size_t stride = 1;
    while (k / stride >= 16) stride *= 2;
    const double msd = over_pairs(o, k, stride, [&](const State& a, const State& b) {
      return (unwrapped(o.scene.box, b) - unwrapped(o.scene.box, a)).squaredNorm() / 40.0;
    });
    EXPECT_NEAR(o.column("mean_square_displacement", 0, "msd")[r], msd, rounding_of_correlations) << "lag " << lags[r];
    EXPECT_NEAR(o.column("mean_square_displacement", 0, "diffusion")[r], msd / (4.0 * lags[r]), rounding_of_correlations);
  }
}

/// Disks so small that they hardly meet, whose velocities a bath draws anew.
Observed in_a_bath(double rate, double time, const std::string& observable) {
  return observe(parse_scene(fmt::format(
                     "[box]\nx = [0.0, 10.0]\ny = [0.0, 10.0]\nboundary = \"periodic\"\n[[disks]]\ncount = 40\nradius = 0.005\n"
                     "mass = 2.0\npositions = \"random\"\nvelocities = {{ temperature = 1.0 }}\n[collision]\nrule = "
                     "\"specular\"\n[thermostat]\ntemperature = 1.0\nrate = {}\n[run]\ntime = {}\n[observe]\n{}\n",
                     rate, time, observable)),
                 time);
}

/// 40 disks have 80 displacements along an axis in each window.
TEST(ObservedCorrelations, DiffusionIsThatOfTheLongestLagWithEnoughDisplacements) {
  const Observed o = in_a_bath(1.0, 1000.0, "mean_square_displacement = { every = 0.5 }");
  const Scalar& D = o.scalar("mean_square_displacement", "diffusion");
  const auto column = [&](const char* name) { return o.column("mean_square_displacement", 0, name); };
  double lag = 0.0;
  for (std::size_t row = 0; row < column("lag").size(); ++row)
    if (80.0 * 1000.0 / column("lag")[row] >= 800.0) lag = column("lag")[row];
  ASSERT_GT(lag, 60.0);
  EXPECT_THAT(D.note, testing::StartsWith(fmt::format("at lag {:.4g}, the longest", lag)));
  // <v(0) v(t)> falls as exp(-t) from kT/m = 1/2 of each component: D(t) = (1 - (1 - exp(-t)) / t) / 2.
  EXPECT_NEAR(*D.value, 0.5 * (1.0 - (1.0 - std::exp(-lag)) / lag), 4.0 * *D.error);
  EXPECT_LE(*D.error, 0.07 * *D.value) << "chance alone leaves 4 %, of windows that overlap";
  EXPECT_EQ(D.unit, "length^2 / time");
  const Scalar none =
      in_a_bath(1.0, 4.5, "mean_square_displacement = { every = 0.5 }").scalar("mean_square_displacement", "diffusion");
  EXPECT_FALSE(none.value);
  EXPECT_EQ(none.note, "the run is too short: of no lag does it hold 800 displacements along an axis");
}

/// Disks that hardly meet, in a bath and a field g along x, drift at u = g / rate. Between two redraws, s apart, a disk goes v s
/// + g s^2 / 2. With s exponential that spreads by <(v s + g s^2 / 2 - u s)^2> = 2 kT / m + 2 g^2 in a mean time of 1, at rate 1.
TEST(ObservedCorrelations, DriftInAFieldIsNoDiffusion) {
  const std::string observable =
      "mean_square_displacement = { every = 0.5 }\nvelocity_autocorrelation = { every = 0.5 }\n"
      "[gravity]\nacceleration = [0.3, 0.0]";
  const Observed o = in_a_bath(1.0, 1000.0, observable);
  const Scalar& D = o.scalar("mean_square_displacement", "diffusion");
  double lag = 0.0;
  ASSERT_EQ(std::sscanf(D.note.c_str(), "at lag %lf", &lag), 1);
  EXPECT_NEAR(*D.value, 0.5 * (1.0 - (1.0 - std::exp(-lag)) / lag) + 0.5 * 0.09, 4.0 * *D.error);
  EXPECT_GT(0.09 * lag / 4.0, 20.0 * *D.error) << "u^2 t / 4, which the drift would add";
  const std::vector<double>&correlation = o.column("velocity_autocorrelation", 0, "correlation"),
        &errors = o.column("velocity_autocorrelation", 0, "correlation_error");
  EXPECT_NEAR(correlation[20], 0.0, 4.0 * errors[20]) << "and not u^2, 0.09";
  EXPECT_LT(errors[20], 0.01);
}

TEST(ObservedCorrelations, RelaxationTimeIsWhereTheOverlapFallsToOneOverE) {
  const Observed o = in_a_bath(0.02, 1500.0, "overlap = { every = 0.05, range = 30.0 }");
  const Scalar& found = o.scalar("overlap", "relaxation_time");
  // Of Maxwell's velocities the share 1 - exp(-m a^2 / 2 kT t^2) moves less than a = 0.3 in t, m / 2 kT = 1.
  EXPECT_NEAR(found.value.value(), 0.3 / std::sqrt(-std::log(1.0 - std::exp(-1.0))), 4.0 * found.error.value());
}

/// Between two rows the function is a line in the logarithm of the lag, and errs by no more than the errors of both in
/// proportion.
TEST(ObservedCorrelations, RelaxationTimeErrsAsTheLineBetweenBothRows) {
  const Observed o = in_a_bath(0.02, 1500.0, "overlap = { every = 0.05, range = 30.0 }");
  const std::vector<double>&lag = o.column("overlap", 0, "lag"), &overlap = o.column("overlap", 0, "overlap"),
        &error = o.column("overlap", 0, "overlap_error");
  const double level = std::exp(-1.0);
  std::size_t row = 1;
  while (!(overlap[row - 1] >= level && overlap[row] < level)) ++row;
  const double per_logarithm = (overlap[row - 1] - overlap[row]) / std::log(lag[row] / lag[row - 1]);
  const double time = lag[row - 1] * std::exp((overlap[row - 1] - level) / per_logarithm);
  const double way = std::log(time / lag[row - 1]) / std::log(lag[row] / lag[row - 1]);
  const Scalar& found = o.scalar("overlap", "relaxation_time");
  EXPECT_NEAR(found.value.value(), time, 1e-12);
  EXPECT_NEAR(found.error.value(), ((1.0 - way) * error[row - 1] + way * error[row]) * time / per_logarithm, 1e-12);
}

TEST(ObservedCorrelations, VelocityAutocorrelationAtShortLagsIsThatOfAllPairsOfStates) {
  const Observed& o = fluid_with_correlations();
  for (std::size_t k = 0; k < 16; ++k) {
    ASSERT_EQ(o.column("velocity_autocorrelation", 0, "window")[k], 0.0);
    const double found =
        over_pairs(o, k, 1, [](const State& a, const State& b) { return a.velocities.cwiseProduct(b.velocities).sum() / 40.0; });
    EXPECT_NEAR(o.column("velocity_autocorrelation", 0, "correlation")[k], found, rounding_of_correlations) << "lag " << k;
  }
}

/// By way of displacements over windows of the second level, two steps each.
TEST(ObservedCorrelations, LongerLagsCorrelateDisplacementsOverWindows) {
  const Observed& o = fluid_with_correlations();
  std::vector<Eigen::Matrix2Xd> means;
  for (std::size_t t = 0; t + 2 < o.record.states.size(); t += 2)
    means.push_back((unwrapped(o.scene.box, o.record.states[t + 2]) - unwrapped(o.scene.box, o.record.states[t])) / 0.1);
  const auto& windows = o.column("velocity_autocorrelation", 0, "window");
  int compared = 0;
  for (std::size_t r = 0; r < windows.size(); ++r) {
    if (std::abs(windows[r] - 0.1) > 1e-12) continue;
    const auto k = static_cast<std::size_t>(std::lround(o.column("velocity_autocorrelation", 0, "lag")[r] / 0.1));
    double sum = 0.0;
    for (std::size_t t = k; t < means.size(); ++t) sum += means[t].cwiseProduct(means[t - k]).sum() / 40.0;
    EXPECT_NEAR(o.column("velocity_autocorrelation", 0, "correlation")[r], sum / static_cast<double>(means.size() - k),
                rounding_of_correlations);
    ++compared;
  }
  EXPECT_EQ(compared, 8);
}

/// The running integral of mean velocities telescopes into mean square displacements.
TEST(ObservedCorrelations, DiffusionCoefficientIsTheSlopeOfTheDisplacement) {
  const Observed o = observe(parse_scene(small_fluid("velocity_autocorrelation = { every = 0.05 }", "specular", "40.0")), 0.05);
  const auto square = [&](std::size_t k) {
    return over_pairs(o, k, 1, [&](const State& a, const State& b) {
      return (unwrapped(o.scene.box, b) - unwrapped(o.scene.box, a)).squaredNorm() / 40.0;
    });
  };
  for (const std::size_t k : {0U, 3U, 10U}) {
    const double slope = (square(k + 1) - (k > 0 ? square(k) : 0.0)) / (4.0 * 0.05);
    // Of 800 products the ones near both ends differ: (k + 1) / 800 of the sums, each of order <v^2> times the time, 0.5.
    EXPECT_NEAR(o.column("velocity_autocorrelation", 0, "diffusion")[k], slope, 1.3 * 0.5 * static_cast<double>(k + 1) / 800.0);
  }
}

TEST(ObservedCorrelations, FreeDisksGoAsTheSquareOfTime) {
  // Four disks that pass each other for ever along rows: v^2 t^2, and a correlation that never falls.
  const Scene scene = parse_scene(
      "[box]\nx = [0.0, 8.0]\ny = [0.0, 8.0]\nboundary = \"periodic\"\n[[disks]]\nradius = 0.5\nmass = 1.0\n"
      "positions = [[1.0, 1.0], [2.0, 3.0], [4.0, 5.0], [6.0, 7.0]]\nvelocities = [[1.0, 0.0], [-1.0, 0.0], [2.0, 0.0], [-2.0, "
      "0.0]]\n"
      "[collision]\nrule = \"specular\"\n[run]\ntime = 50.0\n[observe]\nmean_square_displacement = { every = 0.25 }\n"
      "velocity_autocorrelation = { every = 0.25 }\n");
  const Observed o = observe(scene, 0.25);
  ASSERT_EQ(o.totals.pair, 0U);
  const auto& lags = o.column("mean_square_displacement", 0, "lag");
  // Positions are exact to 1e-15 of the box; displacements of up to 100 to 1e-14 of themselves.
  for (std::size_t r = 0; r < lags.size(); ++r)
    EXPECT_NEAR(o.column("mean_square_displacement", 0, "msd")[r] / (2.5 * lags[r] * lags[r]), 1.0, 1e-12);
  for (const double correlation : o.column("velocity_autocorrelation", 0, "correlation")) EXPECT_NEAR(correlation, 2.5, 1e-12);
  EXPECT_EQ(o.value("velocity_autocorrelation", "initial_slope"), 0.0);
}

TEST(ObservedCorrelations, FollowAsManyDisksAsAreAskedFor) {
  // Free disks, no two with the same speed: the mean square of so many of them, and no other number, is the correlation.
  for (const int count : {1, 2, 3}) {
    const Scene scene = parse_scene(
        "[box]\nx = [0.0, 8.0]\ny = [0.0, 8.0]\nboundary = \"periodic\"\n[[disks]]\nradius = 0.5\nmass = 1.0\n"
        "positions = [[1.0, 1.0], [2.0, 3.0], [4.0, 5.0]]\nvelocities = [[1.0, 0.0], [-3.0, 0.0], [2.0, 0.0]]\n"
        "[collision]\nrule = \"specular\"\n[run]\ntime = 50.0\n[observe]\n"
        "velocity_autocorrelation = { every = 0.25, disks = " +
        std::to_string(count) + " }\n");
    const double correlation = observe(scene, 0.25).column("velocity_autocorrelation", 0, "correlation")[0];
    const std::vector<std::vector<double>> possible = {{1.0, 4.0, 9.0}, {2.5, 5.0, 6.5}, {14.0 / 3.0}};
    EXPECT_THAT(possible[static_cast<std::size_t>(count - 1)], testing::Contains(testing::DoubleNear(correlation, 1e-12)));
  }
}

TEST(ObservedCorrelations, DisplacementsBetweenWallsSayThatTheirErrorsAreTooLarge) {
  const auto note_in = [](const std::string& boundary) {
    const Scene scene =
        parse_scene("[box]\nx = [0.0, 8.0]\ny = [0.0, 8.0]\nboundary = \"" + boundary +
                    "\"\n[[disks]]\nradius = 0.5\nmass = 1.0\npositions = [[1.0, 1.0], [2.0, 3.0]]\n"
                    "velocities = [[1.0, 0.5], [-1.0, 0.5]]\n[collision]\nrule = \"specular\"\n[run]\ntime = 50.0\n"
                    "[observe]\nmean_square_displacement = { every = 0.25 }\n");
    return observe(scene, 0.25).of("mean_square_displacement").note;
  };
  EXPECT_NE(note_in("walls").find("between walls"), std::string::npos);
  EXPECT_EQ(note_in("periodic").find("between walls"), std::string::npos);
}

TEST(ObservedCorrelations, DisplacementsOfFewDisksSayThatTheirErrorsAreTooLarge) {
  const auto note_of = [](std::int64_t disks) {
    Scene scene = gas_scene(disks, 0.3, Boundary::periodic);
    scene.run.time = 20.0;
    scene.observe = {{.name = "mean_square_displacement", .every = 0.25}};
    return observe(scene, 0.25).of("mean_square_displacement").note;
  };
  EXPECT_THAT(note_of(8), testing::HasSubstr("so few disks"));
  EXPECT_THAT(note_of(64), testing::Not(testing::HasSubstr("so few disks")));
}

TEST(ObservedCorrelations, CommonMotionDoesNotCount) {
  // One velocity for all: nothing diffuses. Drifts of 1 over 50 leave rounding of 1e-14 of that.
  const Scene scene = parse_scene(
      "[box]\nx = [0.0, 8.0]\ny = [0.0, 8.0]\nboundary = \"periodic\"\n[[disks]]\nradius = 0.5\nmass = 1.0\n"
      "positions = [[1.0, 1.0], [2.0, 3.0]]\nvelocities = [[1.0, 0.5], [1.0, 0.5]]\n"
      "[collision]\nrule = \"specular\"\n[run]\ntime = 50.0\n[observe]\nmean_square_displacement = { every = 0.25 }\n");
  const Observed o = observe(scene, 0.25);
  for (const double msd : o.column("mean_square_displacement", 0, "msd")) EXPECT_LT(msd, 1e-24);
}

TEST(ObservedCorrelations, InitialSlopeCountsEveryChangeOfVelocity) {
  const Observed& o = fluid_with_correlations();
  std::map<std::int32_t, Eigen::Vector2d> velocity;
  for (std::int32_t i = 0; i < 40; ++i) velocity[i] = o.record.states.front().velocities.col(i);
  double changes = 0.0;
  for (const Event& event : o.record.events) {
    changes +=
        (event.velocity - velocity[event.disk]).squaredNorm() + (event.partner_velocity - velocity[event.partner]).squaredNorm();
    velocity[event.disk] = event.velocity;
    velocity[event.partner] = event.partner_velocity;
  }
  const double square = o.record.states.front().velocities.squaredNorm();  // conserved
  EXPECT_NEAR(o.value("velocity_autocorrelation", "initial_slope"), 0.5 * changes / (square * 5.0), rounding_of_correlations);
}

TEST(ObservedAutocorrelation, HasNoInitialSlopeWhereEnergyIsLost) {
  std::string scene = small_fluid("velocity_autocorrelation = true");
  scene.replace(scene.find("rule = \"specular\""), 17, "rule = \"specular\"\nrestitution = 0.9");
  const Observed o = observe(parse_scene(scene), 1.0);
  EXPECT_FALSE(o.scalar("velocity_autocorrelation", "initial_slope").value);
  EXPECT_NE(o.scalar("velocity_autocorrelation", "initial_slope").note.find("energy"), std::string::npos);
}

}  // namespace
}  // namespace carom::test
