#pragma once
// A page with everything that a page can have: six methods in a log-log plot, bands, error bars, marks, gaps, an empty plot, a
// table and a listing. The numbers look like a comparison of methods but come from formulas.

#include <carom/pages/page.hpp>

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace carom::test {

/// Error against cost of a method whose error falls with that power of the cost, down to where rounding ends it.
inline Series work_precision(const std::string& name, int group, double order, double error, double floor) {
  Series series{.name = name, .group = group};
  for (int k = 0; k < 13; ++k) {
    const double cost = std::pow(10.0, -2.0 + 0.35 * k);
    const double ripple = 1.0 + 0.2 * std::sin(2.1 * k + group);
    series.x.push_back(cost);
    series.y.push_back(ripple * std::max(error * std::pow(cost / 0.01, -order), floor));
    series.y_low.push_back(0.6 * series.y.back());
    series.y_high.push_back(1.7 * series.y.back());
    series.labels.push_back(fmt::format("dt = {:.3g}", std::pow(10.0, -1.0 - 0.35 * k)));
  }
  return series;
}

inline Plot work_precision_plot() {
  Plot plot{
      .id = "work-precision",
      .title = "Error at the end against computing time",
      .caption = "Each point is one step size; bars span the middle half of 20 runs. The event-driven run has no step to choose.",
      .x = {.title = "computing time (s)", .log = true},
      .y = {.title = "largest error of a position (box lengths)", .log = true}};
  plot.series = {work_precision("event-driven", 0, 0.0, 3e-14, 3e-14), work_precision("first order", 1, 1.0, 0.3, 1e-15),
                 work_precision("second order", 2, 2.0, 0.2, 3e-13),   work_precision("fourth order", 3, 4.0, 0.1, 1e-12),
                 work_precision("bisection", 4, 1.5, 0.05, 1e-11),     work_precision("penalty force", 5, 0.5, 0.4, 1e-15)};
  plot.marks = {{.axis = Mark::Across::y, .value = 2.2e-16, .label = "one unit of rounding"}};
  return plot;
}

/// An error that grows exponentially until it is as large as the box, with its quartiles.
inline Series growing_error(const std::string& name, int group, double begin, Style style) {
  Series series{.name = name, .style = style, .group = group};
  for (int k = 0; k <= 100; ++k) {
    const double time = 0.05 * k;
    const double error = begin * std::exp(6.0 * time);
    const double median = error / (1.0 + error) * (1.0 + 0.15 * std::sin(5.0 * time + group));
    series.x.push_back(time);
    series.y.push_back(k == 0 ? 0.0 : median);  // no error at the beginning: not drawn on a logarithmic axis
    series.y_low.push_back(0.35 * series.y.back());
    series.y_high.push_back(std::min(2.4 * series.y.back(), 1.4));
  }
  return series;
}

inline Plot growing_error_plot() {
  Plot plot{
      .id = "error-growth",
      .title = "Error against time",
      .caption =
          "Median of 20 runs and the region that holds the middle half of them. Errors grow until nothing of the start is left.",
      .x = {.title = "time t (scene units)"},
      .y = {.title = "error of a position (box lengths)", .log = true}};
  plot.series = {growing_error("event-driven", 0, 1e-15, Style::band), growing_error("second order", 2, 1e-7, Style::band),
                 growing_error("first order", 1, 1e-4, Style::band)};
  plot.series.push_back(
      {.name = "exp(6 t)", .x = {0.0, 5.0}, .y = {1e-15, 1e-15 * std::exp(30.0)}, .style = Style::dashed, .group = 6});
  plot.marks = {{.axis = Mark::Across::x, .value = 1.9, .label = "first order lost"},
                {.axis = Mark::Across::y, .value = 0.03, .label = "one radius"}};
  return plot;
}

/// Points with error bars about a line, one of them not a number.
inline Plot pressure_plot() {
  Plot plot{.id = "pressure",
            .title = "Pressure of the runs",
            .caption = "Compressibility factor with its standard error, times ten, against the equation of state.",
            .x = {.title = "packing fraction"},
            .y = {.title = "Z = P A / (N kT)"}};
  Series measured{.name = "measured", .style = Style::points, .group = 0};
  Series theory{.name = "equation of state", .style = Style::line, .group = 6};
  for (int k = 1; k <= 13; ++k) {
    const double eta = 0.05 * k;
    const double z = (1.0 + eta * eta / 8.0) / ((1.0 - eta) * (1.0 - eta));
    theory.x.push_back(eta);
    theory.y.push_back(z);
    measured.x.push_back(eta);
    measured.y.push_back(k == 7 ? std::numeric_limits<double>::quiet_NaN() : z * (1.0 + 0.02 * std::sin(3.0 * k)));
    measured.y_low.push_back(measured.y.back() - 0.03 * z);
    measured.y_high.push_back(measured.y.back() + 0.03 * z);
  }
  plot.series = {theory, measured};
  plot.series.push_back({.name = "not asked for", .x = {0.1, 0.6}, .y = {1.0, 5.0}, .group = 7, .visible = false});
  plot.series.push_back({.name = "nothing measured", .group = 3});
  return plot;
}

inline Page sample_page() {
  Page page{.title = "Event-driven against time-stepped: the classic box",
            .subtitle = "64 disks in a box with hard walls, centre-of-mass reversal, until t = 5",
            .lead =
                "The event-driven run is exact to rounding and takes 0.02 s. The stepper needs `dt = 1e-6` and 400 times as long "
                "to come "
                "within one radius of it, and no step keeps it there beyond t = 3.1.",
            .key_numbers = {{"400 \u00d7", "faster than the stepper at equal error"},
                            {"3.1", "time at which the best stepper has lost every disk"},
                            {"2.2\u00b710\u207b\u00b9\u2074", "energy drift of the event-driven run"}}};
  TextTable table{.title = "Methods at their best", .columns = {"method", "order", "dt", "error", "time (s)"}};
  table.rows = {{"event-driven", "\u2013", "\u2013", "3.0e-14", "0.021"},
                {"first order", "1", "1e-06", "2.1e-05", "8.14"},
                {"second order", "2", "1e-06", "3.0e-13", "9.20"},
                {"penalty force", "0.5", "1e-06", "1.3e-03", "12.7"}};
  table.caption = "The smallest error over all step sizes, and what it took on one core.";
  page.sections = {
      {"What accuracy costs",
       {Paragraph{"Computing time counts the loop alone: reading the scene and writing files are left out."},
        work_precision_plot(), table}},
      {"How errors grow",
       {Paragraph{"Hard disks are chaotic: two runs that differ in the last bit part exponentially."}, growing_error_plot()}},
      {"What stays the same", {pressure_plot()}},
      {"What was not measured",
       {Plot{.id = "empty", .title = "A plot without points", .x = {.title = "x"}, .y = {.title = "y", .log = true}},
        Listing{"The scene", "[box]\nx = [-1.0, 1.0]\ny = [-1.0, 1.0]\nboundary = \"walls\"\n"}}}};
  page.facts = {
      {"Program", "carom 0.1.0, commit 0123456789ab"}, {"Command", "carom compare docs/scenes/box.toml"}, {"Seed", "1"}};
  return page;
}

}  // namespace carom::test
