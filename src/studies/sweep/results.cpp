#include "studies/sweep/results.hpp"

#include "observe/table_column.hpp"
#include "studies/sweep/seed_tables.hpp"
#include "text/number_in.hpp"
#include "text/numbers.hpp"

#include <carom/observe.hpp>

#include <fmt/format.h>
#include <boost/math/statistics/univariate_statistics.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace carom {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

/// Returns the text as JSON stores it: a path need not be UTF-8.
std::string kept(const std::string& text) { return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace); }

/// Network file systems remember for a while that a file was not there; to list its directory makes them ask again.
void look_again(const fs::path& directory) {
  std::error_code ignored;
  for (fs::directory_iterator entry(directory, ignored); entry != fs::directory_iterator(); entry.increment(ignored)) continue;
}

std::optional<double> mean_temperature(const Json& summary) {
  const auto of_run = summary.find("temperature");
  if (of_run == summary.end() || !of_run->contains("mean") || !of_run->at("mean").is_number()) return {};
  return of_run->at("mean").get<double>();
}

FoundRun run_of(const Json& summary, const std::string& resolved) {
  const std::string stopped = summary.at("stopped");
  if (stopped == "interrupted") return {};
  if (kept(summary.at("resolved_scene")) != kept(resolved)) return {.state = RunState::other};
  if (!summary.value("measured", true))
    return {.state = RunState::failed, .failure = fmt::format("the run ended while it was still equilibrating ({})", stopped)};
  const Json& build = summary.at("carom");
  return {.state = RunState::finished,
          .stopped = stopped,
          .version = fmt::format("{} (commit {})", build.value("version", "?"), build.value("commit", "?")),
          .numbers = numbers_of(summary),
          .temperature = mean_temperature(summary)};
}

}  // namespace

std::string_view to_string(RunState state) {
  switch (state) {
    case RunState::missing:
      return "missing";
    case RunState::finished:
      return "finished";
    case RunState::failed:
      return "failed";
    case RunState::other:
      return "other";
  }
  return "";
}

FoundRun find_run(const fs::path& directory, const std::function<std::string()>& resolved) {
  look_again(directory);
  if (std::ifstream file(directory / failure_file); file) {
    FoundRun run{.state = RunState::failed};
    std::getline(file, run.failure);
    return run;
  }
  std::error_code error;
  if (!fs::is_regular_file(directory / "summary.json", error)) return {};
  try {
    return run_of(Json::parse(std::ifstream(directory / "summary.json")), resolved());
  } catch (const Json::exception&) {  // cut short, or not a summary
    return {};
  }
}

namespace {

/// Numbers of one run, by name.
using Numbers = std::vector<SummaryNumber>;

bool is_wanted(const Sweep& sweep, const std::string& name) {
  return sweep.table.empty() ? is_usual_number(name)
                             : std::find(sweep.table.begin(), sweep.table.end(), name) != sweep.table.end();
}

/// Adds the numbers of the sweep's table that are in tables of the run's observables.
void add_table_numbers(const Sweep& sweep, const fs::path& directory, Numbers& numbers) {
  std::map<std::string, std::optional<Table>> tables;
  for (const std::string& name : sweep.table) {
    const std::optional<TableNumber> wanted = table_number(name);
    if (!wanted) continue;
    const auto [entry, fresh] = tables.emplace(wanted->table, std::nullopt);
    const fs::path file = directory / fmt::format("observe_{}.csv", wanted->table);
    try {
      if (fresh && fs::is_regular_file(file)) entry->second = read_observed_table(file);
    } catch (const std::runtime_error&) {  // the run is finished, but this file of it is damaged: it has no such number
    }
    if (!entry->second) continue;
    const Column* const column = find_column(*entry->second, wanted->column);
    numbers.push_back({name, value_at(*entry->second, wanted->column, wanted->at), column == nullptr ? "" : column->unit});
  }
}

/// A number that the summary has of itself and an observable measures too, under the second name.
struct DuplicateNumber {
  std::string_view own, observed;
};
constexpr std::array<DuplicateNumber, 3> duplicate_numbers = {{{"pressure.Z", "observables.pressure.Z"},
                                                               {"pressure.reduced", "observables.pressure.reduced"},
                                                               {"temperature.mean", "observables.temperature.kT"}}};

/// Leaves out numbers that are there twice.
void drop_duplicates(std::vector<std::string>& columns) {
  for (const DuplicateNumber& number : duplicate_numbers)
    if (std::find(columns.begin(), columns.end(), number.observed) != columns.end())
      std::erase_if(columns, [&](const std::string& name) { return name == number.own; });
}

/// Returns the usual numbers that any run has, in the order in which they first appear and none twice; those asked for, in the
/// order asked for.
std::vector<std::string> columns_of(const Sweep& sweep, const std::vector<Numbers>& found) {
  if (!sweep.table.empty()) return sweep.table;
  std::vector<std::string> columns;
  for (const Numbers& numbers : found)
    for (const SummaryNumber& number : numbers)
      if (number.value && std::find(columns.begin(), columns.end(), number.name) == columns.end()) columns.push_back(number.name);
  drop_duplicates(columns);
  return columns;
}

/// Returns the unit from the first run that has the number.
std::string unit_in(const std::vector<Numbers>& found, const std::string& name) {
  for (const Numbers& numbers : found)
    for (const SummaryNumber& number : numbers)
      if (number.name == name) return number.unit;
  return {};
}

std::optional<double> value_of(const Numbers& numbers, const std::string& name) {
  const auto found = std::find_if(numbers.begin(), numbers.end(), [&](const SummaryNumber& n) { return n.name == name; });
  return found == numbers.end() ? std::nullopt : found->value;
}

}  // namespace

SeedAverage average_of(const std::vector<std::optional<double>>& values) {
  std::vector<double> present;
  for (const std::optional<double>& value : values)
    if (value) present.push_back(*value);
  SeedAverage average{.count = present.size(), .mean = {}, .error = {}};
  if (present.empty()) return average;
  average.mean = boost::math::statistics::mean(present);
  if (present.size() > 1)
    average.error = std::sqrt(boost::math::statistics::sample_variance(present) / static_cast<double>(present.size()));
  return average;
}

std::size_t SweepResults::count(const Sweep& sweep, std::size_t point, RunState state) const {
  const std::size_t seeds = sweep.seeds.size();
  const auto begin = runs.begin() + static_cast<std::ptrdiff_t>(point * seeds);
  return static_cast<std::size_t>(
      std::count_if(begin, begin + static_cast<std::ptrdiff_t>(seeds), [&](const FoundRun& run) { return run.state == state; }));
}

std::size_t SweepResults::count(RunState state) const {
  return static_cast<std::size_t>(
      std::count_if(runs.begin(), runs.end(), [&](const FoundRun& run) { return run.state == state; }));
}

SweepResults collect(const Sweep& sweep, const std::filesystem::path& directory) {
  SweepResults results;
  std::vector<Numbers> found;
  for (std::size_t run = 0; run < sweep.run_count(); ++run) {
    FoundRun one = find_run(directory / sweep.directory_of(run), [&] { return resolved_toml(sweep.scene_of(run)); });
    found.push_back(std::exchange(one.numbers, {}));
    std::erase_if(found.back(), [&](const SummaryNumber& number) { return !is_wanted(sweep, number.name); });
    if (one.state == RunState::finished) add_table_numbers(sweep, directory / sweep.directory_of(run), found.back());
    if (!one.version.empty() &&
        std::find(results.versions.begin(), results.versions.end(), one.version) == results.versions.end())
      results.versions.push_back(one.version);
    results.runs.push_back(std::move(one));
  }
  results.numbers = columns_of(sweep, found);
  for (const std::string& name : results.numbers) results.units.push_back(unit_in(found, name));
  for (const Numbers& numbers : found) {
    results.values.emplace_back();
    for (const std::string& name : results.numbers) results.values.back().push_back(value_of(numbers, name));
  }
  const std::size_t seeds = sweep.seeds.size();
  for (std::size_t point = 0; point < sweep.points.size(); ++point) {
    std::vector<std::optional<double>> temperatures;
    for (std::size_t seed = 0; seed < seeds; ++seed) temperatures.push_back(results.runs[point * seeds + seed].temperature);
    results.temperatures.push_back(average_of(temperatures));
    results.averages.emplace_back();
    for (std::size_t k = 0; k < results.numbers.size(); ++k) {
      std::vector<std::optional<double>> values;
      for (std::size_t seed = 0; seed < seeds; ++seed) values.push_back(results.values[point * seeds + seed][k]);
      results.averages.back().push_back(average_of(values));
    }
  }
  return results;
}

bool is_numeric(const Sweep& sweep, std::size_t key) {
  return std::all_of(sweep.points.begin(), sweep.points.end(), [&](const SweepPoint& point) {
    return point.values[key].empty() || number_in<double>(point.values[key]).has_value();
  });
}

std::string plain_value(const std::string& value) {
  const bool is_plain_string = value.size() >= 2 && value.front() == '"' && value.find('\\') == std::string::npos;
  return is_plain_string ? value.substr(1, value.size() - 2) : value;
}

bool differ(double a, double b) { return std::abs(a - b) > 1e-9 * std::max(std::abs(a), std::abs(b)); }

std::string average_words(const SeedAverage& average) {
  if (!average.mean) return "–";
  const bool has_error = average.error && differ(*average.mean, *average.mean + *average.error);
  return has_error ? with_error(*average.mean, *average.error) : fmt::format("{:.6g}", *average.mean);
}

}  // namespace carom
