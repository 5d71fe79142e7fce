#include "studies/sweep/seed_tables.hpp"

#include "io/observable_output.hpp"
#include "observe/table_column.hpp"
#include "studies/sweep/numbers.hpp"
#include "text/number_in.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace carom {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view error_ending = "_error";

bool is_error_column(const Table& table, const Column& column) {
  return column.name.ends_with(error_ending) &&
         find_column(table, column.name.substr(0, column.name.size() - error_ending.size())) != nullptr;
}

/// Returns why tables of which this is the first column have no mean. Observables take their own lengths from the mean diameter.
std::string why_rows_differ(const Column& column, bool radii_are_drawn) {
  if (radii_are_drawn && (column.unit == "length" || column.unit == "1 / length"))
    return fmt::format(
        "its {} differs from seed to seed, because it follows the radii, and these are drawn; give the radii as a "
        "list, radius = [...], that is the same for all",
        column.name);
  return fmt::format("its {} differs from seed to seed; give the observable a step, every = ..., that is the same for all",
                     column.name);
}

bool same_number(double a, double b) {
  return std::isnan(a) || std::isnan(b) ? std::isnan(a) && std::isnan(b) : a == b || !differ(a, b);
}

/// Returns the middle of the cell that contains a place, of cells of one width whose middles are given; nothing beyond them. One
/// cell alone is as wide as the box.
std::optional<double> middle_of_cell(const std::vector<double>& middles, double place) {
  constexpr double rounding = 1e-9;  // of a width: edges are no short numbers in binary
  const std::set<double> distinct(middles.begin(), middles.end());
  const auto count = static_cast<double>(distinct.size());
  if (distinct.size() < 2) return distinct.empty() ? std::nullopt : std::optional(*distinct.begin());
  const double width = (*distinct.rbegin() - *distinct.begin()) / (count - 1.0);
  const double cells = (place - *distinct.begin()) / width + 0.5 + rounding;
  if (cells < 0.0 || cells > count + 2.0 * rounding) return {};
  return *std::next(distinct.begin(), static_cast<std::ptrdiff_t>(std::min(cells, count - 1.0)));
}

/// Returns the row of the cell that contains a place.
std::optional<std::size_t> row_of_cell(const Table& cells, const std::vector<double>& place) {
  std::vector<double> middle;
  for (std::size_t c = 0; c < place.size(); ++c) {
    const std::optional<double> found = middle_of_cell(cells.columns[c].values, place[c]);
    if (!found) return {};
    middle.push_back(*found);
  }
  for (std::size_t r = 0; r < cells.columns.front().values.size(); ++r) {
    bool is_there = true;
    for (std::size_t c = 0; c < middle.size(); ++c) is_there = is_there && cells.columns[c].values[r] == middle[c];
    if (is_there) return r;
  }
  return {};
}

}  // namespace

Table read_observed_table(const fs::path& path) {
  std::ifstream file(path);
  const auto fault = [&] { return std::runtime_error(path.string() + " is no table of an observable"); };
  std::string units, names;
  if (!std::getline(file, units) || !std::getline(file, names)) throw fault();
  constexpr std::string_view before_units = "units: ";
  const std::size_t begin = units.find(before_units);
  const std::optional<Average> average = average_in_comment(units);
  if (!average || begin == std::string::npos) throw fault();
  Table table{.name = path.stem().string().substr(std::string_view("observe_").size()), .average = *average};
  const std::vector<std::string> unit_words = split_at_commas(units.substr(begin + before_units.size()));
  for (const std::string& name : split_at_commas(names)) {
    const std::size_t k = table.columns.size();
    if (k >= unit_words.size()) throw fault();
    const std::string& word = unit_words[k];
    const std::string unit = word.starts_with(" ") ? word.substr(1) : word;
    table.columns.push_back({name, unit == "1" ? "" : unit, {}});
  }
  for (std::string line; std::getline(file, line);) {
    const std::vector<std::string> cells = split_at_commas(line);
    if (cells.size() != table.columns.size()) throw fault();
    for (std::size_t c = 0; c < cells.size(); ++c)
      table.columns[c].values.push_back(number_in<double>(cells[c]).value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  return table;
}

bool is_curve(const Table& table) {
  const std::vector<double>& x = table.columns.front().values;
  return !x.empty() && std::adjacent_find(x.begin(), x.end(), std::greater_equal<>()) == x.end();
}

const Column* last_in_rows(const Table& table) { return find_column(table, table.columns.front().name + "_to"); }

std::vector<std::string> key_columns(const Table& table) {
  std::vector<std::string> names = {table.columns.front().name};
  if (is_curve(table)) return names;
  for (const Column& column : std::span(table.columns).subspan(1)) {
    if (column.name != "x" && column.name != "y") break;
    names.push_back(column.name);
  }
  return names;
}

namespace {

std::optional<double> value_on_curve(const std::vector<double>& x, const std::vector<double>& y, double at) {
  // A step that is no short number in binary may put the row that was meant a rounding beside it.
  const auto is_near = [&](double other) { return !differ(other, at); };
  const auto found = std::find_if(x.begin(), x.end(), [&](double other) { return other >= at || is_near(other); });
  if (found == x.end() || (found == x.begin() && !is_near(*found))) return {};
  const auto k = static_cast<std::size_t>(found - x.begin());
  if (is_near(x[k])) return y[k];
  const double share = (at - x[k - 1]) / (x[k] - x[k - 1]);
  return (1.0 - share) * y[k - 1] + share * y[k];
}

/// Returns the value of the row that goes from a number to another, both included, and contains `at`.
std::optional<double> value_of_range(const std::vector<double>& from, const std::vector<double>& to, const std::vector<double>& y,
                                     double at) {
  for (std::size_t k = 0; k < from.size(); ++k)
    if (at >= from[k] && at <= to[k]) return y[k];
  return {};
}

}  // namespace

std::optional<double> value_at(const Table& table, const std::string& column, const std::vector<double>& at) {
  const Column* const values = find_column(table, column);
  if (values == nullptr || at.empty() || at.size() >= table.columns.size()) return {};
  std::optional<double> value;
  if (at.size() > 1) {
    if (const std::optional<std::size_t> row = row_of_cell(table, at)) value = values->values[*row];
  } else if (const Column* const to = last_in_rows(table); to != nullptr) {
    value = value_of_range(table.columns.front().values, to->values, values->values, at.front());
  } else if (is_curve(table)) {
    value = value_on_curve(table.columns.front().values, values->values, at.front());
  }
  return value && std::isfinite(*value) ? value : std::nullopt;
}

Table mean_of_tables(const std::vector<Table>& tables, bool radii_are_drawn) {
  const Table& first = tables.front();
  Table mean{.name = first.name, .average = first.average};
  std::size_t rows = first.columns.front().values.size();
  for (const Table& table : tables) {
    const auto same_name = [](const Column& a, const Column& b) { return a.name == b.name; };
    if (!std::equal(first.columns.begin(), first.columns.end(), table.columns.begin(), table.columns.end(), same_name))
      throw std::runtime_error(
          "its columns differ from seed to seed; give the observable a step, every = ..., that is the same for all");
    rows = std::min(rows, table.columns.front().values.size());
  }
  for (std::size_t c = 0; c < first.columns.size(); ++c) {
    const Column& column = first.columns[c];
    if (is_error_column(first, column)) continue;
    bool equal = true;
    for (const Table& table : tables)
      for (std::size_t r = 0; r < rows; ++r) equal = equal && same_number(table.columns[c].values[r], column.values[r]);
    if (c == 0 && !equal) throw std::runtime_error(why_rows_differ(column, radii_are_drawn));
    const bool is_key = c == 0 || (equal && find_column(first, column.name + std::string(error_ending)) == nullptr);
    Column values{column.name, column.unit, {}}, errors{column.name + std::string(error_ending), column.unit, {}};
    for (std::size_t r = 0; r < rows; ++r) {
      std::vector<std::optional<double>> found;
      for (const Table& table : tables)
        if (std::isfinite(table.columns[c].values[r])) found.emplace_back(table.columns[c].values[r]);
      const SeedAverage average = average_of(found);
      const double none = std::numeric_limits<double>::quiet_NaN();
      values.values.push_back(is_key ? column.values[r] : average.mean.value_or(none));
      errors.values.push_back(average.error.value_or(none));
    }
    mean.columns.push_back(std::move(values));
    if (!is_key) mean.columns.push_back(std::move(errors));
  }
  return mean;
}

std::vector<SeedTable> seed_tables_of(const Sweep& sweep, const SweepResults& results, const fs::path& directory) {
  std::vector<SeedTable> found;
  for (std::size_t point = 0; point < sweep.points.size(); ++point) {
    std::vector<fs::path> finished;
    for (std::size_t seed = 0; seed < sweep.seeds.size(); ++seed)
      if (const std::size_t run = point * sweep.seeds.size() + seed; results.runs[run].state == RunState::finished)
        finished.push_back(directory / sweep.directory_of(run));
    if (finished.size() < 2) continue;
    const Scene scene = sweep.scene_of(point * sweep.seeds.size());
    const bool radii_are_drawn = std::ranges::any_of(scene.species, &Species::radii_are_drawn);
    std::set<std::string> names;  // in the order of the alphabet
    for (const auto& entry : fs::directory_iterator(finished.front())) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with("observe_") && name.ends_with(".csv")) names.insert(name);
    }
    for (const std::string& name : names) {
      SeedTable one{.point = point};
      try {
        std::vector<Table> tables;
        for (const fs::path& run : finished)
          if (fs::is_regular_file(run / name)) tables.push_back(read_observed_table(run / name));
        if (tables.size() < 2) continue;
        one.table.name = tables.front().name;
        one.seeds = tables.size();
        one.table = mean_of_tables(tables, radii_are_drawn);
      } catch (const std::runtime_error& error) {
        one.fault = error.what();
      }
      found.push_back(std::move(one));
    }
  }
  return found;
}

std::string seed_table_csv(const SeedTable& mean) {
  std::string text;
  append_table(text, fmt::format("# means over {} seeds; errors are those of independent seeds; units:", mean.seeds), mean.table,
               [] {});
  return text;
}

}  // namespace carom
