#include "pages/report_parts.hpp"

#include "text/numbers.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

const std::vector<double>* sampled(const RunRecord::Source& source, const std::string& name) {
  for (const Column& column : source.sampled)
    if (column.name == name) return &column.values;
  return nullptr;
}

/// Returns whether values change by more than rounding.
bool changes(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return low != values.end() && *high - *low > 1e-9 * std::max(std::abs(*low), std::abs(*high));
}

struct Sampled {
  const char* dataset;
  const char* name;
};

Plot plot_of(const RunRecord::Source& source, const char* id, const char* title, const char* y, const std::vector<Sampled>& all) {
  Plot plot{.id = id, .title = title, .x = {.title = with_unit("time", "time")}, .y = {.title = y}};
  bool any_changes = false;
  for (const Sampled& one : all) {
    const std::vector<double>* const values = sampled(source, one.dataset);
    if (values == nullptr) continue;
    any_changes = any_changes || changes(*values);
    plot.series.push_back(
        {.name = one.name, .x = source.times, .y = *values, .style = Style::line, .group = static_cast<int>(plot.series.size())});
  }
  if (!any_changes) plot.series.clear();
  return plot;
}

}  // namespace

TextTable table_of_rows(const SummaryRows& rows, const std::string& title) {
  TextTable table{.title = title, .columns = {"", "", ""}};
  for (const SummaryRow& row : rows) table.rows.push_back({row.quantity, row.value, row.remark});
  return table;
}

Plot energy_plot(const RunRecord::Source& source) {
  const std::vector<double>* energy = sampled(source, "total_energy");
  if (energy == nullptr) energy = sampled(source, "kinetic_energy");
  Plot plot{.id = "energy",
            .title = "Change of energy",
            .caption = "(E(t) - E(0)) / E(0) at the samples; it should be rounding only.",
            .x = {.title = with_unit("time", "time")},
            .y = {.title = "relative change"}};
  if (energy == nullptr || energy->size() < 2 || energy->front() == 0.0) return plot;
  Series series{.name = "energy", .x = source.times, .style = Style::line};
  for (const double value : *energy) series.y.push_back((value - energy->front()) / std::abs(energy->front()));
  plot.series = {series};
  return plot;
}

std::vector<Plot> plots_over_time(const RunRecord::Source& source) {
  std::vector<Plot> plots = {
      plot_of(source, "temperature", "Temperature", "kT (energy in scene units)",
              {{"temperature", "of velocities"}, {"spin_temperature", "of spins"}}),
      plot_of(source, "energies-over-time", "Energy by kind", "energy (scene units)",
              {{"kinetic_energy", "kinetic"},
               {"spin_energy", "of spins"},
               {"potential_energy", "potential"},
               {"piston_energy", "of pistons"},
               {"total_energy", "total"}}),
      plot_of(source, "packing-fraction", "Packing fraction", "packing fraction", {{"packing_fraction", "packing fraction"}}),
      plot_of(source, "bonds", "Bonds", "pairs within each other's well, or within the steps of the potential",
              {{"bonds", "bonds"}})};
  std::erase_if(plots, [](const Plot& plot) { return plot.series.empty(); });
  if (sampled(source, "total_energy") == nullptr)  // kinetic energy is the temperature over again
    std::erase_if(plots, [](const Plot& plot) { return plot.id == "energies-over-time"; });
  return plots;
}

}  // namespace carom
