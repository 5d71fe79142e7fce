#include "studies/sweep/results.hpp"

#include <boost/math/statistics/univariate_statistics.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace carom {

namespace {

/// Numbers of one run, by name.
using Numbers = std::vector<SummaryNumber>;

bool is_wanted(const Sweep& sweep, const std::string& name) {
  return sweep.table.empty() ? is_usual_number(name)
                             : std::find(sweep.table.begin(), sweep.table.end(), name) != sweep.table.end();
}

/// Returns the usual numbers that any run has, in the order in which they first appear; those asked for, in the order asked for.
std::vector<std::string> columns_of(const Sweep& sweep, const std::vector<Numbers>& found) {
  if (!sweep.table.empty()) return sweep.table;
  std::vector<std::string> columns;
  for (const Numbers& numbers : found)
    for (const SummaryNumber& number : numbers)
      if (number.value && std::find(columns.begin(), columns.end(), number.name) == columns.end()) columns.push_back(number.name);
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
    results.averages.emplace_back();
    for (std::size_t k = 0; k < results.numbers.size(); ++k) {
      std::vector<std::optional<double>> values;
      for (std::size_t seed = 0; seed < seeds; ++seed) values.push_back(results.values[point * seeds + seed][k]);
      results.averages.back().push_back(average_of(values));
    }
  }
  return results;
}

}  // namespace carom
