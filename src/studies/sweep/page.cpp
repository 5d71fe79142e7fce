#include "studies/sweep/products.hpp"

#include "pages/field_maps.hpp"
#include "studies/sweep/numbers.hpp"
#include "studies/sweep/results.hpp"
#include "studies/sweep/seed_tables.hpp"
#include "studies/sweep/sweep.hpp"
#include "studies/sweep/theory.hpp"
#include "text/number_in.hpp"
#include "text/numbers.hpp"

#include <carom/version.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace carom {

namespace {

constexpr std::size_t most_visible = 8;  // as many colours as there are

struct PlottedPoint {
  double x = 0.0;
  SeedAverage y;
  std::string label;
  std::optional<Expected> theory = {};
};

struct PlottedCurve {
  std::string name;
  std::vector<PlottedPoint> points;
};

/// Returns the values that distinguish a point from others that differ only in this key: "count=200, boundary=periodic".
std::string others_of(const Sweep& sweep, const SweepPoint& point, std::size_t key) {
  const std::vector<std::string> keys = short_keys(sweep.keys);
  std::string text;
  for (std::size_t k = 0; k < keys.size(); ++k)
    if (k != key && !point.values[k].empty())
      text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", keys[k], plain_value(point.values[k]));
  return text;
}

std::vector<PlottedCurve> curves_of(const Sweep& sweep, const SweepResults& results, const SweepTheory& theory,
                                    std::size_t number, std::size_t key) {
  std::vector<PlottedCurve> curves;
  for (std::size_t p = 0; p < sweep.points.size(); ++p) {
    const SweepPoint& point = sweep.points[p];
    const std::optional<double> x = number_in<double>(point.values[key]);
    const SeedAverage& y = results.averages[p][number];
    if (!x || !y.mean) continue;
    const std::string name = others_of(sweep, point, key);
    auto curve = std::find_if(curves.begin(), curves.end(), [&](const PlottedCurve& c) { return c.name == name; });
    if (curve == curves.end()) curve = curves.insert(curves.end(), {.name = name, .points = {}});
    curve->points.push_back({*x, y, fmt::format("{}: {} seeds", point.name, y.count), theory.of(p, results.numbers[number])});
  }
  for (PlottedCurve& curve : curves)
    std::stable_sort(curve.points.begin(), curve.points.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  return curves;
}

Series series_of(const PlottedCurve& curve, std::size_t place, const std::string& otherwise) {
  Series series{
      .name = curve.name.empty() ? otherwise : curve.name, .group = static_cast<int>(place), .visible = place < most_visible};
  for (const PlottedPoint& point : curve.points) {
    const double error = point.y.error.value_or(0.0);
    series.x.push_back(point.x);
    series.y.push_back(*point.y.mean);
    series.y_low.push_back(*point.y.mean - error);
    series.y_high.push_back(*point.y.mean + error);
    series.labels.push_back(point.label);
  }
  return series;
}

constexpr int line_of_theory = 6;  // its colour, as on the page of a run

/// Returns what theory says at the points of a curve; empty where it says nothing.
Series theory_of(const PlottedCurve& curve, std::size_t place, bool alone) {
  Series series{.style = alone ? Style::line : Style::dashed,
                .group = alone ? line_of_theory : static_cast<int>(place),
                .visible = place < most_visible};
  for (const PlottedPoint& point : curve.points) {
    if (!point.theory) continue;
    const std::string& source = point.theory->source;
    if (series.x.empty()) series.name = source;
    // Sources that differ do so behind a comma: "..., N = 64".
    if (series.name != source) series.name = source.substr(0, source.find(','));
    series.x.push_back(point.x);
    series.y.push_back(point.theory->value);
    series.labels.push_back(source);
  }
  if (series.x.size() == 1) series.style = Style::levels;
  if (!alone && !curve.name.empty()) series.name += ", " + curve.name;
  return series;
}

bool has_several_numbers(const Sweep& sweep, std::size_t key) {
  std::set<double> values;
  for (const SweepPoint& point : sweep.points)
    if (const std::optional<double> value = number_in<double>(point.values[key])) values.insert(*value);
  return values.size() > 1;
}

/// Returns whether the number differs between runs: else a plot shows nothing.
bool varies(const SweepResults& results, std::size_t number) {
  std::optional<double> least, most;
  for (const std::vector<std::optional<double>>& run : results.values) {
    if (!run[number]) continue;
    least = std::min(least.value_or(*run[number]), *run[number]);
    most = std::max(most.value_or(*run[number]), *run[number]);
  }
  return least && differ(*least, *most);
}

/// Returns plots of a number against each key with more than one numeric value: a curve for every combination of the others, and
/// lines of theory where there is one.
std::vector<Plot> plots_of(const Sweep& sweep, const SweepResults& results, const SweepTheory& theory, std::size_t number) {
  std::vector<Plot> plots;
  const std::string& name = results.numbers[number];
  for (std::size_t key = 0; key < sweep.keys.size(); ++key) {
    if (!has_several_numbers(sweep, key)) continue;
    const std::vector<PlottedCurve> curves = curves_of(sweep, results, theory, number, key);
    if (curves.empty()) continue;
    Plot plot{.id = fmt::format("number-{}-key-{}", number, key),
              .title = fmt::format("{} against {}", name, sweep.keys[key]),
              .x = {.title = with_unit(sweep.keys[key], unit_of_key(sweep.keys[key]))},
              .y = {.title = with_unit(name, results.units[number])}};
    if (sweep.seeds.size() > 1) plot.caption = "Means over seeds; bars are their standard errors.";
    if (curves.size() > most_visible)
      plot.caption += fmt::format(" The first {} curves are drawn; click on others in the legend.", most_visible);
    for (std::size_t place = 0; place < curves.size(); ++place) plot.series.push_back(series_of(curves[place], place, name));
    for (std::size_t place = 0; place < curves.size(); ++place)
      if (Series line = theory_of(curves[place], place, curves.size() == 1); !line.x.empty())
        plot.series.push_back(std::move(line));
    if (std::ranges::find(plot.series, Style::levels, &Series::style) != plot.series.end())
      plot.caption += fmt::format("{}Short lines are theory.", plot.caption.empty() ? "" : " ");
    plots.push_back(std::move(plot));
  }
  return plots;
}

constexpr std::size_t most_rows = 1000;  // of a table; more make a browser slow, and are in the files

/// Columns are numbers; so that a page is wide enough, some at a time.
std::vector<Block> tables_of(const Sweep& sweep, const SweepResults& results) {
  constexpr std::size_t at_a_time = 6;
  std::vector<Block> tables;
  for (std::size_t first = 0; first < std::max<std::size_t>(1, results.numbers.size()); first += at_a_time) {
    const std::size_t end = std::min(first + at_a_time, results.numbers.size());
    TextTable table{.columns = {"point", "finished"}};
    for (std::size_t k = first; k < end; ++k) table.columns.push_back(with_unit(results.numbers[k], results.units[k]));
    for (std::size_t point = 0; point < std::min(most_rows, sweep.points.size()); ++point) {
      table.rows.push_back({sweep.points[point].name,
                            fmt::format("{} of {}", results.count(sweep, point, RunState::finished), sweep.seeds.size())});
      for (std::size_t k = first; k < end; ++k) table.rows.back().push_back(average_words(results.averages[point][k]));
    }
    tables.emplace_back(std::move(table));
  }
  if (sweep.points.size() > most_rows)
    tables.emplace_back(Paragraph{fmt::format("And {} more in `sweep.csv`.", sweep.points.size() - most_rows)});
  return tables;
}

/// A line of theory, and which point of the sweep it belongs to.
struct LineOfPoint {
  std::size_t place = 0;  ///< among the points in the plot
  TheoryCurve curve;
};

/// Columns of tables of one name, a series for each point.
struct PlotOfColumn {
  std::string key;  ///< table and column
  Plot plot;
  std::vector<LineOfPoint> lines = {};
};

Series series_of(const Column& x, const Column& y, const Column& error, std::size_t place, const std::string& name) {
  Series series{.name = name,
                .x = x.values,
                .y = y.values,
                .style = Style::band,
                .group = static_cast<int>(place),
                .visible = place < most_visible};
  for (std::size_t r = 0; r < series.y.size(); ++r) {
    series.y_low.push_back(series.y[r] - error.values[r]);
    series.y_high.push_back(series.y[r] + error.values[r]);
  }
  return series;
}

/// Adds the lines of theory: one where it is the same for all points, else one for each in its colour.
void add_lines(PlotOfColumn& one) {
  std::vector<Series>& series = one.plot.series;
  const std::size_t points = series.size();
  for (LineOfPoint& line : one.lines) {
    const auto is_same = [&](const LineOfPoint& other) { return same_curve(other.curve, line.curve); };
    const auto same = static_cast<std::size_t>(std::ranges::count_if(one.lines, is_same));
    const bool of_all = same == points, is_first = &line == &*std::ranges::find_if(one.lines, is_same);
    if (of_all && !is_first) continue;
    series.push_back({.name = line.curve.name + (of_all ? "" : ", " + series[line.place].name),
                      .x = line.curve.x,
                      .y = line.curve.y,
                      .style = line.curve.dashed || !of_all ? Style::dashed : Style::line,
                      .group = of_all ? line_of_theory : static_cast<int>(line.place),
                      .visible = line.place < most_visible});
  }
}

/// Returns plots of the columns with errors of every curve, with a series for each point and theory beside it, and the maps of
/// fields on grids.
Section section_of_tables(const Sweep& sweep, const std::vector<SeedTable>& tables, SweepTheory& theory) {
  constexpr std::size_t most_plots = 40;
  std::vector<PlotOfColumn> plots;
  std::vector<Block> maps;
  for (const SeedTable& one : tables) {
    if (!one.fault.empty()) continue;
    const std::string& point = sweep.points[one.point].name;
    const bool is_fields = one.table.name == "fields";
    const std::optional<Table> profile = is_fields ? profile_of_fields(one.table) : std::nullopt;
    if (is_fields && !profile && maps.size() < 2 * most_visible)
      if (std::optional<std::string> page = field_maps(one.table)) {
        maps.emplace_back(Paragraph{fmt::format("`fields` of {}, means over seeds:", point)});
        maps.emplace_back(EmbeddedPage{fmt::format("Maps of the fields of {}", point), std::move(*page)});
      }
    const Table& table = profile ? *profile : one.table;
    if (!is_curve(table) || table.columns.front().values.size() < 2) continue;
    const std::vector<Column>& columns = table.columns;
    for (std::size_t c = 1; c + 1 < columns.size(); ++c) {
      if (columns[c + 1].name != columns[c].name + "_error") continue;
      const std::string key = table.name + " " + columns[c].name;
      auto plot = std::ranges::find(plots, key, &PlotOfColumn::key);
      if (plot == plots.end()) {
        if (plots.size() == most_plots) continue;
        plots.push_back({key,
                         {.id = fmt::format("table-{}", plots.size()),
                          .title = fmt::format("{}: {}", table.name, columns[c].name),
                          .caption = "Means over seeds; bars are their standard errors.",
                          .x = {.title = with_unit(columns[0].name, columns[0].unit),
                                .log = columns[0].name == "lag" && columns[0].values[0] > 0.0},
                          .y = {.title = with_unit(columns[c].name, columns[c].unit)}}});
        plot = plots.end() - 1;
      }
      const std::size_t place = plot->plot.series.size();
      plot->plot.series.push_back(series_of(columns[0], columns[c], columns[c + 1], place, point));
      for (TheoryCurve& curve : theory.curves(one.point, table, columns[c].name))
        plot->lines.push_back({place, std::move(curve)});
    }
  }
  Section section{.heading = "Tables of observables", .blocks = {}};
  for (PlotOfColumn& one : plots) {
    add_lines(one);
    section.blocks.emplace_back(std::move(one.plot));
  }
  std::ranges::move(maps, std::back_inserter(section.blocks));
  return section;
}

TextTable failures_of(const Sweep& sweep, const SweepResults& results) {
  TextTable table{.columns = {"run", "what happened"}};
  for (std::size_t run = 0; run < results.runs.size() && table.rows.size() < most_rows; ++run)
    if (results.runs[run].state == RunState::failed)
      table.rows.push_back({sweep.directory_of(run).string(), results.runs[run].failure});
  return table;
}

std::string lead_of(const Sweep& sweep, const SweepResults& results) {
  const std::size_t finished = results.count(RunState::finished), failed = results.count(RunState::failed);
  std::string text = fmt::format("{} of {} runs are finished", grouped(finished), grouped(sweep.run_count()));
  if (failed > 0) text += fmt::format(", {} failed", grouped(failed));
  text += ".";
  if (sweep.seeds.size() > 1) text += " Numbers are means over the seeds of a point, with the standard error from their scatter.";
  return text;
}

}  // namespace

Page sweep_page(const Sweep& sweep, const SweepResults& results, const std::vector<SeedTable>& tables) {
  Page page{
      .generator = "carom sweep",
      .title = fmt::format("Sweep: {}", sweep.source),
      .subtitle = fmt::format("{} of {}, {} each; {}", counted(sweep.points.size(), "point"), sweep.scene_path,
                              counted(sweep.seeds.size(), "seed"),
                              sweep.keys.empty() ? "only the seed changes" : fmt::format("{}", fmt::join(sweep.keys, ", "))),
      .lead = lead_of(sweep, results)};
  constexpr std::size_t most_plotted = 40;
  std::size_t plotted = 0;
  SweepTheory theory(sweep, results);
  for (std::size_t k = 0; k < results.numbers.size() && plotted < most_plotted; ++k) {
    if (!varies(results, k)) continue;
    Section section{.heading = results.numbers[k], .blocks = {}};
    for (Plot& plot : plots_of(sweep, results, theory, k)) section.blocks.emplace_back(std::move(plot));
    if (section.blocks.empty()) continue;
    page.sections.push_back(std::move(section));
    ++plotted;
  }
  if (Section section = section_of_tables(sweep, tables, theory); !section.blocks.empty())
    page.sections.push_back(std::move(section));
  page.sections.push_back({"All numbers", tables_of(sweep, results)});
  if (results.count(RunState::failed) > 0) page.sections.push_back({"Failed runs", {failures_of(sweep, results)}});
  page.sections.push_back({"Sweep and scene", {Listing{"The sweep", sweep.text}, Listing{"The scene", sweep.scene_text}}});
  page.facts = {{"Sweep", sweep.source},
                {"Scene", sweep.scene_path},
                {"Page by", fmt::format("carom {} (commit {})", build_info().version, build_info().commit)}};
  if (!results.versions.empty()) page.facts.emplace_back("Runs by", fmt::format("carom {}", fmt::join(results.versions, ", ")));
  return page;
}

}  // namespace carom
