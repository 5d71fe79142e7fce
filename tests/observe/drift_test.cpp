// The first and the second half of a run compared: what drifts is named, and what is in equilibrium is not.

#include "observe/drift.hpp"
#include "observe/blocking.hpp"
#include "observe/observed_system.hpp"
#include "observe/pressure.hpp"
#include "scene/observables_known.hpp"

#include <carom/blocking.hpp>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <utility>
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

TEST(HalvesOfASeries, TellNothingOfAFewEventsAmongManySamples) {
  const auto halves = [](int every) {
    std::mt19937_64 engine(3);
    Blocking series;
    for (int t = 0; t < 2000; ++t) {
      const double weight = t % every == every / 2 ? 1.0 : 0.0;
      series.add(weight * (1.0 + static_cast<double>(engine() >> 11U) * 0x1p-53), weight);
    }
    return series.halves();
  };
  EXPECT_FALSE(halves(1000)) << "one event in the first half, and one in the rest";
  EXPECT_FALSE(halves(100)) << "ten in the rest";
  EXPECT_TRUE(halves(10));
}

TEST(HalvesOfASeries, TellNothingOfAnEventThatDoesNotComeAgain) {
  for (const int last : {5, 77, 640}) {
    std::mt19937_64 engine(4);
    Blocking series;
    for (int t = 0; t < 2000; ++t) series.add(t <= last ? static_cast<double>(engine() >> 11U) * 0x1p-53 : 0.25);
    EXPECT_FALSE(series.halves()) << "the rest scatters by what rounding leaves of differences";
  }
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
    note_drifts(all, Scene{});
    return drifting_numbers(all);
  };
  EXPECT_THAT(measured(0.0089, 0), testing::ElementsAre("a.x"));
  EXPECT_THAT(measured(0.0089, 1), IsEmpty());
  EXPECT_THAT(measured(0.00089, 9), testing::ElementsAre("a.x"));
  EXPECT_THAT(measured(0.00091, 9), IsEmpty());
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
    all[0].tables[0].halves.push_back({"g", {1.5}, Halves{.error = 1.0, .probability = probability}, rows});
    for (std::size_t k = 0; k < numbers; ++k) all[0].scalars.push_back({.name = "y", .halves = Halves{.error = 1.0}});
    note_drifts(all, Scene{});
    return !drifting_numbers(all).empty();
  };
  EXPECT_TRUE(drifts(0.000089, 100, 0));
  EXPECT_FALSE(drifts(0.000091, 100, 0));
  EXPECT_TRUE(drifts(0.000044, 100, 7)) << "half of the threshold is for other numbers";
  EXPECT_FALSE(drifts(0.000046, 100, 7));
}

TEST(DriftOfATable, IsSaidWithBothPlacesInTwoDimensions) {
  std::vector<Measurement> all(1);
  all[0].name = "fields";
  all[0].tables.push_back({.name = "fields", .columns = {{"x", "", {0.25, 0.75}}, {"y", "", {2.5, 2.5}}}});
  ColumnComparison comparison;
  comparison.add(Halves{.share = 0.5, .first = 1.0, .rest = 1.0, .error = 0.01, .probability = 0.5});
  comparison.add(Halves{.share = 0.5, .first = 2.0, .rest = 1.0, .error = 0.01, .probability = 1e-9});
  comparison.put(all[0].tables[0], "density", 2);
  note_drifts(all, Scene{});
  EXPECT_THAT(all[0].note, HasSubstr("(density at x = 0.75, y = 2.5)"));
}

/// What a run shows that is not in equilibrium. In `mixing` two species begin apart; in the others something changes after three
/// tenths of the run.
enum class Start : std::uint8_t { steady, faster, sticky, falling, mixing };

/// How the drift of each observable is shown; those without have results that have no two halves.
constexpr std::pair<std::string_view, std::optional<Start>> drifts[] = {
    {"temperature", Start::faster},
    {"pressure", Start::faster},
    {"collision_rate", Start::faster},
    {"contact_values", Start::mixing},
    {"free_flight", Start::faster},
    {"speeds", Start::faster},
    {"velocity_moments", Start::faster},
    {"radial_distribution", Start::sticky},
    {"structure_factor", Start::sticky},
    {"hexatic", Start::sticky},
    {"voronoi", Start::sticky},
    {"clusters", Start::sticky},
    {"density_profile", Start::falling},
    {"fields", Start::faster},
    {"mean_square_displacement", Start::faster},
    {"intermediate_scattering", Start::faster},
    {"overlap", Start::faster},
    {"non_gaussian", Start::faster},
    {"van_hove", Start::faster},
    {"velocity_autocorrelation", Start::faster},
    {"viscosity", Start::faster},
    {"heat_conductivity", Start::faster},
    {"h_function", std::nullopt},
    {"wall_fluxes", Start::falling},
    {"work", std::nullopt},
};

/// Forty disks that are observed 4400 times. Observables are those whose drift is shown so; of a steady run they are all but
/// those of walls.
Scene scene_from(Start start, int seed) {
  const bool mixes = start == Start::mixing, has_walls = start == Start::falling;
  const auto species = [](const char* name, int count, const char* positions) {
    return fmt::format(
        "[[disks]]\nname = \"{}\"\ncount = {}\nradius = 0.5\nmass = 1.0\npositions = {}\n"
        "velocities = {{ temperature = 1.0 }}\n",
        name, count, positions);
  };
  std::string text = fmt::format("[box]\nx = [0.0, {}]\ny = [0.0, {}]\nboundary = \"{}\"\n[collision]\nrule = \"specular\"\n",
                                 mixes ? "60.0" : "9.5", mixes ? "2.5" : "9.5", has_walls ? "walls" : "periodic");
  if (mixes)
    text += species("left", 20, "{ random = { x = [0.0, 30.0], y = [0.0, 2.5] } }") +
            species("right", 20, "{ random = { x = [30.0, 60.0], y = [0.0, 2.5] } }");
  else
    text += species("all", 40, "\"random\"");
  text += fmt::format("[run]\ntime = 1100.0\nseed = {}\n", seed);
  if (!mixes) text += "equilibrate = { time = 20.0 }\n";
  const auto change = [&](const char* what) { text += fmt::format("[[changes]]\ntime = 330.0\n{}\n", what); };
  if (start == Start::faster) change("scale_velocities = 3.0");
  if (start == Start::sticky) {
    text += "[square_well]\nwidth = 1.3\ndepth = 0.01\n";
    change("set = [\"square_well.depth=3.0\"]");
  }
  if (start == Start::falling) change("set = [\"gravity.acceleration=[0.0, -1.0]\"]");
  Scene scene = parse_scene(text);
  for (const auto& [name, shown] : drifts) {
    if (start == Start::steady ? shown == Start::falling : shown != start) continue;
    ObservableRequest& request = scene.observe.emplace_back(ObservableRequest{.name = std::string(name), .every = 0.25});
    const detail::KnownObservable& known = *detail::find_observable(name);
    if (known.step >= 4.0) request.every = 1.0;  // those that take long
    if (known.bins) request.bins = 10;
    if (known.cells) request.cells = {{2, 2}};
    if (name == "radial_distribution" || name == "hexatic") request.range = 3.0;
    if (name == "structure_factor") request.largest = 10.0;
    if (name == "intermediate_scattering") request.largest = 1.0;
  }
  return scene;
}

TEST(DriftOfEveryObservable, IsListed) {
  std::vector<std::string> listed;
  for (const auto& [name, shown] : drifts) listed.emplace_back(name);
  EXPECT_THAT(listed, testing::ElementsAreArray(detail::names_of_observables()));
}

TEST(DriftOfEveryObservable, IsSaidWhereThereIsOne) {
  for (const Start start : {Start::faster, Start::sticky, Start::falling, Start::mixing}) {
    const Observed run = observe(scene_from(start, 1), 100.0);
    const std::vector<std::string> drifting = drifting_numbers(run.measurements);
    for (const Measurement& one : run.measurements) {
      if (one.name == "recorder") continue;
      EXPECT_THAT(drifting, Contains(testing::StartsWith(one.name)));
      if (one.name == "fields") {
        EXPECT_THAT(one.note, testing::ContainsRegex("\\([a-z_]+ at x = [0-9.]+, y = [0-9.]+\\)"));
      }
    }
  }
}

TEST(DriftOfEveryObservable, IsNotSaidInEquilibrium) {
  const Observed run = observe(scene_from(Start::steady, 1), 100.0);
  EXPECT_THAT(drifting_numbers(run.measurements), IsEmpty()) << "at most one in a hundred seeds is";
  for (const auto& [name, shown] : drifts) {
    if (shown) continue;
    for (const Measurement& one : run.measurements) {
      if (one.name != name) continue;
      for (const Scalar& scalar : one.scalars) EXPECT_FALSE(scalar.halves) << name;
      for (const Table& table : one.tables) EXPECT_THAT(table.halves, IsEmpty()) << name;
    }
  }
}

/// A total that increases at a rate of 1 in the first half of `length` steps, and at `later` in the rest, with noise.
std::optional<Halves> halves_of_a_rate(int length, double later, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  BlockedRate series;
  double total = 0.0;
  for (int t = 1; t <= length; ++t) {
    total += (2 * t <= length ? 1.0 : later) * (0.5 + static_cast<double>(engine() >> 11U) * 0x1p-53);
    series.add(t, total);
  }
  return series.halves();
}

TEST(HalvesOfARate, AreThoseOfItsBlocks) {
  EXPECT_FALSE(halves_of_a_rate(15, 1.0, 1)) << "too few blocks";
  const std::optional<Halves> halves = halves_of_a_rate(6300, 1.5, 1);
  ASSERT_TRUE(halves);
  EXPECT_NEAR(halves->share, 0.36, 0.03);
  EXPECT_NEAR(halves->first, 1.0, 4.0 * std::sqrt(1.0 / 12.0 / 2200.0));
  EXPECT_NEAR(halves->rest, 1.5 - 0.5 * (0.5 - halves->share) / (1.0 - halves->share), 0.05);
  EXPECT_LT(halves->probability, 0.01);
  constexpr int series = 500;
  int below_tenth = 0;
  for (std::uint64_t s = 1; s <= series; ++s) below_tenth += halves_of_a_rate(6300, 1.0, s).value().probability < 0.1 ? 1 : 0;
  EXPECT_LT(below_tenth, 0.1 * series + 4.0 * std::sqrt(0.09 * series));
}

TEST(DriftOfARun, OfDisksThatLoseEnergyIsCalledNotSteady) {
  std::vector<Measurement> all(1);
  all[0].scalars.push_back(
      {.name = "x", .note = "old", .halves = Halves{.first = 2.0, .rest = 1.0, .error = 0.1, .probability = 0.0}});
  Scene inelastic, dragged;
  inelastic.effects.collision.restitution = 0.9;
  dragged.effects.drag = Drag{0.1};
  for (const Scene& scene : {inelastic, dragged}) {
    all[0].scalars[0].note = "old";
    note_drifts(all, scene);
    EXPECT_EQ(all[0].scalars[0].note,
              "not steady: 2 in the first 50 % of the samples and 1 in the rest, 10.0 standard errors apart; old");
    EXPECT_FALSE(some_not_in_equilibrium(all));
  }
}

TEST(DriftOfARun, ACorrelatedNumberOfAChangeIsNotToBeMeasuredByALongerRun) {
  const std::string lower_bound = "the run is too short for its correlations: the error is a lower bound";
  const auto note_in = [&](const Scene& scene) {
    std::vector<Measurement> all(1);
    all[0].scalars.push_back({.name = "x", .note = lower_bound});
    note_drifts(all, scene);
    return all[0].scalars[0].note;
  };
  Scene cooling, dragged, growing, compressed, heated, falling, vibrated;
  cooling.effects.collision.restitution = 0.9;
  dragged.effects.drag = Drag{0.1};
  growing.effects.growth = Growth{0.01};
  compressed.effects.walls[1].velocity = -0.1;
  for (const Scene& scene : {cooling, dragged, growing, compressed})
    EXPECT_EQ(note_in(scene), "not steady: a mean over a change: the error is a lower bound");
  heated = falling = vibrated = cooling;
  heated.effects.thermostat = Thermostat{1.0, 1.0};
  falling.effects.gravity = Gravity{{0.0, -1.0}};
  falling.box.boundary = {Boundary::walls, Boundary::periodic};
  vibrated.effects.walls[2].vibration = 1.0;
  for (const Scene& scene : {Scene{}, heated, falling, vibrated}) EXPECT_EQ(note_in(scene), lower_bound);
}

TEST(DriftOfARun, WhereTheSceneChangesIsCalledNotSteady) {
  std::vector<Measurement> all(1);
  all[0].scalars.push_back({.name = "x", .halves = Halves{.first = 2.0, .rest = 1.0, .error = 0.1, .probability = 0.0}});
  Scene scene;
  note_drifts(all, scene);
  EXPECT_TRUE(some_not_in_equilibrium(all));
  all[0].scalars[0].note.clear();
  scene.changes = {{1.0, ScaleVelocities{2.0}}};
  note_drifts(all, scene);
  EXPECT_TRUE(all[0].scalars[0].note.starts_with("not steady: 2 in the first"));
  EXPECT_EQ(sentence_of_drifts({"x", "y"}, some_not_in_equilibrium(all)),
            "The first and the second half of the run differ by more than chance, so it was not steady: x, y.");
}

}  // namespace
}  // namespace carom::test
