// The first and the second half of a run compared: what drifts is named, and what is in equilibrium is not.

#include "observe/drift.hpp"
#include "observe/observed_system.hpp"

#include <carom/blocking.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

namespace carom::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A series with a correlation of 1/2 from each number to the next; `trend` is added over all of it.
Blocking correlated_series(int length, double trend, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  const auto noise = [&] {
    double sum = 0.0;  // of twelve uniform numbers, whose variance is 1
    for (int k = 0; k < 12; ++k) sum += static_cast<double>(engine() >> 11U) * 0x1p-53 - 0.5;
    return sum;
  };
  Blocking series;
  double x = noise();
  for (int t = 0; t < length; ++t) {
    series.add(x + trend * t / length, 2.0);
    x = 0.5 * x + std::sqrt(0.75) * noise();
  }
  return series;
}

TEST(HalvesOfASeries, DifferByChanceAsOftenAsTheProbabilitySays) {
  constexpr int series = 2000;
  int compared = 0, below_tenth = 0, below_hundredth = 0;
  for (int s = 0; s < series; ++s) {
    const std::optional<Halves> halves = correlated_series(1500, 0.0, 17 + static_cast<std::uint64_t>(s)).halves();
    if (!halves) continue;
    ++compared;
    below_tenth += halves->probability < 0.1 ? 1 : 0;
    below_hundredth += halves->probability < 0.01 ? 1 : 0;
  }
  ASSERT_GT(compared, series / 2);
  // Four standard deviations of a count, and what a too short block leaves: one part in ten.
  EXPECT_NEAR(below_tenth, 0.1 * compared, 0.01 * compared + 4.0 * std::sqrt(0.09 * compared));
  EXPECT_LT(below_hundredth, 0.012 * compared + 4.0 * std::sqrt(0.01 * compared));
}

TEST(HalvesOfASeries, AreTheMeansOfItsParts) {
  Blocking series;
  std::mt19937_64 engine(3);
  std::vector<double> values;
  for (int t = 0; t < 700; ++t) {
    values.push_back(static_cast<double>(engine() >> 11U) * 0x1p-53);
    series.add(values.back(), 4.0);
  }
  const std::optional<Halves> halves = series.halves();
  ASSERT_TRUE(halves);
  const auto first = static_cast<std::size_t>(std::lround(halves->share * 700.0));
  EXPECT_EQ(first, 256U) << "a power of two between 0.3 and 0.6 of all";
  double mean = 0.0, rest = 0.0;
  for (std::size_t k = 0; k < 700; ++k) (k < first ? mean : rest) += values[k];
  EXPECT_NEAR(halves->first, mean / 256.0 / 4.0, 1e-13);
  EXPECT_NEAR(halves->rest, rest / 444.0 / 4.0, 1e-13);
  // Without correlations the difference has the variance 1/12 (1/256 + 1/444) / 16, that of 27 blocks known to a third.
  const double exact = std::sqrt((1.0 / 256.0 + 1.0 / 444.0) / 12.0) / 4.0;
  EXPECT_NEAR(halves->error, exact, 0.5 * exact);
}

TEST(HalvesOfASeries, TellATrendAndNothingOfFewSamples) {
  EXPECT_LT(correlated_series(4000, 1.0, 5).halves().value().probability, 1e-6);
  EXPECT_FALSE(correlated_series(40, 1.0, 5).halves());
  EXPECT_FALSE(Blocking().halves());
  Blocking constant;
  for (int t = 0; t < 1000; ++t) constant.add(t % 2 == 0 ? 1.0 : 1.0 + 1e-15);
  EXPECT_FALSE(constant.halves()) << "a conserved number scatters by rounding alone";
}

/// Twenty-four disks in contact with a bath, which they forget after one unit of time.
Scene bath(double begins_at, int seed) {
  return parse_scene(fmt::format(
      "[box]\nx = [0.0, 8.0]\ny = [0.0, 8.0]\nboundary = \"periodic\"\n[[disks]]\ncount = 24\nradius = 0.5\nmass = 1.0\n"
      "positions = \"hexagonal\"\nvelocities = {{ temperature = {:.1f} }}\n[collision]\nrule = \"specular\"\n"
      "[thermostat]\ntemperature = 1.0\nrate = 1.0\n[run]\ntime = 600.0\nseed = {}\n"
      "[observe]\ntemperature = {{ every = 1.0 }}\npressure = {{ every = 1.0 }}\nvelocity_moments = {{ every = 1.0 }}\n",
      begins_at, seed));
}

/// Expects of 24 runs in equilibrium that hardly any has a remark. `compared` counts what could have one in a measurement: more
/// than `at_least` in a run.
template <class MakeScene, class Compared>
void expect_no_drift_in_equilibrium(MakeScene&& scene_of, double time, Compared&& compared, std::size_t at_least) {
  constexpr int runs = 24;
  int said = 0;
  std::size_t all = 0;
  for (int seed = 1; seed <= runs; ++seed) {
    Scene scene = scene_of(1.0, seed);
    scene.run.equilibrate = Run::Equilibrate{.time = 50.0};
    const Observed run = observe(scene, time);
    for (const Measurement& one : run.measurements) all += compared(one);
    said += drifting_numbers(run.measurements).empty() ? 0 : 1;
  }
  EXPECT_GT(all, runs * at_least) << "or nothing could be said";
  EXPECT_LE(said, 2) << "one in a hundred of 24: three or more in one of 560 cases";
}

TEST(DriftOfARun, IsNotSaidInEquilibriumMoreOftenThanItsThreshold) {
  const auto numbers = [](const Measurement& one) {
    std::size_t compared = 0;
    for (const Scalar& scalar : one.scalars) compared += scalar.halves ? 1U : 0U;
    return compared;
  };
  expect_no_drift_in_equilibrium(bath, 100.0, numbers, 4);
}

TEST(DriftOfARun, IsSaidOfDisksThatBeginTooHot) {
  const Observed run = observe(bath(60.0, 1), 100.0);
  const std::vector<std::string> drifting = drifting_numbers(run.measurements);
  EXPECT_THAT(drifting, Contains("temperature.kT_x"));
  const Scalar& kT = run.scalar("temperature", "kT_x");
  EXPECT_THAT(kT.note, HasSubstr("not yet at equilibrium: "));
  EXPECT_THAT(kT.note, HasSubstr(" % of the samples and "));
  EXPECT_GT(kT.halves->first, kT.halves->rest);
}

TEST(DriftOfARun, ThresholdFallsWithTheNumberOfNumbers) {
  const auto measured = [](double probability, std::size_t others) {
    std::vector<Measurement> all(1);
    all[0].name = "a";
    all[0].scalars.push_back({.name = "x", .value = 1.0, .halves = Halves{.error = 1.0, .probability = probability}});
    for (std::size_t k = 0; k < others; ++k) all[0].scalars.push_back({.name = "y", .halves = Halves{.error = 1.0}});
    all[0].scalars.push_back({.name = "z", .value = 2.0});
    note_drifts(all, Effects{});
    return drifting_numbers(all);
  };
  EXPECT_THAT(measured(0.009, 0), testing::ElementsAre("a.x"));
  EXPECT_THAT(measured(0.009, 1), IsEmpty());
  EXPECT_THAT(measured(0.0009, 9), testing::ElementsAre("a.x"));
  EXPECT_THAT(measured(0.0011, 9), IsEmpty());
}

/// The same disks, whose tables are compared.
Scene bath_with_tables(double begins_at, int seed) {
  Scene scene = bath(begins_at, seed);
  scene.observe.clear();
  for (const char* name :
       {"radial_distribution", "mean_square_displacement", "overlap", "speeds", "structure_factor", "velocity_autocorrelation"})
    scene.observe.push_back({.name = name, .every = 1.0});
  return scene;
}

TEST(DriftOfATable, IsNotSaidInEquilibriumMoreOftenThanItsThreshold) {
  const auto rows = [](const Measurement& one) {
    std::size_t compared = 0;
    for (const Table& table : one.tables)
      for (const ColumnHalves& column : table.halves) compared += column.compared;
    return compared;
  };
  expect_no_drift_in_equilibrium(bath_with_tables, 400.0, rows, 50);
}

TEST(DriftOfATable, IsSaidWithTheRowThatDiffersMost) {
  Scene scene = bath_with_tables(4.0, 1);
  scene.effects.thermostat->rate = 0.02;  // disks forget their start after 50 units of time
  const Observed run = observe(scene, 400.0);
  EXPECT_THAT(drifting_numbers(run.measurements), Contains("speeds (its table)"));
  for (const Measurement& one : run.measurements)
    if (one.name == "speeds") {
      EXPECT_THAT(one.note, HasSubstr(" standard errors apart (density at middle = "));
    }
}

TEST(DriftOfATable, ThresholdFallsWithTheNumberOfRows) {
  const auto drifts = [](double probability, std::size_t rows, std::size_t numbers) {
    std::vector<Measurement> all(1);
    all[0].name = "a";
    all[0].tables.push_back({.name = "a", .columns = {{"r", "", {1.5}}}});
    all[0].tables[0].halves.push_back({"g", 1.5, Halves{.error = 1.0, .probability = probability}, rows});
    for (std::size_t k = 0; k < numbers; ++k) all[0].scalars.push_back({.name = "y", .halves = Halves{.error = 1.0}});
    note_drifts(all, Effects{});
    return !drifting_numbers(all).empty();
  };
  EXPECT_TRUE(drifts(0.00009, 100, 0));
  EXPECT_FALSE(drifts(0.00011, 100, 0));
  EXPECT_TRUE(drifts(0.000049, 100, 7)) << "half of the threshold is for other numbers";
  EXPECT_FALSE(drifts(0.000051, 100, 7));
}

TEST(DriftOfARun, OfDisksThatLoseEnergyIsCalledNotSteady) {
  std::vector<Measurement> all(1);
  all[0].scalars.push_back(
      {.name = "x", .note = "old", .halves = Halves{.first = 2.0, .rest = 1.0, .error = 0.1, .probability = 0.0}});
  Effects effects;
  effects.collision.restitution = 0.9;
  note_drifts(all, effects);
  EXPECT_EQ(all[0].scalars[0].note,
            "not steady: 2 in the first 50 % of the samples and 1 in the rest, 10.0 standard errors apart; old");
}

}  // namespace
}  // namespace carom::test
