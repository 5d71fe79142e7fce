// The page of a comparison: everything that was measured is on it, and a real browser draws it.

#include "studies/compare/page.hpp"

#include "pages/page_parts.hpp"
#include "studies/compare/plots.hpp"
#include "support/browser.hpp"
#include "support/child_process.hpp"
#include "support/comparisons.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

namespace carom::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

const Series* series_of(const Plot& plot, const std::string& name) {
  for (const Series& series : plot.series)
    if (series.name == name) return &series;
  return nullptr;
}

const TextTable& table_of(const Page& page, const std::string& title) {
  for (const Section& section : page.sections)
    for (const Block& block : section.blocks)
      if (const TextTable* table = std::get_if<TextTable>(&block); table != nullptr && table->title == title) return *table;
  throw std::runtime_error("there is no table " + title);
}

/// Those that can be drawn, of the series that are shown from the beginning.
int points_of(const Plot& plot) {
  const auto fits = [](double value, const Axis& axis) { return std::isfinite(value) && (!axis.log || value > 0.0); };
  int points = 0;
  for (const Series& series : plot.series)
    for (std::size_t k = 0; series.visible && k < series.x.size(); ++k)
      if (fits(series.x[k], plot.x) && fits(series.y[k], plot.y)) ++points;
  return points;
}

std::vector<CostPoint> some_costs(double packing_fraction) {
  std::vector<CostPoint> costs;
  for (const char* method : {"fast", "grid"}) {
    const double dt = std::string(method) == "fast" ? 0.0 : 0.01;
    for (const std::int64_t disks : {64, 256, 1024}) costs.push_back({disks, packing_fraction, method, dt, 0.5, 1e-6, 2.0, 0.5});
    for (const double density : {0.1, 0.7}) costs.push_back({1024, density, method, dt, 0.5, 1e-6, 2.0, 0.5});
  }
  return costs;
}

TEST(ComparePage, AHorizonBeyondTheDataIsToldAndStretchesNoAxis) {
  Comparison comparison = KnownLaws{}.comparison();
  HorizonRow row;
  row.engine = "fast";
  const auto is_drawn = [&](double time) {
    row.time = time;
    comparison.plan.horizon.rows = {row};
    const Plot plot = error_in_time(comparison);
    const bool told = plot.caption.find("lies beyond the end, at") != std::string::npos;
    const auto is_horizon = [](const Mark& mark) { return mark.label.starts_with("horizon"); };
    const bool drawn = std::any_of(plot.marks.begin(), plot.marks.end(), is_horizon);
    EXPECT_NE(told, drawn);
    return drawn;
  };
  EXPECT_TRUE(is_drawn(KnownLaws::end));
  EXPECT_FALSE(is_drawn(1.01 * KnownLaws::end));
}

TEST(ComparePage, WorkPrecisionHasAPointForEveryMethodAndStep) {
  const KnownLaws laws;
  const Page page = compare_page(laws.comparison({"grid", "naive"}), dozen_scene(), "carom compare");
  const Plot plot = plots_of(page).front();
  EXPECT_EQ(plot.id, "work-precision");
  ASSERT_EQ(plot.series.size(), 3U);
  const Series* grid = series_of(plot, name_of("grid"));
  ASSERT_NE(grid, nullptr);
  ASSERT_EQ(grid->x.size(), laws.dts.size());
  for (std::size_t k = 0; k < laws.dts.size(); ++k) {
    EXPECT_EQ(grid->x[k], laws.step_seconds / laws.dts[k]);
    EXPECT_EQ(grid->y[k], laws.error_per_dt * laws.dts[k]);
  }
  const Series* exact = series_of(plot, name_of("fast"));
  ASSERT_NE(exact, nullptr);
  EXPECT_THAT(exact->x, ElementsAre(laws.exact_seconds));
  EXPECT_THAT(exact->y, ElementsAre(1e-15));
}

TEST(ComparePage, BiasesAreTakenFromTheExactEngineSeedBySeed) {
  const KnownLaws laws;
  const std::vector<Plot> plots = plots_of(compare_page(laws.comparison(), dozen_scene(), ""));
  const auto bias = std::find_if(plots.begin(), plots.end(), [](const Plot& plot) { return plot.id == "bias-z"; });
  ASSERT_NE(bias, plots.end());
  const Series* grid = series_of(*bias, name_of("grid"));
  ASSERT_TRUE(grid != nullptr && grid->y.size() == laws.dts.size() && grid->y_low.size() == laws.dts.size());
  for (std::size_t k = 0; k < laws.dts.size(); ++k) {
    const double error =
        100.0 * laws.e / std::sqrt(3.0);       // of the mean of four that deviate by e; what the starts share has cancelled
    EXPECT_EQ(grid->x[k], laws.dts[k] / 0.5);  // mean free times
    EXPECT_NEAR(grid->y[k], 100.0 * laws.bias_per_dt * laws.dts[k], 1e-12);
    EXPECT_NEAR(grid->y_high[k] - grid->y[k], error, 1e-12);
    EXPECT_NEAR(grid->y[k] - grid->y_low[k], error, 1e-12);
  }
}

TEST(ComparePage, ThePricesHaveARowForEveryMethodAndSayWhyOneIsMissing) {
  KnownLaws laws;
  laws.starts = 8;
  Comparison comparison = laws.comparison({"grid", "backtrack"});
  for (MethodRun& run : comparison.runs)
    if (run.method.name == "backtrack") run.error[0] = run.method.dt <= 0.01 ? 1e-14 : 0.5;
  const Page page = compare_page(comparison, dozen_scene(), "");
  const TextTable& table = table_of(page, "Prices");
  ASSERT_EQ(table.rows.size(), 4U);
  EXPECT_THAT(table.rows[0], ElementsAre("exact: fast engine", "1 ×", "1 ×", HasSubstr("1 ×"), HasSubstr("1 ×")));
  EXPECT_EQ(table.rows[1][1], "50 ×, dt = 4e-05, extrapolated by 5 in dt");
  EXPECT_EQ(table.rows[2][0], "backtrack");
  EXPECT_EQ(table.rows[2][2], "0.1 ×, dt = 0.02");
  EXPECT_THAT(table.rows[3], ElementsAre("grid, Richardson", "–", "–", HasSubstr(" ×"), HasSubstr(" ×")));
  laws.error_per_dt = 1e9;
  comparison = laws.comparison();
  const Page without_law = compare_page(comparison, dozen_scene(), "");
  EXPECT_THAT(table_of(without_law, "Prices").rows[1][1], HasSubstr("not reached: the error is"));
}

TEST(ComparePage, TheHorizonOfEveryStepStandsAtItsPrice) {
  // Errors of e, 2 e, 4 e, 8 e at times 2, 4, 6, 8 pass 1e-3 where e is between 1.25e-4 and 1e-3: with dt = 0.01 and 0.003 only.
  KnownLaws laws;
  Comparison comparison = laws.comparison();
  HorizonRow row;
  row.engine = "textbook";
  row.collisions_per_disk = 40.0;
  row.seconds = 2.0;
  comparison.plan.horizon.rows = {row};
  comparison.plan.horizon.timed_until = 4.0;
  const std::vector<Plot> plots = plots_of(compare_page(comparison, dozen_scene(), ""));
  const auto trust = std::find_if(plots.begin(), plots.end(), [](const Plot& plot) { return plot.id == "trust"; });
  ASSERT_NE(trust, plots.end());
  const Series* grid = series_of(*trust, name_of("grid"));
  ASSERT_TRUE(grid != nullptr && grid->x.size() == 2);
  // 1e-6 / 0.01 s for a time of 2; a mean free time of 0.5; twelve disks; in nanoseconds.
  EXPECT_NEAR(grid->x[0], 1e-4 / 2.0 * 0.5 / 12.0 * 1e9, 1e-9);
  EXPECT_NEAR(grid->y[0], 4.0 / 0.5, 1e-9);
  EXPECT_NEAR(grid->y[1], (6.0 + 2.0 * std::log2(1.0 / 0.6)) / 0.5, 1e-9);  // from 6e-4 to 1.2e-3
  const Series* exact = series_of(*trust, name_of("textbook"));
  ASSERT_TRUE(exact != nullptr && exact->x.size() == 1);
  EXPECT_NEAR(exact->x[0], 2.0 / 4.0 * 0.5 / 12.0 * 1e9, 1e-6);
  EXPECT_EQ(exact->y[0], 40.0);
}

TEST(ComparePage, StepsWithAMistakeHaveAPlotWhereThereAreSome) {
  Comparison comparison = KnownLaws{}.comparison({"backtrack"});
  const auto page = [&] { return compare_page(comparison, dozen_scene(), ""); };
  EXPECT_THAT(html_page(page()), HasSubstr("No method that finds contacts within a step was compared"));
  comparison.runs[1].mistakes = StepMistakes{.steps = 200, .mistaken = 0};
  EXPECT_THAT(html_page(page()), HasSubstr("Of 200 steps of the methods that find contacts within a step, none had a mistake"));
  comparison.runs[1].mistakes->mistaken = 50;
  const std::vector<Plot> plots = plots_of(page());
  const auto plot = std::find_if(plots.begin(), plots.end(), [](const Plot& p) { return p.id == "mistakes"; });
  ASSERT_NE(plot, plots.end());
  EXPECT_THAT(plot->series.front().y, ElementsAre(0.25));
  EXPECT_NEAR(plot->series.front().y_high.front() - 0.25, std::sqrt(0.25 * 0.75 / 200.0), 1e-15);
}

TEST(ComparePage, TheLawOfTheBiasIsDrawnForTheFluidThatItKnows) {
  const auto law_in = [](const Scene& scene) {
    const std::vector<Plot> plots = plots_of(compare_page(KnownLaws{}.comparison(), scene, ""));
    for (const Plot& plot : plots)
      if (const Series* law = series_of(plot, "law of the smaller diameter"); plot.id == "bias-z" && law != nullptr) return *law;
    return Series{};
  };
  const Series law = law_in(dozen_scene());
  ASSERT_FALSE(law.x.empty());
  // Proportional to dt.
  EXPECT_NEAR(law.y.front() / law.x.front(), law.y.back() / law.x.back(), 1e-12 * std::abs(law.y.front() / law.x.front()));
  EXPECT_LT(law.y.front(), 0.0);
  EXPECT_TRUE(law_in(dozen_scene(Boundary::walls)).x.empty());
}

TEST(ComparePage, CostsAreThereWhereTheyWereMeasuredAndInOrder) {
  Comparison comparison = KnownLaws{}.comparison();
  const Scene scene = dozen_scene();
  EXPECT_THAT(ids_of(compare_page(comparison, scene, "")), Not(Contains("cost-size")));
  comparison.costs = some_costs(scene.packing_fraction());
  const Page page = compare_page(comparison, scene, "");
  EXPECT_THAT(ids_of(page), ElementsAre("work-precision", "trust", "error-in-time", "faults", "overlap", "bias-z", "bias-rate",
                                        "bias-path", "cost-size", "cost-density"));
  const std::vector<Plot> plots = plots_of(page);
  EXPECT_THAT(plots[8].series.front().x, ElementsAre(64.0, 256.0, 1024.0));
  EXPECT_THAT(plots[9].series.front().x, ElementsAre(0.1, scene.packing_fraction(), 0.7));
}

TEST(ComparePage, EnergyHasAPlotWhereItHasChangedAndASentenceWhereItHasNot) {
  Comparison comparison = KnownLaws{}.comparison();
  const Scene scene = dozen_scene();
  EXPECT_THAT(html_page(compare_page(comparison, scene, "")), HasSubstr("no method changed it at any time step"));
  comparison.runs[1].energy_drift = 3e-16;
  EXPECT_THAT(ids_of(compare_page(comparison, scene, "")), Contains("energy"));
}

TEST(ComparePage, TheTableHasARowForEveryMethodAndStepAndNamesWhatWasLeftOut) {
  const KnownLaws laws;
  Comparison comparison = laws.comparison({"grid", "naive"});
  comparison.left_out = {{{"guarded", 1e-9}, 600.0, ""},
                         {{"soft", 0.1}, 0.0, "soft disks have no gravity"},
                         {{"soft", 0.2}, 0.0, "soft disks have no gravity"}};
  const Page page = compare_page(comparison, dozen_scene(), "carom compare dozen.toml");
  const TextTable& table = table_of(page, "Every method and step");
  EXPECT_EQ(table.rows.size(), 1U + 2U * laws.dts.size());
  for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
  const TextTable& to_Z = table_of(page, "Processor time for Z");
  EXPECT_EQ(to_Z.rows.size(), 4U);  // with Richardson's of grid
  for (const auto& row : to_Z.rows) EXPECT_EQ(row.size(), to_Z.columns.size());
  const std::string html = html_page(page);
  EXPECT_THAT(html, HasSubstr("guarded with dt = 1e-09 (about 10 min)"));
  EXPECT_THAT(html, HasSubstr("Not run: soft: soft disks have no gravity."));
  EXPECT_EQ(html.find("soft: soft"), html.rfind("soft: soft")) << "a reason is told once";
  EXPECT_THAT(html, HasSubstr("carom compare dozen.toml"));
}

TEST(BrowserComparePage, DrawsEveryPlotOfARealComparisonWhateverItsTitle) {
  if (!has_browser()) GTEST_SKIP() << no_browser;
  Scene scene = dozen_scene(Boundary::walls);
  scene.title = "</script><script>document.title='taken'</script><b>&amp;";
  Comparison comparison = compare(scene, dozen_options({0.04, 0.02, 0.01, 0.005}, 2), {});
  ASSERT_TRUE(comparison.complete);
  comparison.costs = some_costs(scene.packing_fraction());
  const Page page = compare_page(comparison, scene, scene.title);
  const TemporaryDirectory directory;
  write_text(directory.file("report.html"), html_page(page));
  const std::string dom = dump_dom(directory.file("report.html"));
  EXPECT_THAT(dom.substr(0, dom.find("<head>")), HasSubstr("data-errors=\"\""));
  EXPECT_THAT(dom.substr(0, dom.find("<head>")), HasSubstr("data-plots=\"11\""));
  EXPECT_THAT(dom, HasSubstr("<h1>Error and cost: &lt;/script&gt;&lt;script&gt;document.title='taken'"));
  EXPECT_THAT(dom, Not(HasSubstr("<title>taken")));
  for (const Plot& plot : plots_of(page)) {
    const std::size_t figure = dom.find("id=\"plot-" + plot.id + "\"");
    ASSERT_NE(figure, std::string::npos) << plot.id;
    EXPECT_GT(points_of(plot), 0) << plot.id;
    EXPECT_THAT(dom.substr(figure, dom.find('>', figure) - figure),
                HasSubstr("data-points=\"" + std::to_string(points_of(plot)) + "\""))
        << plot.id;
  }
}

}  // namespace
}  // namespace carom::test
