// What a sweep finds in the files of its runs, and the tables that it makes of it.

#include "studies/sweep/products.hpp"
#include "studies/sweep/results.hpp"

#include "io/hdf5_handle.hpp"
#include "support/sweep_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

namespace carom::test {
namespace {

using Json = nlohmann::ordered_json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

namespace fs = std::filesystem;

TEST(SweepAverage, IsMeanAndStandardErrorOverSeeds) {
  // Mean of 1, 2, 4, 9 is 4; squares of what is left: 9 + 4 + 0 + 25 = 38; 38 / 3 / 4 = 19 / 6.
  const SeedAverage four = average_of({1.0, 2.0, 4.0, 9.0});
  EXPECT_EQ(four.count, 4U);
  EXPECT_EQ(four.mean, 4.0);
  EXPECT_DOUBLE_EQ(*four.error, std::sqrt(19.0 / 6.0));
  // Of two values half their distance.
  const SeedAverage two = average_of({3.0, std::nullopt, 5.0});
  EXPECT_EQ(two.count, 2U);
  EXPECT_EQ(two.mean, 4.0);
  EXPECT_DOUBLE_EQ(*two.error, 1.0);
}

TEST(SweepAverage, OfOneSeedHasNoErrorAndOfNoneNoMean) {
  const SeedAverage one = average_of({std::nullopt, 2.5});
  EXPECT_EQ(one.mean, 2.5);
  EXPECT_EQ(one.error, std::nullopt);
  EXPECT_EQ(average_of({std::nullopt}).mean, std::nullopt);
  EXPECT_EQ(average_of({}).count, 0U);
}

class SweepResultsOf : public ::testing::Test {
 protected:
  SweepResultsOf() {
    sweep_ = files_.load(
        "scene = \"gas.toml\"\nseeds = 2\ntable = [\"pressure.Z\", \"observables.temperature.kT\"]\n"
        "[set]\nobserve.temperature = true\n[grid]\nrun.time = [1.0, 2.0]\n"
        "[[points]]\nname = \"walls\"\n\"box.boundary\" = \"walls\"\n");
  }
  [[nodiscard]] fs::path place(std::size_t run) const { return files_.directory().path() / "out" / sweep_.directory_of(run); }
  [[nodiscard]] Json summary(std::size_t run, const Json& Z) const {
    return {{"carom", {{"version", "1.2.3"}, {"commit", "abc"}, {"threads", 5}}},
            {"seed", sweep_.seed_of(run)},
            {"pressure", {{"Z", Z}, {"Z_error", 0.5}}},
            {"wall_seconds", 12.5},
            {"stopped", "time"},
            {"resolved_scene", resolved_toml(sweep_.scene_of(run))}};
  }
  void put(std::size_t run, const Json& summary) const {
    fs::create_directories(place(run));
    write_text(place(run) / "summary.json", summary.dump());
  }
  [[nodiscard]] FoundRun found(std::size_t run) const {
    return find_run(place(run), [&] { return resolved_toml(sweep_.scene_of(run)); });
  }
  [[nodiscard]] RunState state(std::size_t run) const { return found(run).state; }
  [[nodiscard]] SweepResults results() const { return collect(sweep_, files_.directory().path() / "out"); }

  SweepFiles files_;
  Sweep sweep_;
};

TEST_F(SweepResultsOf, ARunIsFinishedExactlyWithASummaryOfItsOwnScene) {
  EXPECT_EQ(state(0), RunState::missing);
  put(0, summary(0, 1.5));
  EXPECT_EQ(state(0), RunState::finished);
  put(0, summary(1, 1.5));
  EXPECT_EQ(state(0), RunState::other);
  Json interrupted = summary(0, 1.5);
  interrupted["stopped"] = "interrupted";
  put(0, interrupted);
  EXPECT_EQ(state(0), RunState::missing);
  for (const char* text : {"{", "", "[1]", R"({"stopped": 3})", R"({"stopped": "time"})"}) {
    write_text(place(0) / "summary.json", text);
    EXPECT_EQ(state(0), RunState::missing) << text;
  }
  fs::remove(place(0) / "summary.json");
  fs::create_directory(place(0) / "summary.json");
  EXPECT_EQ(state(0), RunState::missing);
  fs::remove(place(0) / "summary.json");
  put(0, summary(0, 1.5));
  write_text(place(0) / failure_file, "disks overlap\n");
  EXPECT_EQ(state(0), RunState::failed);
}

TEST_F(SweepResultsOf, ARunThatNeverLeftEquilibrationHasFailed) {
  Json jammed = summary(0, 1.5);
  jammed["stopped"] = "jammed";
  jammed["measured"] = false;
  put(0, jammed);
  EXPECT_EQ(state(0), RunState::failed);
  EXPECT_EQ(found(0).failure, "the run ended while it was still equilibrating (jammed)");
}

TEST_F(SweepResultsOf, TablesHaveMeansErrorsAndWhatFailed) {
  put(0, summary(0, 1.0));
  put(1, summary(1, 2.0));
  put(2, summary(2, nullptr));
  Json measured = summary(3, 7.0);
  measured["observables"]["temperature"]["kT"] = {{"value", 0.1}, {"error", nullptr}};
  put(3, measured);
  fs::create_directories(place(4));
  write_text(place(4) / failure_file, "no room, \"none\" at all\n");
  EXPECT_EQ(points_csv(sweep_, results()),
            "point,run.time,box.boundary,finished,failed,pressure.Z_mean,pressure.Z_error,observables.temperature.kT_mean,"
            "observables.temperature.kT_error\n"
            "time=1.0,1.0,,2,0,1.5,0.5,,\n"
            "time=2.0,2.0,,2,0,7,,0.1,\n"
            "walls,,walls,0,1,,,,\n");
  EXPECT_EQ(runs_csv(sweep_, results()),
            "point,run.time,box.boundary,seed,directory,state,stopped,pressure.Z,observables.temperature.kT,failure\n"
            "time=1.0,1.0,,1,time=1.0/seed=1,finished,time,1,,\n"
            "time=1.0,1.0,,2,time=1.0/seed=2,finished,time,2,,\n"
            "time=2.0,2.0,,1,time=2.0/seed=1,finished,time,,,\n"
            "time=2.0,2.0,,2,time=2.0/seed=2,finished,time,7,0.1,\n"
            "walls,,walls,1,walls/seed=1,failed,,,,\"no room, \"\"none\"\" at all\"\n"
            "walls,,walls,2,walls/seed=2,missing,,,,\n");
  EXPECT_THAT(results().versions, ElementsAre("1.2.3 (commit abc)"));
}

TEST_F(SweepResultsOf, WithoutATableTheUsualNumbersAreThereAndNoneOfAClock) {
  sweep_.table.clear();
  Json measured = summary(0, 1.0);
  measured["observables"]["temperature"] = {{"note", "x"}, {"kT", {{"value", 0.1}, {"error", 0.2}}}};
  measured["temperature"]["mean"] = nullptr;
  measured["collisions_per_second"] = 1e6;
  put(0, measured);
  EXPECT_THAT(results().numbers, ElementsAre("pressure.Z", "observables.temperature.kT"));
  // What an observable measures again is there once.
  measured["observables"]["pressure"] = {{"Z", {{"value", 1.0}, {"error", 0.2}}}};
  put(0, measured);
  EXPECT_THAT(results().numbers, ElementsAre("observables.temperature.kT", "observables.pressure.Z"));
}

/// A sweep of two densities, with D at a lag of 1, and Z.
class SweepOfDiffusion : public ::testing::Test {
 protected:
  SweepOfDiffusion() {
    sweep_ = files_.load(
        "scene = \"gas.toml\"\nseeds = 2\n"
        "table = [\"pressure.Z\", \"observables.mean_square_displacement.diffusion@1\"]\n"
        "[set]\n\"box.boundary\" = \"periodic\"\nrun.time = 10.0\nobserve.mean_square_displacement = true\n"
        "[grid]\ndisks.0.radius = [0.1, 0.2]\n");
    for (std::size_t run = 0; run < sweep_.run_count(); ++run) put(run, 2.0);
  }
  void put(std::size_t run, double kT) const {
    const fs::path place = out() / sweep_.directory_of(run);
    fs::create_directories(place);
    const Json summary = {{"carom", {{"version", "1.2.3"}}},
                          {"pressure", {{"Z", 1.5}}},
                          {"temperature", {{"mean", kT}}},
                          {"stopped", "time"},
                          {"resolved_scene", resolved_toml(sweep_.scene_of(run))}};
    write_text(place / "summary.json", summary.dump());
    write_text(place / "observe_mean_square_displacement.csv",
               "# averages over time; units: time, length^2 / time, length^2 / time\nlag,diffusion,diffusion_error\n0.5," +
                   std::to_string(run) + ",0.1\n1.5," + std::to_string(run + 2) + ",0.1\n");
  }
  /// The plot of the tables, which is drawn once.
  [[nodiscard]] Plot plot_of_tables() const {
    const SweepResults results = collect(sweep_, out());
    for (const Section& section : sweep_page(sweep_, results, seed_tables_of(sweep_, results, out())).sections)
      if (section.heading == "Tables of observables") return std::get<Plot>(section.blocks.at(0));
    return {};
  }
  /// D at kT = 2 of 50 disks by Boltzmann's equation over g; the first Sonine polynomials, which are left out, add two parts in a
  /// hundred. g is Henderson's.
  [[nodiscard]] double diffusion(double radius) const {
    const double sigma = 2.0 * radius, n = 50.0 / sweep_.scene_of(0).box.area(), eta = 0.25 * M_PI * n * sigma * sigma;
    const double g = (1.0 - 7.0 / 16.0 * eta) / ((1.0 - eta) * (1.0 - eta));
    return std::sqrt(2.0) / (2.0 * std::sqrt(M_PI) * n * sigma * g);
  }
  [[nodiscard]] fs::path out() const { return files_.directory().path() / "out"; }

  SweepFiles files_;
  Sweep sweep_;
};

TEST_F(SweepOfDiffusion, TakesItFromTheTablesOfTheRuns) {
  SweepResults results = collect(sweep_, out());
  EXPECT_EQ(results.units.at(1), "length^2 / time");
  for (std::size_t run = 0; run < 4; ++run) EXPECT_EQ(results.values.at(run).at(1), static_cast<double>(run) + 1.0);
  EXPECT_EQ(results.averages.at(1).at(1).mean, 3.5);
  write_text(out() / sweep_.directory_of(2) / "observe_mean_square_displacement.csv", "damaged\n");
  results = collect(sweep_, out());
  EXPECT_EQ(results.averages.at(1).at(1).count, 1U) << "that run has no such number";
}

TEST_F(SweepOfDiffusion, HasItsUnitInTheFiles) {
  const SweepResults results = collect(sweep_, out());
  const std::string path = files_.directory().file("sweep.h5"), name = "observables.mean_square_displacement.diffusion@1";
  write_text(path, sweep_hdf5(sweep_, results));
  const detail::Hdf5Id file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  for (const char* group : {"/points/mean/", "/points/error/", "/runs/numbers/"})
    EXPECT_EQ(detail::read_string_attribute(file.get(), group + name, "unit"), "length^2 / time");
  const Json json = Json::parse(sweep_json(sweep_, results));
  EXPECT_EQ(json.at("points").at(0).at("numbers").at(name).at("unit"), "length^2 / time");
}

TEST_F(SweepOfDiffusion, IsDrawnBesideTheory) {
  const Page page = sweep_page(sweep_, collect(sweep_, out()));
  std::size_t drawn = 0;
  for (const Section& section : page.sections)
    for (const Block& block : section.blocks) {
      const Plot* const plot = std::get_if<Plot>(&block);
      if (plot == nullptr || plot->series.size() != 2) continue;
      const Series& theory = plot->series[1];
      ASSERT_EQ(theory.x, (std::vector<double>{0.1, 0.2}));
      for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(theory.y[k], diffusion(theory.x[k]), 0.04 * theory.y[k]);
      EXPECT_THAT(theory.name, HasSubstr("Enskog"));
      ++drawn;
    }
  EXPECT_EQ(drawn, 1U) << "Z is the same in all runs here, and is not drawn";
}

TEST_F(SweepOfDiffusion, TheoryOfOnePointIsAShortLineBesideTheData) {
  for (const std::size_t run : {2U, 3U}) fs::remove_all(out() / sweep_.directory_of(run));
  const Page page = sweep_page(sweep_, collect(sweep_, out()));
  const Plot& plot = std::get<Plot>(page.sections.at(0).blocks.at(0));
  ASSERT_EQ(plot.series.size(), 2U);
  EXPECT_THAT(plot.series[1].x, ElementsAre(0.1));
  EXPECT_EQ(plot.series[1].style, Style::levels);
  EXPECT_THAT(plot.caption, HasSubstr("Short lines are theory."));
}

TEST_F(SweepOfDiffusion, ItsTableIsDrawnBesideTheTheoryOfEachPoint) {
  const std::vector<Series> series = plot_of_tables().series;
  ASSERT_EQ(series.size(), 4U);
  const std::vector<double> radii = {0.1, 0.2};
  for (std::size_t k = 0; k < 2; ++k) {
    const Series& line = series[2 + k];
    EXPECT_EQ(line.name, "Enskog, " + series[k].name);
    EXPECT_EQ(line.group, series[k].group);
    EXPECT_THAT(line.x, ElementsAre(0.5, 1.5));
    for (const double D : line.y) EXPECT_NEAR(D, diffusion(radii[k]), 0.04 * D);
  }
}

TEST_F(SweepOfDiffusion, TheoryThatDiffersFromRunToRunIsNotDrawn) {
  put(1, 2.001);
  const std::vector<Series> series = plot_of_tables().series;
  ASSERT_EQ(series.size(), 3U);
  EXPECT_EQ(series[2].name, "Enskog, " + series[1].name);
}

TEST_F(SweepOfDiffusion, TheoryThatIsTheSameForAllPointsIsDrawnOnce) {
  sweep_ = files_.load(
      "scene = \"gas.toml\"\nseeds = 2\n[set]\n\"box.boundary\" = \"periodic\"\ndisks.0.radius = 0.1\n"
      "observe.mean_square_displacement = true\n[grid]\nrun.time = [5.0, 10.0]\n");
  for (std::size_t run = 0; run < sweep_.run_count(); ++run) put(run, 2.0);
  const std::vector<Series> series = plot_of_tables().series;
  ASSERT_EQ(series.size(), 3U);
  EXPECT_EQ(series[2].name, "Enskog");
  EXPECT_NEAR(series[2].y.front(), diffusion(0.1), 0.04 * diffusion(0.1));
}

TEST_F(SweepResultsOf, NumbersOfListsAndErrorsOfObservablesHaveNames) {
  const Json summary = {{"momentum", {{"final", {1.0, 2.0}}}},
                        {"observables", {{"pressure", {{"Z", {{"value", 3.0}, {"error", 0.5}}}}}}}};
  std::string text;
  for (const SummaryNumber& number : numbers_of(summary)) text += number.name + " " + std::to_string(*number.value) + "\n";
  EXPECT_EQ(text,
            "momentum.final.0 1.000000\nmomentum.final.1 2.000000\nobservables.pressure.Z 3.000000\n"
            "observables.pressure.Z_error 0.500000\n");
}

std::vector<std::string> split_line(const std::string& line) {
  std::vector<std::string> words;
  std::istringstream text(line);
  for (std::string word; std::getline(text, word, ',');) words.push_back(word);
  return words;
}

TEST_F(SweepResultsOf, EveryColumnOfItsTablesHasAUnitAndAMeaning) {
  Json with_temperature = summary(0, 1.0);
  with_temperature["observables"] = {{"temperature", {{"kT", {{"value", 1.5}, {"error", 0.5}, {"unit", "energy"}}}}}};
  put(0, with_temperature);
  std::istringstream lines(columns_csv(sweep_, results()));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "file,column,unit,meaning");
  std::map<std::string, std::string> names, units;
  while (std::getline(lines, line)) {
    const std::vector<std::string> words = split_line(line);
    ASSERT_EQ(words.size(), 4U) << line;
    names[words[0]] += (names[words[0]].empty() ? "" : ",") + words[1];
    units[words[1]] = words[2];
  }
  const auto heading_of = [](const std::string& table) { return table.substr(0, table.find('\n')); };
  EXPECT_EQ(names.at("sweep.csv"), heading_of(points_csv(sweep_, results())));
  EXPECT_EQ(names.at("runs.csv"), heading_of(runs_csv(sweep_, results())));
  EXPECT_EQ(units.at("run.time"), "time");
  EXPECT_EQ(units.at("box.boundary"), "");
  EXPECT_EQ(units.at("pressure.Z_mean"), "");
  EXPECT_EQ(units.at("observables.temperature.kT"), "energy");
  EXPECT_EQ(units.at("observables.temperature.kT_mean"), "energy");
  EXPECT_EQ(units.at("observables.temperature.kT_error"), "energy");
}

TEST_F(SweepResultsOf, TheHdf5FileHoldsTheSameAndHasTheSameBytesEveryTime) {
  put(0, summary(0, 1.0));
  put(1, summary(1, 2.0));
  const std::string bytes = sweep_hdf5(sweep_, results());
  EXPECT_EQ(sweep_hdf5(sweep_, results()), bytes);
  const std::string path = files_.directory().file("sweep.h5");
  write_text(path, bytes);
  const detail::Hdf5Id file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  EXPECT_THAT(detail::members_of(file.get(), "/points/parameters"), ElementsAre("box.boundary", "run.time"));
  const std::vector<double> mean = detail::read_rows(file.get(), "/points/mean/pressure.Z", 0, 3);
  EXPECT_EQ(mean[0], 1.5);
  EXPECT_TRUE(std::isnan(mean[1]));
  EXPECT_EQ(detail::read_rows(file.get(), "/points/error/pressure.Z", 0, 1)[0], 0.5);
  EXPECT_THAT(detail::read_rows(file.get(), "/runs/numbers/pressure.Z", 0, 2), ElementsAre(1.0, 2.0));
  EXPECT_THAT(detail::read_rows(file.get(), "/runs/seed", 0, 6), ElementsAre(1, 2, 1, 2, 1, 2));
  EXPECT_EQ(detail::read_string_attribute(file.get(), "/points/parameters/run.time", "unit"), "time");
  EXPECT_EQ(detail::read_string_attribute(file.get(), "/points/mean/pressure.Z", "unit"), "") << "a pure number has none";
  EXPECT_EQ(detail::read_string_attribute(file.get(), "/", "sweep"), sweep_.text);
  EXPECT_EQ(detail::read_string_attribute(file.get(), "/", "scene"), fifty_disks);
}

}  // namespace
}  // namespace carom::test
