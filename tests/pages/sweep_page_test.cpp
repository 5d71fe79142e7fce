// The page of a sweep: a curve for every combination of what else is changed, with error bars, in the order of x.

#include "studies/sweep/products.hpp"

#include "studies/sweep/numbers.hpp"
#include "support/browser.hpp"
#include "support/child_process.hpp"
#include "text/numbers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <variant>
#include <vector>

namespace carom::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

SweepPoint point(const std::string& name, std::vector<std::string> values) {
  return {.name = name, .values = std::move(values), .places = {}, .where = {}};
}

/// Z at three radii in two kinds of box, with a seed that failed; and a number that is the same everywhere.
Sweep two_boxes() {
  Sweep sweep;
  sweep.source = "boxes.toml";
  sweep.scene_path = "gas.toml";
  sweep.text = "scene = <gas>";
  sweep.keys = {"disks.0.radius", "box.boundary"};
  sweep.seeds = {1, 2};
  for (const char* boundary : {"\"walls\"", "\"periodic\""})
    for (const char* radius : {"0.3", "0.1"}) sweep.points.push_back(point(std::string(boundary) + radius, {radius, boundary}));
  return sweep;
}

SweepResults results_of(const Sweep& sweep) {
  SweepResults results;
  results.numbers = {"pressure.Z", "time"};
  results.units = {"", "time"};
  results.versions = {"1 (commit a)"};
  for (std::size_t run = 0; run < sweep.run_count(); ++run) {
    const double Z = static_cast<double>(run);
    results.runs.push_back({.state = RunState::finished});
    results.values.push_back({Z, 5.0});
  }
  results.runs.back() = {.state = RunState::failed, .failure = "no room"};
  results.values.back() = {std::nullopt, std::nullopt};
  for (std::size_t p = 0; p < sweep.points.size(); ++p) {
    results.averages.push_back({average_of({results.values[2 * p][0], results.values[2 * p + 1][0]}),
                                average_of({results.values[2 * p][1], results.values[2 * p + 1][1]})});
  }
  return results;
}

TEST(SweepPage, HasACurveForEveryCombinationOfTheOtherKeysWithErrorBars) {
  const Sweep sweep = two_boxes();
  const Page page = sweep_page(sweep, results_of(sweep));
  ASSERT_EQ(page.sections[0].heading, "pressure.Z");
  ASSERT_EQ(page.sections[0].blocks.size(), 1U);  // the kind of box is no axis
  const Plot& plot = std::get<Plot>(page.sections[0].blocks[0]);
  ASSERT_EQ(plot.series.size(), 2U);
  EXPECT_EQ(plot.x.title, "disks.0.radius (length in scene units)");
  EXPECT_EQ(plot.y.title, "pressure.Z");
  EXPECT_EQ(plot.series[0].name, "boundary = walls");
  EXPECT_THAT(plot.series[0].x, ElementsAre(0.1, 0.3));
  EXPECT_THAT(plot.series[0].y, ElementsAre(2.5, 0.5));
  EXPECT_THAT(plot.series[0].y_low, ElementsAre(2.0, 0.0));  // of two values half their distance
  EXPECT_THAT(plot.series[0].y_high, ElementsAre(3.0, 1.0));
  EXPECT_THAT(plot.series[1].y_low, ElementsAre(6.0, 4.0));  // one seed has no error
}

TEST(UnitWords, ALabelHasItsUnitBehindItAndAPureNumberNone) {
  EXPECT_EQ(with_unit("Z", ""), "Z");
  EXPECT_EQ(with_unit("time", "time"), "time (scene units)");
  EXPECT_EQ(with_unit("from", "degrees"), "from (degrees)");
  EXPECT_EQ(with_unit("speed", "length / time"), "speed (length / time in scene units)");
  EXPECT_EQ(unit_words("energy^2 length^2 / time^2"), "energy² length² / time²");
  EXPECT_EQ(unit_words("length^3 / time^4"), "length³ / time⁴");
}

TEST(SweepUnits, AreThoseOfTheTablesInTheDocs) {
  const std::vector<std::array<const char*, 2>> numbers = {{"time", "time"},
                                                           {"energy.final", "energy"},
                                                           {"energy.relative_drift", ""},
                                                           {"momentum.final.0", "mass length / time"},
                                                           {"temperature.mean", "energy"},
                                                           {"pressure.Z", ""},
                                                           {"events.pair", ""},
                                                           {"walls.left.pressure", "energy / area"},
                                                           {"thermostat.thermostat", ""},
                                                           {"thermostat.energy", "energy"},
                                                           {"shear.pressure_xy.flight", "energy / area"},
                                                           {"shear.strain", ""}};
  for (const auto& [name, unit] : numbers) EXPECT_EQ(unit_of_number(name), unit) << name;
}

TEST(SweepPage, LeavesOutNumbersThatAreTheSameEverywhereAndListsWhatFailed) {
  const Sweep sweep = two_boxes();
  const Page page = sweep_page(sweep, results_of(sweep));
  std::vector<std::string> headings;
  for (const Section& section : page.sections) headings.push_back(section.heading);
  EXPECT_THAT(headings, ElementsAre("pressure.Z", "All numbers", "Failed runs", "Sweep and scene"));
  EXPECT_THAT(std::get<TextTable>(page.sections[2].blocks[0]).rows,
              ElementsAre(ElementsAre("\"periodic\"0.1/seed=2", "no room")));
  EXPECT_THAT(page.lead, HasSubstr("7 of 8 runs are finished, 1 failed."));
  EXPECT_THAT(html_page(page), HasSubstr("scene = &lt;gas&gt;"));
}

TEST(BrowserSweepPage, DrawsItsPlots) {
  if (!has_browser()) GTEST_SKIP() << no_browser;
  const Sweep sweep = two_boxes();
  const TemporaryDirectory directory;
  write_text(directory.file("report.html"), html_page(sweep_page(sweep, results_of(sweep))));
  const std::string dom = dump_dom(directory.file("report.html"));
  const std::string root = dom.substr(0, dom.find("<head>"));
  EXPECT_THAT(root, HasSubstr("data-errors=\"\""));
  EXPECT_THAT(root, HasSubstr("data-plots=\"1\""));
}

}  // namespace
}  // namespace carom::test
