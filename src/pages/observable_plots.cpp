#include "pages/report_parts.hpp"

#include "observe/table_column.hpp"
#include "pages/field_maps.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

namespace carom {

namespace {

/// The columns of a plot: all that begin with `values`, one for each species where there are several.
struct Columns {
  const char* values = nullptr;
  const char* x = "";     ///< empty: the first of the table
  const char* name = "";  ///< in the legend, where the plot shows more than one quantity
};

struct Frame {
  const char* table;
  const char* id;
  const char* title;
  const char* x;
  const char* y;
  std::array<Columns, 2> columns;  ///< the second may be empty
  bool log_x = false, log_y = false;
  const char* caption = "";
  const char* quantity = "";             ///< whose value ends the names of columns where the table has several of its values
  const char* caption_of_quantity = "";  ///< and what is then added to the caption
};

constexpr std::array<Frame, 25> frames = {{
    {"speeds",
     "speeds",
     "Speeds",
     "speed",
     "density",
     {{{"density"}}},
     false,
     false,
     "Fraction of the disks per unit of speed, mean over the run."},
    {"energies",
     "energies",
     "Kinetic energies",
     "kinetic energy of a disk",
     "density",
     {{{"density"}}},
     false,
     true,
     "Fraction of the disks per unit of energy, mean over the run."},
    {"free_times",
     "free-times",
     "Free times",
     "time from collision to collision",
     "density",
     {{{"density"}}},
     false,
     true,
     "Flights that began and ended within the run. Fast disks collide more often, so the law is not a single exponential; the "
     "line is that of a dilute gas with this run's collision rate."},
    {"free_paths",
     "free-paths",
     "Free paths",
     "distance from collision to collision",
     "density",
     {{{"density"}}},
     false,
     true,
     "Flights that began and ended within the run."},
    {"radial_distribution",
     "radial-distribution",
     "Radial distribution",
     "r",
     "g(r)",
     {{{"g"}}},
     false,
     false,
     "Number of pairs at a distance r over that of an ideal gas."},
    {"structure_factor",
     "structure-factor",
     "Structure factor",
     "k",
     "S(k)",
     {{{"S"}}},
     false,
     false,
     "Mean over wave vectors of this length that fit the box."},
    {"hexatic_correlation",
     "hexatic-correlation",
     "Hexatic correlation",
     "r",
     "g6(r)",
     {{{"g6"}}},
     false,
     false,
     "Correlation of the directions to the six neighbours of two disks at a distance r."},
    {"voronoi_areas",
     "voronoi-areas",
     "Areas of Voronoi cells",
     "area of a cell over the mean area",
     "density",
     {{{"density"}}},
     false,
     false,
     "Fraction of the cells per unit of area, mean over the run."},
    {"voronoi_neighbours",
     "voronoi-neighbours",
     "Neighbours by Voronoi cells",
     "number of neighbours",
     "fraction of the disks",
     {{{"fraction"}}},
     false,
     false,
     "A perfect crystal has six neighbours; fives and sevens are its defects."},
    {"clusters",
     "clusters",
     "Sizes of clusters",
     "disks in a cluster",
     "clusters per disk",
     {{{"clusters_per_disk"}}},
     true,
     true,
     "Clusters of this size up to twice as many, of disks whose surfaces are nearer than the gap."},
    {"density_profile",
     "density-profile",
     "Density profile",
     "position",
     "disks per area",
     {{{"density"}}},
     false,
     false,
     "Mean over the run."},
    {"mean_square_displacement",
     "mean-square-displacement",
     "Mean square displacement",
     "time lag",
     "mean square displacement",
     {{{"msd"}}},
     true,
     true,
     "Disks move ballistically at first (with the square of time), and diffuse later (with time)."},
    {"mean_square_displacement",
     "diffusion-from-displacement",
     "Diffusion, from displacements",
     "time lag",
     "mean square displacement / 4 t",
     {{{"diffusion"}}},
     true,
     false,
     "In two dimensions this grows with the logarithm of time and has no limit."},
    {"intermediate_scattering",
     "intermediate-scattering",
     "Intermediate scattering",
     "time lag",
     "F(k,t)",
     {{{"F"}}},
     true,
     false,
     "Of all disks together, which begins at S(k), and of each by itself, which begins at 1.",
     "k",
     " Wave numbers k are in inverse mean diameters."},
    {"overlap",
     "overlap",
     "Overlap with an earlier configuration",
     "time lag",
     "Q(t)",
     {{{"overlap"}}},
     true,
     false,
     "Share of the disks that are still near the place where they were."},
    {"overlap",
     "overlap-fluctuations",
     "Fluctuations of the overlap",
     "time lag",
     "chi_4(t)",
     {{{"chi_4"}}},
     true,
     false,
     "Large where disks move in groups."},
    {"non_gaussian",
     "non-gaussian",
     "Non-Gaussian parameter",
     "time lag",
     "alpha_2(t)",
     {{{"alpha_2"}}},
     true,
     false,
     "Zero where displacements are Gaussian, as in diffusion."},
    {"van_hove",
     "van-hove",
     "Displacements",
     "distance moved",
     "density",
     {{{"density"}}},
     false,
     false,
     "Fraction of the disks per unit of distance, for each time lag."},
    {"velocity_autocorrelation",
     "velocity-autocorrelation",
     "Autocorrelation of velocity",
     "time lag",
     "mean of v(0) v(t)",
     {{{"correlation"}}},
     true,
     false,
     "Beyond the first lags it is the correlation of mean velocities over windows."},
    {"velocity_autocorrelation",
     "diffusion-from-velocity",
     "Diffusion, from velocities",
     "time integrated to",
     "D(t)",
     {{{"diffusion", "integral_to"}}},
     true,
     false,
     "Integral of the autocorrelation up to this time."},
    {"viscosity",
     "viscosity",
     "Viscosity",
     "time lag",
     "viscosity",
     {{{"green_kubo", "integral_to", "Green-Kubo"}, {"einstein_helfand", "lag", "Einstein-Helfand"}}},
     true,
     false,
     "Two estimates of the same value, which they reach before the time that sound takes through the box."},
    {"viscosity",
     "viscosity-correlation",
     "Correlation of the flux of momentum",
     "time lag",
     "mean of J(0) J(t)",
     {{{"correlation"}}},
     true,
     false,
     "Its integral is the viscosity."},
    {"heat_conductivity",
     "heat-conductivity",
     "Heat conductivity",
     "time lag",
     "heat conductivity",
     {{{"green_kubo", "integral_to", "Green-Kubo"}, {"einstein_helfand", "lag", "Einstein-Helfand"}}},
     true,
     false,
     "Two estimates of the same value, which they reach before the time that sound takes through the box."},
    {"heat_conductivity",
     "heat-correlation",
     "Correlation of the flux of heat",
     "time lag",
     "mean of J(0) J(t)",
     {{{"correlation"}}},
     true,
     false,
     "Its integral is the heat conductivity."},
    {"h_function",
     "h-function",
     "Boltzmann's H",
     "time",
     "H",
     {{{"H"}}},
     false,
     false,
     "H of the velocities at each instant. It falls to that of Maxwell's distribution and stays there."},
}};

bool is_error(const Column& column) { return column.name.ends_with("_error"); }

/// Returns text such as "density", "density_small", but not "density_error".
std::vector<const Column*> with_species(const Table& table, std::string_view base) {
  std::vector<const Column*> found;
  for (const Column& column : table.columns) {
    const std::string_view name = column.name;
    const bool belongs = name == base || (name.starts_with(base) && name.size() > base.size() && name[base.size()] == '_');
    if (belongs && !is_error(column)) found.push_back(&column);
  }
  return found;
}

Series series_of(const Table& table, const Column& x, const Column& y, std::string name, int group) {
  constexpr std::size_t most_points = 130;  // with error bars; more run into each other
  Series series{.name = std::move(name), .x = x.values, .y = y.values, .style = Style::points, .group = group};
  const Column* const error = find_column(table, y.name + "_error");
  if (error != nullptr)
    for (std::size_t k = 0; k < y.values.size(); ++k) {
      series.y_low.push_back(y.values[k] - error->values[k]);
      series.y_high.push_back(y.values[k] + error->values[k]);
    }
  if (y.values.size() > most_points) series.style = error != nullptr ? Style::band : Style::line;
  return series;
}

/// `quantity` is that whose value ends the name of the column; empty where none does.
std::string label_of(const Columns& columns, const Column& column, bool alone, const std::string& quantity) {
  std::string suffix = column.name.substr(std::string_view(columns.values).size()), at;
  if (!quantity.empty()) {
    const std::size_t value = suffix.rfind('_');
    at = fmt::format("{} = {}, ", quantity, suffix.substr(value + 1));
    suffix.resize(value);
  }
  if (*columns.name != '\0') return columns.name + suffix;
  if (suffix.empty()) return at + (alone ? "measured" : "all disks");
  std::string words = suffix.substr(1);
  std::replace(words.begin(), words.end(), '_', ' ');
  return at + words;
}

constexpr int line_group = 6;  // the colour of theory

Plot plot_of(const Frame& frame, const Table& table, const RunTheory& theory) {
  Plot plot{.id = frame.id, .title = frame.title, .caption = frame.caption, .x = {.log = frame.log_x}, .y = {.log = frame.log_y}};
  std::vector<Series> lines;
  int group = 0;
  for (const Columns& columns : frame.columns) {
    if (columns.values == nullptr) continue;
    const std::vector<const Column*> found = with_species(table, columns.values);
    const bool has_values = *frame.quantity != '\0' && !found.empty() && find_column(table, columns.values) == nullptr;
    if (has_values) plot.caption += frame.caption_of_quantity;
    for (const Column* const column : found) {
      const Column* const x = *columns.x == '\0' ? &table.columns.front() : find_column(table, columns.x);
      if (x == nullptr) continue;
      if (plot.series.empty()) {
        plot.x.title = with_unit(frame.x, x->unit);
        plot.y.title = with_unit(frame.y, column->unit);
        for (const TheoryMark& mark : theory.marks(table, column->name))
          plot.marks.push_back(
              {.axis = mark.on_first_column ? Mark::Across::x : Mark::Across::y, .value = mark.value, .label = mark.label});
      }
      plot.series.push_back(
          series_of(table, *x, *column, label_of(columns, *column, found.size() == 1, has_values ? frame.quantity : ""), group));
      for (TheoryCurve& curve : theory.curves(table, column->name)) {
        Series law{.name = std::move(curve.name),
                   .x = std::move(curve.x),
                   .y = std::move(curve.y),
                   .style = curve.dashed ? Style::dashed : Style::line,
                   .group = line_group};
        if (found.size() > 1) {
          law.group = group;
          law.name += ", " + plot.series.back().name;
          law.style = Style::dashed;
        }
        lines.push_back(std::move(law));
      }
      ++group;
    }
  }
  const bool lacks_errors = std::any_of(plot.series.begin(), plot.series.end(), [](const Series& series) {
    return std::any_of(series.y_low.begin(), series.y_low.end(), [](double low) { return !std::isfinite(low); });
  });
  if (lacks_errors) plot.caption += " Points without a bar have no error, because the run is too short.";
  for (Series& law : lines) plot.series.push_back(std::move(law));
  return plot;
}

/// Plots a table of any kind against its first column.
Plot plain_plot_of(const Table& table) {
  std::string id = table.name;
  std::replace_if(
      id.begin(), id.end(), [](char c) { return !((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')); }, '-');
  Plot plot{.id = id, .title = table.name, .x = {.title = with_unit(table.columns.front().name, table.columns.front().unit)}};
  int group = 0;
  for (std::size_t c = 1; c < table.columns.size(); ++c)
    if (const Column& column = table.columns[c]; !is_error(column))
      plot.series.push_back(series_of(table, table.columns.front(), column, with_unit(column.name, column.unit), group++));
  return plot;
}

}  // namespace

namespace {

/// Returns the plots of a line of cells, a field each.
std::vector<Plot> plots_of_profile(const Table& profile) {
  std::vector<Plot> plots;
  for (std::size_t c = 1; c < profile.columns.size(); ++c) {
    if (is_error(profile.columns[c]) || profile.columns[c].name == "area") continue;
    const std::string& name = profile.columns[c].name;
    std::string id = "field-" + name;
    std::replace(id.begin(), id.end(), '_', '-');
    std::string title = name;
    std::replace(title.begin(), title.end(), '_', ' ');
    plots.push_back({.id = id,
                     .title = "Profile of " + title,
                     .x = {.title = with_unit(profile.columns[0].name, profile.columns[0].unit)},
                     .y = {.title = with_unit(title, profile.columns[c].unit)},
                     .series = {series_of(profile, profile.columns[0], profile.columns[c], "measured", 0)}});
  }
  return plots;
}

}  // namespace

std::vector<Plot> plots_of(const Table& table, const RunTheory& theory) {
  std::vector<Plot> plots;
  if (table.name == "fields_in_time") return plots;
  if (table.columns.size() < 2 || table.columns.front().values.empty()) return plots;
  if (table.name == "fields") {
    const std::optional<Table> profile = profile_of_fields(table);
    return profile ? plots_of_profile(*profile) : plots;
  }
  for (const Frame& frame : frames)
    if (table.name == frame.table) plots.push_back(plot_of(frame, table, theory));
  if (plots.empty()) plots.push_back(plain_plot_of(table));
  return plots;
}

}  // namespace carom
