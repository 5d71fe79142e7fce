// The page of a run: what it says of runs of every kind, and that theory stands only where it is of the scene.

#include "pages/report_page.hpp"

#include "pages/html_parts.hpp"
#include "pages/page_parts.hpp"
#include "studies/horizon/json.hpp"
#include "studies/horizon/page.hpp"
#include "support/child_process.hpp"
#include "support/recorded_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace carom::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using ::testing::Not;

/// `fluid` but for its last table.
const std::string fluid = R"(
title = "<b>A fluid</b> & \"more\""
[box]
x = [0.0, 10.0]
y = [0.0, 10.0]
boundary = "periodic"
[[disks]]
count = 40
radius = 0.5
mass = 2.0
positions = "square"
velocities = { temperature = 3.0 }
[collision]
rule = "specular"
[run]
time = 20.0
sample_every = 0.5
)";
const std::string all_that_can_be = R"(
[observe]
temperature = true
pressure = true
collision_rate = true
free_flight = true
speeds = { bins = 20 }
velocity_moments = true
radial_distribution = { range = 3.0, bins = 20 }
structure_factor = { largest = 10.0 }
hexatic = { range = 3.0 }
voronoi = true
clusters = true
density_profile = { axis = "x" }
mean_square_displacement = true
intermediate_scattering = true
overlap = true
non_gaussian = true
van_hove = true
velocity_autocorrelation = true
viscosity = true
heat_conductivity = true
h_function = true
)";

class ReportPage : public ::testing::Test {
 protected:
  [[nodiscard]] RunRecord recorded(const std::string& scene, const std::vector<std::string>& overrides = {}) const {
    record(parse_scene(scene, "fluid.toml", overrides), run_);
    return read_run_record(run_);
  }
  TemporaryDirectory directory_;
  std::filesystem::path run_ = directory_.path() / "run";
};

std::vector<std::string> headings_of(const Page& page) {
  std::vector<std::string> headings;
  for (const Section& section : page.sections) headings.push_back(section.heading);
  return headings;
}

/// All words of a section, its tables' cells one after the other.
std::string words_of(const Page& page, const std::string& heading) {
  std::string words;
  for (const Section& section : page.sections) {
    if (section.heading != heading) continue;
    for (const Block& block : section.blocks) {
      if (const auto* const paragraph = std::get_if<Paragraph>(&block)) words += paragraph->text + "\n";
      if (const auto* const listing = std::get_if<Listing>(&block)) words += listing->title + ": " + listing->text + "\n";
      if (const auto* const table = std::get_if<TextTable>(&block))
        for (const auto& row : table->rows) {
          for (const std::string& cell : row) words += cell + " | ";
          words += "\n";
        }
    }
  }
  return words;
}

const Series* series_of(const Page& page, const std::string& plot_id, const std::string& name) {
  static std::vector<Plot> plots;
  plots = plots_of(page);
  for (const Plot& plot : plots)
    if (plot.id == plot_id)
      for (const Series& series : plot.series)
        if (series.name == name) return &series;
  return nullptr;
}

TEST_F(ReportPage, HasASectionForEachPartOfTheRun) {
  const Page page = report_page(recorded(fluid), std::nullopt);
  EXPECT_EQ(page.title, "<b>A fluid</b> & \"more\"");
  EXPECT_THAT(headings_of(page), ElementsAre("Scene", "Run", "Replay", "Accuracy", "Pressure"));
  EXPECT_THAT(words_of(page, "Scene"),
              AllOf(HasSubstr("disks | 40"), HasSubstr("[0, 10] x [0, 10], periodic"), HasSubstr("collisions | specular"),
                    HasSubstr("run | until time 20"), HasSubstr("as it was written: " + fluid)));
  EXPECT_THAT(words_of(page, "Run"), AllOf(HasSubstr("time | 20 | as requested"), HasSubstr("samples | 41 | every 0.5")));
  EXPECT_THAT(words_of(page, "Accuracy"), AllOf(HasSubstr("energy | "), HasSubstr("relative change along x "),
                                                HasSubstr("u √n / N"), HasSubstr("simultaneous | ")));
  EXPECT_THAT(words_of(page, "Pressure"), HasSubstr("Kolafa & Rottner, N = 40"));
  EXPECT_THAT(ids_of(page), Contains("pressure"));
}

TEST_F(ReportPage, HasMapsOfFieldsOnAGridAndProfilesOfALineOfCells) {
  const auto maps_in = [](const Page& page) {
    std::string found;
    for (const Section& section : page.sections)
      for (const Block& block : section.blocks)
        if (const EmbeddedPage* one = std::get_if<EmbeddedPage>(&block); one != nullptr && one->title == "Maps of the fields")
          found += one->html;
    return found;
  };
  const auto count = [](const std::string& text, const std::string& word) {
    std::size_t times = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++times;
    return times;
  };
  const std::string grid = maps_in(report_page(recorded(fluid + "[observe]\nfields = { cells = [3, 2] }\n"), std::nullopt));
  EXPECT_EQ(count(grid, "<svg "), 3U);
  EXPECT_EQ(count(grid, "<path fill=\"#"), 18U) << "six cells on each map";
  EXPECT_EQ(count(grid, "Arrows: "), 2U);
  EXPECT_THAT(grid, AllOf(Not(HasSubstr("nan")), Not(HasSubstr("inf"))));
  // The run is kept as 16 to 31 stretches, and one place of the slider is the average.
  EXPECT_THAT(grid, testing::ContainsRegex("<input id=\"time\" type=\"range\" min=\"0\" max=\"(1[6-9]|2[0-9]|3[01])\""));
  const std::filesystem::path first = run_;
  run_ = directory_.path() / "line";
  const Page line = report_page(recorded(fluid + "[observe]\nfields = { cells = [1, 4] }\n"), std::nullopt);
  EXPECT_THAT(maps_in(line), IsEmpty());
  EXPECT_THAT(ids_of(line), IsSupersetOf({"field-density", "field-temperature", "field-stress-xy", "field-energy-lost"}));
}

TEST_F(ReportPage, HasAPlotForEveryTableThatWasAskedFor) {
  const Page page = report_page(recorded(fluid + all_that_can_be), std::nullopt);
  EXPECT_THAT(ids_of(page), IsSupersetOf({"speeds",
                                          "energies",
                                          "free-times",
                                          "free-paths",
                                          "radial-distribution",
                                          "structure-factor",
                                          "hexatic-correlation",
                                          "voronoi-areas",
                                          "voronoi-neighbours",
                                          "clusters",
                                          "density-profile",
                                          "intermediate-scattering",
                                          "overlap",
                                          "overlap-fluctuations",
                                          "non-gaussian",
                                          "van-hove",
                                          "mean-square-displacement",
                                          "diffusion-from-displacement",
                                          "velocity-autocorrelation",
                                          "diffusion-from-velocity",
                                          "viscosity",
                                          "viscosity-correlation",
                                          "heat-conductivity",
                                          "heat-correlation",
                                          "h-function"}));
  const std::string numbers = words_of(page, "Observables");
  EXPECT_THAT(numbers, AllOf(HasSubstr("temperature | kT | "), HasSubstr("pressure | Z_rate | "),
                             HasSubstr("velocity_moments | kurtosis | "), HasSubstr("heat_conductivity | green_kubo | ")));
  for (const Plot& plot : plots_of(page)) {
    EXPECT_FALSE(plot.series.empty()) << plot.id;
    const std::string text = detail::plot_json(plot);
    EXPECT_THAT(text, Not(HasSubstr("nan"))) << plot.id;
    EXPECT_THAT(text, Not(HasSubstr("inf"))) << plot.id;
  }
}

TEST_F(ReportPage, AMixtureHasItsSpeciesInEveryPlotEachWithItsLaw) {
  const std::string mixture = fluid.substr(0, fluid.find("[collision]")) +
                              "[[disks]]\nname = \"light\"\ncount = 20\nradius = 0.2\nmass = 0.5\npositions = \"random\"\n"
                              "velocities = { temperature = 3.0 }\n" +
                              fluid.substr(fluid.find("[collision]"));
  const Page page = report_page(recorded(mixture + all_that_can_be.substr(0, all_that_can_be.find("heat_cond"))), std::nullopt);
  for (const char* const name : {"all disks", "light", "law for 60 disks, light"})
    EXPECT_NE(series_of(page, "speeds", name), nullptr) << name;
  EXPECT_THAT(words_of(page, "Pressure"), HasSubstr("on which nothing else acts"));
}

TEST_F(ReportPage, ScatteringOfSeveralWaveNumbersIsOnePlotWithEachByItsNumber) {
  const Page page = report_page(recorded(fluid + "[observe]\nintermediate_scattering = { k = [3.5, 10.0] }\n"), std::nullopt);
  EXPECT_EQ(std::ranges::count(ids_of(page), "intermediate-scattering"), 1);
  for (const char* const name : {"k = 3.5, all disks", "k = 3.5, self", "k = 10, all disks", "k = 10, self"})
    EXPECT_NE(series_of(page, "intermediate-scattering", name), nullptr) << name;
  run_ = directory_.path() / "one";
  const Page one = report_page(recorded(fluid + "[observe]\nintermediate_scattering = { k = 3.5 }\n"), std::nullopt);
  for (const char* const name : {"all disks", "self"})
    EXPECT_NE(series_of(one, "intermediate-scattering", name), nullptr) << name;
}

/// Of a density that is given at even steps from the first of them on.
double integral(const Series& series) {
  double sum = 0.0;
  for (const double y : series.y) sum += y;
  return sum * (series.x[1] - series.x[0]);
}

TEST_F(ReportPage, LawsOfVelocitiesAndFlightsAreDensities) {
  const Page page = report_page(recorded(fluid + all_that_can_be), std::nullopt);
  for (const char* const id : {"speeds", "energies"}) {
    const Series* const law = series_of(page, id, "law for 40 disks");
    ASSERT_NE(law, nullptr) << id;
    // A sum over 200 steps from a step above zero is off by half a step of a density of some 1/2 of its extent, 1 / 80.
    EXPECT_NEAR(integral(*law), 1.0, 0.04) << id;
  }
  for (const char* const id : {"free-times", "free-paths"}) {
    const Series* const law = series_of(page, id, "dilute gas, summed over speeds");
    ASSERT_NE(law, nullptr) << id;
    EXPECT_NEAR(integral(*law), 1.0, 0.04) << id;  // and beyond ten mean free times is one flight in e^7
  }
}

TEST_F(ReportPage, TheoryIsLeftOutWhereItIsOfAnotherScene) {
  const std::vector<std::pair<std::string, std::string>> others = {{"[gravity]\nacceleration = [0.0, -1.0]\n", "walls"},
                                                                   {"[thermostat]\ntemperature = 3.0\nrate = 1.0\n", "periodic"}};
  for (const auto& [table, boundary] : others) {
    const TemporaryDirectory directory;
    record(parse_scene(fluid + table + "[observe]\nspeeds = true\npressure = true\n", "fluid.toml",
                       {"box.boundary=\"" + boundary + "\"", "disks.0.positions=\"random\""}),
           directory.path() / "run");
    const RunRecord read = read_run_record(directory.path() / "run");
    const RunTheory theory = theory_of(read);
    EXPECT_FALSE(theory.Z()) << table;
    EXPECT_FALSE(theory.of("pressure", "Z")) << table;
    const Page page = report_page(read, std::nullopt);
    EXPECT_NE(series_of(page, "speeds", "Maxwell and Boltzmann"), nullptr) << table;
    EXPECT_THAT(ids_of(page), Not(Contains("pressure"))) << table;
  }
}

TEST_F(ReportPage, ReversalLeavesVelocitiesWithoutALaw) {
  const Page page = report_page(recorded(fluid + "[observe]\nspeeds = true\n", {"collision.rule=reversal"}), std::nullopt);
  EXPECT_EQ(series_of(page, "speeds", "law for 40 disks"), nullptr);
  EXPECT_THAT(ids_of(page), Contains("pressure")) << "the equation of state is of places, which are the same";
}

TEST_F(ReportPage, WithoutATrajectoryThereIsNothingToWatchAndTheRestStays) {
  (void)recorded(fluid);
  std::filesystem::remove(run_ / "trajectory.h5md");
  const ReportFile file = report_of(run_);
  EXPECT_THAT(file.html,
              AllOf(HasSubstr("The run stored no trajectory"), HasSubstr("Kolafa &amp; Rottner, N = 40"),
                    HasSubstr("The scene with every default"), Not(HasSubstr("as it was written")), Not(HasSubstr("<iframe"))));
  EXPECT_THAT(file.player, HasSubstr("no replay: "));
}

TEST_F(ReportPage, ARunWhoseSceneIsInNoFileHasAPageThatSaysSo) {
  RunRecord read = recorded(fluid);
  read.source.reset();
  read.has_trajectory = false;
  const Page page = report_page(read, std::nullopt);
  EXPECT_THAT(words_of(page, "Scene"), HasSubstr("do not hold its scene"));
  EXPECT_THAT(words_of(page, "Pressure"), HasSubstr("No theory is given: the disks of the scene are in no file of the run."));
}

TEST_F(ReportPage, WithoutSamplesThereIsNothingToWatch) {
  std::string unsampled = fluid;
  unsampled.erase(unsampled.find("sample_every"));
  record(parse_scene(unsampled + "[observe]\ntemperature = true\n", "fluid.toml"), run_);
  const ReportFile file = report_of(run_);
  EXPECT_THAT(file.html,
              AllOf(HasSubstr("The run stored no samples"), HasSubstr("as it was written"), Not(HasSubstr("<iframe"))));
}

TEST_F(ReportPage, HoldsThePlayerAndItsOwnMarkFirst) {
  record(parse_scene(fluid, "fluid.toml", {"output.events=true"}), run_);
  const ReportFile file = report_of(run_);
  EXPECT_EQ(file.player, "with an exact replay");
  EXPECT_LT(file.html.find(report_mark), 512U);
  EXPECT_THAT(file.html,
              AllOf(HasSubstr("<iframe title=\"Replay of the run\" srcdoc=\"<!doctype html>"), Not(HasSubstr("<b>A fluid"))));
  EXPECT_EQ(report_of(run_).html, file.html) << "made from the files alone";
}

TEST_F(ReportPage, SaysHowFarTheTrajectoryCanBeTrustedWhereTheRunAsked) {
  RunRecord read = recorded(fluid);
  EXPECT_THAT(words_of(report_page(read, std::nullopt), "Accuracy"), Not(HasSubstr("this trajectory is right")));
  Horizon horizon;
  horizon.tolerance = 1e-3;
  horizon.sigma = 1.0;
  horizon.engine = "fast";
  horizon.rows = {{"textbook-float", 24, "textbook", 3.5, 7.0, false, std::nullopt, 0.0, 0.0},
                  {"fast", 53, "textbook-quad", 12.25, 40.0, false, std::nullopt, 0.0, 0.0}};
  horizon.ended = HorizonEnd::parted;
  append(read.report, horizon);
  EXPECT_THAT(
      words_of(report_page(read, std::nullopt, horizon_blocks), "Accuracy"),
      AllOf(
          HasSubstr("In double precision this trajectory is right to 0.001 diameters until t = 12.25 (40 collisions per disk)."),
          HasSubstr("24 | 3.5 | 7 | – |"), HasSubstr("53 | 12.25 | 40 | – |")));
}

TEST_F(ReportPage, SaysHowToMakeTheRunAgain) {
  const Page page = report_page(recorded(fluid, {"run.seed=7"}), std::nullopt);
  const auto again = std::find_if(page.facts.begin(), page.facts.end(), [](const auto& fact) { return fact.first == "Again"; });
  ASSERT_NE(again, page.facts.end());
  EXPECT_THAT(again->second, HasSubstr("carom run again.toml --engine fast. "));
  EXPECT_THAT(words_of(page, "Scene"), HasSubstr("seed = 7"));
}

}  // namespace
}  // namespace carom::test
