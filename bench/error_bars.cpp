// The calibration of error bars: every observable's scatter over runs that differ in their seed alone, over the error that they
// report. 1 is right; below, errors are too large, above too small. The study of docs/observables.md: not a benchmark, but
// the same scenes many times over.
//
//   error_bars [--seeds N] [--rows] [SCENE...]
//
// A ratio is the standard deviation of the values over the root mean square of their errors. Of N runs it is known to
// 1 / sqrt(2 (N - 1)). Rows of a table that belong together (lags of one stretch, all of g(r)) share a line: the root of their
// mean squared ratio, with the smallest and the largest. --rows prints each by itself. The last column counts the runs whose
// notes say that errors are lower bounds.

#include "observe/run_measurements.hpp"

#include <fmt/format.h>
#include <carom/carom.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace {

using namespace carom;

struct Case {
  const char* name;
  std::string scene;
};

constexpr std::string_view of_states =
    "pressure = true\ncollision_rate = true\ntemperature = true\nspeeds = true\nvelocity_moments = true\n"
    "mean_square_displacement = true\nvelocity_autocorrelation = true\n";
constexpr std::string_view of_structure =
    "radial_distribution = { range = 3.0 }\nstructure_factor = { largest = 10.0 }\nhexatic = true\n";
constexpr std::string_view of_relaxation = "overlap = true\nnon_gaussian = true\nvan_hove = { range = 3.0, bins = 30 }\n";
constexpr std::string_view of_scattering = "intermediate_scattering = { k = [1.5, 3.5, 6.3] }\n";
constexpr std::string_view of_places = "voronoi = { bins = 40 }\nclusters = true\ndensity_profile = { bins = 20 }\n";
constexpr std::string_view of_fields = "fields = { cells = [4, 4] }\n";
constexpr std::string_view of_contacts = "contact_values = true\n";

std::string box_of(std::string_view boundary, double aspect = 1.0) {
  return fmt::format("[box]\naspect = {}\nboundary = \"{}\"\n", aspect, boundary);
}
std::string disks(int count, double packing_fraction, std::string_view positions = "random") {
  return fmt::format(
      "[[disks]]\ncount = {}\nradius = 0.5\nmass = 1.0\npacking_fraction = {}\npositions = \"{}\"\nvelocities = {{ temperature = "
      "1.0 }}\n",
      count, packing_fraction, positions);
}
std::string mixture(double mass) {
  return fmt::format(
      "[[disks]]\nname = \"light\"\ncount = 48\nradius = 0.5\nmass = 1.0\npacking_fraction = 0.3\npositions = \"random\"\n"
      "velocities = {{ temperature = 1.0 }}\n[[disks]]\nname = \"heavy\"\ncount = 16\nradius = 0.5\nmass = {}\n"
      "positions = \"random\"\nvelocities = {{ temperature = 1.0 }}\n",
      mass);
}
std::string two_sizes(double packing_fraction) {
  return fmt::format(
      "[[disks]]\nname = \"small\"\ncount = 32\nradius = 0.5\nmass = 1.0\npositions = {{ packing_fraction = {0} }}\n"
      "velocities = {{ temperature = 1.0 }}\n[[disks]]\nname = \"large\"\ncount = 32\nradius = 0.7\nmass = 1.96\n"
      "positions = {{ packing_fraction = {0} }}\nvelocities = {{ temperature = 1.0 }}\n",
      packing_fraction);
}
std::string rule(std::string_view name) { return fmt::format("[collision]\nrule = \"{}\"\n", name); }
std::string run(double time, double equilibrate) {
  return fmt::format("[run]\ntime = {}\nsample_every = {}\nequilibrate = {{ collisions_per_disk = {} }}\n", time, time / 256.0,
                     equilibrate);
}

std::vector<Case> cases() {
  const std::string specular = rule("specular"), observe = fmt::format("[observe]\n{}", of_states);
  const std::string motion = fmt::format("{}{}", of_relaxation, of_scattering), relaxation(of_relaxation), places(of_places),
                    in_place = fmt::format("{}{}", of_places, of_fields), contacts(of_contacts);
  const std::string structure(of_structure), transport = "viscosity = true\nheat_conductivity = true\n",
                                             flights = "free_flight = true\n";
  const std::string thermal_walls =
      "[walls]\nleft = { temperature = 1.0 }\nright = { temperature = 1.0 }\nbottom = { temperature = 1.0 }\ntop = { temperature "
      "= "
      "1.0 }\n";
  return {
      {"gas", box_of("periodic") + disks(64, 0.2) + specular + run(400.0, 50) + observe + structure + transport + flights +
                  motion + in_place + contacts},
      {"dense", box_of("periodic") + disks(64, 0.62, "hexagonal") + specular + run(60.0, 200) + observe + structure + transport +
                    flights + motion + in_place + contacts},
      {"glassy", box_of("periodic") + two_sizes(0.74) + specular + run(150.0, 1000) + observe + motion + places + contacts},
      {"crystal", box_of("periodic", 2.0 / std::sqrt(3.0)) + disks(64, 0.78, "hexagonal") + specular + run(30.0, 100) + observe +
                      structure + flights + motion + in_place + contacts},
      {"walls", box_of("walls") + disks(64, 0.3) + specular + run(200.0, 50) + observe + flights + relaxation + in_place +
                    "wall_fluxes = true\n"},
      {"thermal_walls", box_of("walls") + disks(64, 0.3) + specular + thermal_walls + run(600.0, 200) + observe + flights +
                            relaxation + in_place + "wall_fluxes = true\n"},
      {"thermostat", box_of("periodic") + disks(64, 0.3) + specular + "[thermostat]\ntemperature = 1.0\nrate = 0.5\n" +
                         run(200.0, 100) + observe + motion + places},
      {"mixture_10", box_of("periodic") + mixture(10.0) + specular + run(300.0, 200) + observe + motion + contacts},
      {"mixture_1000", box_of("periodic") + mixture(1000.0) + specular + run(300.0, 200) + observe + motion + contacts},
      {"reversal",
       box_of("periodic") + disks(64, 0.3) + rule("reversal") + run(200.0, 50) + observe + structure + flights + motion + places},
      {"few", box_of("periodic") + disks(8, 0.3) + specular + run(400.0, 100) + observe + transport + motion + contacts},
  };
}

struct Seen {
  double lag = 0.0;  ///< over the time of the run
  std::vector<double> values, squared_errors;
  int unknown = 0;
  int bounds = 0;  ///< runs whose notes say that errors are lower bounds
};
using Numbers = std::map<std::string, std::vector<Seen>>;  ///< rows by name; one of a number by itself

void note(std::vector<Seen>& rows, std::size_t row, double lag, double value, double error, bool is_bound) {
  if (rows.size() <= row) rows.resize(row + 1);
  rows[row].lag = lag;
  rows[row].bounds += is_bound ? 1 : 0;
  if (!std::isfinite(error)) {
    ++rows[row].unknown;
  } else {
    rows[row].values.push_back(value);
    rows[row].squared_errors.push_back(error * error);
  }
}

void note(Numbers& numbers, const Measurement& measured, double time) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto says_so = [](const std::string& text) { return text.find("lower bound") != std::string::npos; };
  for (const Scalar& scalar : measured.scalars)
    if (scalar.value)
      note(numbers[measured.name + "." + scalar.name], 0, 0.0, *scalar.value, scalar.error.value_or(nan), says_so(scalar.note));
  for (const Table& table : measured.tables) {
    const std::vector<double>* lags = nullptr;
    for (std::size_t c = 0; c + 1 < table.columns.size(); ++c) {
      const Column &column = table.columns[c], &errors = table.columns[c + 1];
      if (column.name == "lag") lags = &column.values;
      if (errors.name != column.name + "_error") continue;
      for (std::size_t row = 0; row < column.values.size(); ++row)
        note(numbers[fmt::format("{}[{}]", table.name, column.name)], row, lags != nullptr ? (*lags)[row] / time : -1.0,
             column.values[row], errors.values[row], says_so(measured.note));
    }
  }
}

/// Standard deviation of the values over the root mean square of their errors; NaN of what is conserved, and scatters by
/// rounding.
double ratio(const Seen& seen) {
  const double n = static_cast<double>(seen.values.size());
  double mean = 0.0, scatter = 0.0, reported = 0.0;
  for (const double value : seen.values) mean += value / n;
  for (const double value : seen.values) scatter += (value - mean) * (value - mean) / (n - 1.0);
  for (const double square : seen.squared_errors) reported += square / n;
  return reported > 1e-24 * mean * mean ? std::sqrt(scatter / reported) : std::numeric_limits<double>::quiet_NaN();
}

void print(const std::string& name, const std::vector<Seen>& rows) {
  double squares = 0.0, least = 1e9, most = 0.0;
  int counted = 0, unknown = 0, bounds = 0;
  for (const Seen& seen : rows) {
    bounds = std::max(bounds, seen.bounds);
    const double found = seen.values.size() > 1 ? ratio(seen) : std::numeric_limits<double>::quiet_NaN();
    unknown += seen.unknown > static_cast<int>(seen.values.size()) ? 1 : 0;
    if (seen.unknown > static_cast<int>(seen.values.size()) || !std::isfinite(found)) continue;
    ++counted;
    squares += found * found;
    least = std::min(least, found);
    most = std::max(most, found);
  }
  if (counted == 0) {
    fmt::print("| {} | | | | {} unknown | |\n", name, unknown);
    return;
  }
  fmt::print("| {} | {:.2f} | {:.2f} | {:.2f} | {} | {} |\n", name, std::sqrt(squares / counted), least, most,
             unknown > 0 ? fmt::format("{}, {} unknown", counted, unknown) : fmt::format("{}", counted), bounds);
}

/// Lags in stretches of the time of the run.
void print_lags(const std::string& name, const std::vector<Seen>& rows) {
  constexpr std::array<double, 7> until = {0.005, 0.02, 0.05, 0.1, 0.2, 0.4, 1.0};
  for (std::size_t k = 0; k < until.size(); ++k) {
    std::vector<Seen> stretch;
    for (const Seen& seen : rows)
      if (seen.lag <= until[k] && (k == 0 || seen.lag > until[k - 1])) stretch.push_back(seen);
    if (!stretch.empty()) print(fmt::format("{} to lag {} of the run", name, until[k]), stretch);
  }
}

void study(const Case& one, int seeds, bool all_rows) {
  Numbers numbers;
  Scene scene = parse_scene(one.scene);
  for (int seed = 1; seed <= seeds; ++seed) {
    scene.run.seed = static_cast<std::uint64_t>(seed);
    Simulation simulation = make_simulation(scene);
    Observation observation(simulation);
    RunMeasurements measurements(simulation);
    RunHooks hooks;
    hooks.start = [&](const State& state) { measurements.start(state); };
    hooks.sample = [&](std::uint64_t, const State& state) { measurements.sample(state); };
    hooks.block = [&](const Progress& progress) { measurements.block(progress); };
    observation.attach(hooks);
    const RunResult result = run_schedule(simulation, hooks);
    const RunReport report = measurements.report(result, 0.0);
    if (report.Z)
      note(numbers["summary.Z"], 0, 0.0, *report.Z, report.Z_error.value_or(NAN),
           report.note_on_errors.find("lower bound") != std::string::npos);
    for (const Measurement& measured : observation.results()) note(numbers, measured, simulation.time());
  }
  fmt::print(
      "\n{}, {} seeds\n\n| number | scatter over reported | least | most | rows | runs that say lower bound |\n"
      "|---|---|---|---|---|---|\n",
      one.name, seeds);
  for (const auto& [name, rows] : numbers) {
    if (all_rows)
      for (const Seen& seen : rows) print(fmt::format("{} {:.5f}", name, seen.lag), {seen});
    else if (rows.size() > 1 && rows.front().lag >= 0.0)
      print_lags(name, rows);
    else
      print(name, rows);
  }
  std::fflush(stdout);
}

}  // namespace

int main(int arguments, char** argument) {
  int seeds = 100;
  bool all_rows = false;
  std::vector<std::string_view> wanted;
  for (int a = 1; a < arguments; ++a) {
    const std::string_view word = argument[a];
    if (word == "--seeds" && a + 1 < arguments)
      seeds = std::max(2, std::atoi(argument[++a]));
    else if (word == "--rows")
      all_rows = true;
    else
      wanted.push_back(word);
  }
  for (const Case& one : cases())
    if (wanted.empty() || std::ranges::find(wanted, one.name) != wanted.end()) study(one, seeds, all_rows);
  return 0;
}
