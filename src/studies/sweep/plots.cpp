#include "studies/sweep/plots.hpp"

#include "studies/sweep/names.hpp"
#include "studies/sweep/units.hpp"
#include "studies/sweep/values.hpp"
#include "text/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace carom {

namespace {

constexpr std::size_t most_visible = 8;  // as many colours as there are

struct PlottedPoint {
  double x = 0.0;
  SeedAverage y;
  std::string label;
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

std::vector<PlottedCurve> curves_of(const Sweep& sweep, const SweepResults& results, std::size_t number, std::size_t key) {
  std::vector<PlottedCurve> curves;
  for (std::size_t p = 0; p < sweep.points.size(); ++p) {
    const SweepPoint& point = sweep.points[p];
    const std::optional<double> x = number_of(point.values[key]);
    const SeedAverage& y = results.averages[p][number];
    if (!x || !y.mean) continue;
    const std::string name = others_of(sweep, point, key);
    auto curve = std::find_if(curves.begin(), curves.end(), [&](const PlottedCurve& c) { return c.name == name; });
    if (curve == curves.end()) curve = curves.insert(curves.end(), {.name = name, .points = {}});
    curve->points.push_back({*x, y, fmt::format("{}: {} seeds", point.name, y.count)});
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

bool has_several_numbers(const Sweep& sweep, std::size_t key) {
  std::set<double> values;
  for (const SweepPoint& point : sweep.points)
    if (const std::optional<double> value = number_of(point.values[key])) values.insert(*value);
  return values.size() > 1;
}

}  // namespace

bool varies(const SweepResults& results, std::size_t number) {
  std::optional<double> least, most;
  for (const std::vector<std::optional<double>>& run : results.values) {
    if (!run[number]) continue;
    least = std::min(least.value_or(*run[number]), *run[number]);
    most = std::max(most.value_or(*run[number]), *run[number]);
  }
  return least && differ(*least, *most);
}

std::vector<Plot> plots_of(const Sweep& sweep, const SweepResults& results, std::size_t number) {
  std::vector<Plot> plots;
  const std::string& name = results.numbers[number];
  for (std::size_t key = 0; key < sweep.keys.size(); ++key) {
    if (!has_several_numbers(sweep, key)) continue;
    const std::vector<PlottedCurve> curves = curves_of(sweep, results, number, key);
    if (curves.empty()) continue;
    Plot plot{.id = fmt::format("number-{}-key-{}", number, key),
              .title = fmt::format("{} against {}", name, sweep.keys[key]),
              .x = {.title = with_unit(sweep.keys[key], unit_of_key(sweep.keys[key]))},
              .y = {.title = with_unit(name, results.units[number])}};
    if (sweep.seeds.size() > 1) plot.caption = "Means over seeds; bars are their standard errors.";
    if (curves.size() > most_visible)
      plot.caption += fmt::format(" The first {} curves are drawn; click on others in the legend.", most_visible);
    for (std::size_t place = 0; place < curves.size(); ++place) plot.series.push_back(series_of(curves[place], place, name));
    plots.push_back(std::move(plot));
  }
  return plots;
}

}  // namespace carom
