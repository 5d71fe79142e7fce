#include "studies/sweep/theory.hpp"

#include "simulation/start.hpp"

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <utility>

namespace carom {

namespace {

/// Returns what theories read of a run: the number of its disks, their density and kT.
RunReport bare_report(const Scene& scene, const Disks& disks, double temperature) {
  RunReport report;
  report.disks = static_cast<std::int64_t>(disks.count());
  report.packing_fraction = scene.packing_fraction();
  report.temperature_mean = temperature;
  return report;
}

}  // namespace

struct SweepTheory::Point {
  Scene scene;
  Disks disks;
  RunReport report;
  RunTheory theory;

  Point(Scene its_scene, double temperature)
      : scene(std::move(its_scene)),
        disks(all_disks(scene)),
        report(bare_report(scene, disks, temperature)),
        theory(report, TheorySource{scene, disks, scene.species.size()}) {}
};

namespace {

/// Returns the value of a curve at x, between its points; nothing beyond its ends.
std::optional<double> value_on(const TheoryCurve& curve, double x) {
  const auto above = std::lower_bound(curve.x.begin(), curve.x.end(), x);
  if (above == curve.x.end() || (above == curve.x.begin() && *above != x)) return {};
  const auto k = static_cast<std::size_t>(above - curve.x.begin());
  if (*above == x) return curve.y[k];
  const double share = (x - curve.x[k - 1]) / (curve.x[k] - curve.x[k - 1]);
  return (1.0 - share) * curve.y[k - 1] + share * curve.y[k];
}

/// Returns what a theory says of a number in a table.
std::optional<Expected> value_in(const RunTheory& theory, const TableNumber& number) {
  if (number.at.size() != 1) return {};
  // Of a curve only the value at one place is wanted; those that are drawn over the whole of a table end there.
  const Table table{.name = number.table, .columns = {{"lag", "", number.at}, {number.column, "", {0.0}}}};
  for (const TheoryCurve& curve : theory.curves(table, number.column))
    if (const std::optional<double> value = value_on(curve, number.at.front())) return Expected{*value, curve.name};
  if (number.column != "diffusion" && number.column != "green_kubo") return {};  // others come to their mark somewhere else
  for (const TheoryMark& mark : theory.marks(table, number.column))
    if (!mark.on_first_column) return Expected{mark.value, mark.label};
  return {};
}

constexpr std::size_t most_points = 1000;

}  // namespace

bool same_curve(const TheoryCurve& one, const TheoryCurve& other) {
  const auto same = [](double a, double b) { return a == b || !differ(a, b); };
  return one.name == other.name && std::ranges::equal(one.x, other.x, same) && std::ranges::equal(one.y, other.y, same);
}

SweepTheory::SweepTheory(const Sweep& sweep, const SweepResults& results) : sweep_(sweep), results_(results) {
  if (sweep.points.size() > most_points || results.temperatures.size() < sweep.points.size()) return;
  for (std::size_t point = 0; point < sweep.points.size(); ++point) {
    points_.emplace_back();
    if (const std::optional<double> kT = results.temperatures[point].mean)
      points_.back() = std::make_unique<Point>(sweep.scene_of(point * sweep.seeds.size()), *kT);
  }
}

SweepTheory::~SweepTheory() = default;

std::optional<Expected> SweepTheory::of(std::size_t point, const std::string& number) const {
  if (point >= points_.size() || !points_[point]) return {};
  const RunTheory& theory = points_[point]->theory;
  if (const std::optional<TableNumber> in_table = table_number(number)) return value_in(theory, *in_table);
  constexpr std::string_view observables = "observables.";
  const std::string rest = number.starts_with(observables) ? number.substr(observables.size()) : number;
  const std::size_t dot = rest.find('.');
  return dot == std::string::npos ? std::nullopt : theory.of(rest.substr(0, dot), rest.substr(dot + 1));
}

const std::vector<std::unique_ptr<SweepTheory::Point>>& SweepTheory::runs_of(std::size_t point) {
  const auto [entry, fresh] = runs_.try_emplace(point);
  const std::size_t seeds = sweep_.seeds.size();
  if (fresh && sweep_.run_count() <= most_points)
    for (std::size_t run = point * seeds; run < (point + 1) * seeds; ++run)
      if (const std::optional<double> kT = results_.runs[run].temperature)
        entry->second.push_back(std::make_unique<Point>(sweep_.scene_of(run), *kT));
  return entry->second;
}

std::vector<TheoryCurve> SweepTheory::curves(std::size_t point, const Table& table, const std::string& column) {
  std::optional<std::vector<TheoryCurve>> first;
  for (const std::unique_ptr<Point>& run : runs_of(point)) {
    std::vector<TheoryCurve> curves = run->theory.curves(table, column);
    const std::vector<double>& x = table.columns.front().values;
    for (const TheoryMark& mark : run->theory.marks(table, column))
      if (!mark.on_first_column)
        curves.push_back({.name = mark.label, .dashed = true, .x = {x.front(), x.back()}, .y = {mark.value, mark.value}});
    if (!first)
      first = std::move(curves);
    else if (!std::ranges::equal(*first, curves, same_curve))
      return {};
  }
  return first.value_or(std::vector<TheoryCurve>());
}

}  // namespace carom
