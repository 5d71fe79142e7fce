// Numbers have the fewest digits that read back as the same double; an absent one is an empty cell. The HDF5 file is made in
// memory, where no disk can be full, and does not depend on the day or the machine. A data set with a unit has it as its
// attribute `unit`, as in H5MD.

#include "studies/sweep/products.hpp"

#include "io/h5md_parts.hpp"
#include "io/hdf5_handle.hpp"
#include "io/json.hpp"
#include "studies/sweep/results.hpp"
#include "text/number_in.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace carom {

namespace {

using Row = std::vector<std::string>;

/// Returns the text in quotes where it contains a comma, a quote or the end of a line (RFC 4180).
std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csv_cell(const std::optional<double>& number) { return number ? fmt::format("{}", *number) : ""; }

void put_line(std::string& text, const Row& row) { text += fmt::format("{}\n", fmt::join(row, ",")); }

Row beginning(const Sweep& sweep, const SweepPoint& point) {
  Row row = {csv_cell(point.name)};
  for (std::size_t k = 0; k < sweep.keys.size(); ++k) row.push_back(csv_cell(plain_value(point.values[k])));
  return row;
}

Row beginning_of_header(const Sweep& sweep) {
  Row row = {"point"};
  for (const std::string& key : sweep.keys) row.push_back(csv_cell(key));
  return row;
}

}  // namespace

std::string runs_csv(const Sweep& sweep, const SweepResults& results) {
  std::string text;
  Row header = beginning_of_header(sweep);
  header.insert(header.end(), {"seed", "directory", "state", "stopped"});
  for (const std::string& name : results.numbers) header.push_back(csv_cell(name));
  header.emplace_back("failure");
  put_line(text, header);
  for (std::size_t run = 0; run < sweep.run_count(); ++run) {
    const FoundRun& found = results.runs[run];
    Row row = beginning(sweep, sweep.point_of(run));
    row.push_back(fmt::format("{}", sweep.seed_of(run)));
    row.push_back(csv_cell(sweep.directory_of(run).string()));
    row.emplace_back(to_string(found.state));
    row.push_back(found.stopped);
    for (const std::optional<double>& value : results.values[run]) row.push_back(csv_cell(value));
    row.push_back(csv_cell(found.failure));
    put_line(text, row);
  }
  return text;
}

std::string points_csv(const Sweep& sweep, const SweepResults& results) {
  std::string text;
  Row header = beginning_of_header(sweep);
  header.insert(header.end(), {"finished", "failed"});
  for (const std::string& name : results.numbers) {
    header.push_back(csv_cell(name + "_mean"));
    header.push_back(csv_cell(name + "_error"));
  }
  put_line(text, header);
  for (std::size_t point = 0; point < sweep.points.size(); ++point) {
    Row row = beginning(sweep, sweep.points[point]);
    row.push_back(fmt::format("{}", results.count(sweep, point, RunState::finished)));
    row.push_back(fmt::format("{}", results.count(sweep, point, RunState::failed)));
    for (const SeedAverage& average : results.averages[point]) {
      row.push_back(csv_cell(average.mean));
      row.push_back(csv_cell(average.error));
    }
    put_line(text, row);
  }
  return text;
}

std::string columns_csv(const Sweep& sweep, const SweepResults& results) {
  std::string text;
  put_line(text, {"file", "column", "unit", "meaning"});
  const auto put = [&](const char* file, const std::string& column, const std::string& unit, const std::string& meaning) {
    put_line(text, {file, csv_cell(column), csv_cell(unit), csv_cell(meaning)});
  };
  const auto put_beginning = [&](const char* file) {
    put(file, "point", "", "name of the point");
    for (const std::string& key : sweep.keys) put(file, key, unit_of_key(key), "key of the scene that is swept");
  };
  put_beginning("sweep.csv");
  put("sweep.csv", "finished", "", "number of runs of the point that have finished");
  put("sweep.csv", "failed", "", "number of runs of the point that have failed");
  for (std::size_t k = 0; k < results.numbers.size(); ++k) {
    const std::string& name = results.numbers[k];
    put("sweep.csv", name + "_mean", results.units[k], fmt::format("mean of {} over the seeds", name));
    put("sweep.csv", name + "_error", results.units[k], "standard error of that mean by the scatter of the seeds");
  }
  put_beginning("runs.csv");
  put("runs.csv", "seed", "", "seed of the random numbers");
  put("runs.csv", "directory", "", "directory of the run");
  put("runs.csv", "state", "", "whether the run is finished or failed or missing");
  put("runs.csv", "stopped", "", "why the run ended");
  for (std::size_t k = 0; k < results.numbers.size(); ++k)
    put("runs.csv", results.numbers[k], results.units[k],
        table_number(results.numbers[k]) ? "number of a table of the run" : "number of summary.json");
  put("runs.csv", "failure", "", "what is wrong with a run that has failed");
  return text;
}

std::string sweep_json(const Sweep& sweep, const SweepResults& results) {
  using detail::Json;
  Json points = Json::array();
  for (std::size_t point = 0; point < sweep.points.size(); ++point) {
    Json values = Json::object(), numbers = Json::object();
    for (std::size_t k = 0; k < sweep.keys.size(); ++k) {
      const std::string& value = sweep.points[point].values[k];
      const std::optional<double> is_number = number_in<double>(value);
      values[sweep.keys[k]] = value.empty() ? Json(nullptr) : is_number ? Json(*is_number) : Json(plain_value(value));
    }
    for (std::size_t k = 0; k < results.numbers.size(); ++k) {
      const SeedAverage& average = results.averages[point][k];
      if (average.mean)
        numbers[results.numbers[k]] = {{"mean", *average.mean},
                                       {"error", average.error ? Json(*average.error) : Json(nullptr)},
                                       {"unit", results.units[k]},
                                       {"count", average.count}};
    }
    points.push_back({{"point", sweep.points[point].name},
                      {"values", values},
                      {"finished", results.count(sweep, point, RunState::finished)},
                      {"failed", results.count(sweep, point, RunState::failed)},
                      {"numbers", numbers}});
  }
  const Json json = {{"sweep", sweep.source}, {"seeds", sweep.seeds}, {"points", points}};
  return json.dump(2);
}

namespace {

using detail::checked;
using detail::create_group;
using detail::Hdf5Id;
using detail::write_attribute;
using detail::write_column;

/// Returns NaN for an absent number.
double number(const std::optional<double>& value) { return value.value_or(std::numeric_limits<double>::quiet_NaN()); }

/// Writes a column with its unit, which a pure number has none of.
void write_numbers(hid_t group, const std::string& name, const std::string& unit, const std::vector<double>& values) {
  write_column(group, name, values);
  if (unit.empty()) return;
  const Hdf5Id column(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose);
  write_attribute(column.get(), "unit", unit);
}

/// The number of its point for every run; for points their own number.
using Points = std::vector<std::size_t>;

/// A swept key is a column of numbers where all of its values are numbers, else of texts.
void write_parameters(hid_t table, const Sweep& sweep, const Points& points) {
  const Hdf5Id group = create_group(table, "parameters");
  for (std::size_t k = 0; k < sweep.keys.size(); ++k) {
    if (is_numeric(sweep, k)) {
      std::vector<double> values;
      for (const std::size_t point : points) values.push_back(number(number_in<double>(sweep.points[point].values[k])));
      write_numbers(group.get(), sweep.keys[k], unit_of_key(sweep.keys[k]), values);
    } else {
      std::vector<std::string> values;
      for (const std::size_t point : points) values.push_back(plain_value(sweep.points[point].values[k]));
      write_column(group.get(), sweep.keys[k], values);
    }
  }
}

void write_points(hid_t file, const Sweep& sweep, const SweepResults& results) {
  const Hdf5Id table = create_group(file, "points");
  Points points;
  std::vector<std::string> names;
  std::vector<std::int64_t> finished, failed;
  for (std::size_t point = 0; point < sweep.points.size(); ++point) {
    points.push_back(point);
    names.push_back(sweep.points[point].name);
    finished.push_back(static_cast<std::int64_t>(results.count(sweep, point, RunState::finished)));
    failed.push_back(static_cast<std::int64_t>(results.count(sweep, point, RunState::failed)));
  }
  write_column(table.get(), "name", names);
  write_column(table.get(), "finished", finished);
  write_column(table.get(), "failed", failed);
  write_parameters(table.get(), sweep, points);
  const Hdf5Id mean = create_group(table.get(), "mean");
  const Hdf5Id error = create_group(table.get(), "error");
  for (std::size_t k = 0; k < results.numbers.size(); ++k) {
    std::vector<double> means, errors;
    for (const std::vector<SeedAverage>& averages : results.averages) {
      means.push_back(number(averages[k].mean));
      errors.push_back(number(averages[k].error));
    }
    write_numbers(mean.get(), results.numbers[k], results.units[k], means);
    write_numbers(error.get(), results.numbers[k], results.units[k], errors);
  }
}

void write_runs(hid_t file, const Sweep& sweep, const SweepResults& results) {
  const Hdf5Id table = create_group(file, "runs");
  Points points;
  std::vector<std::int64_t> numbers, seeds;
  std::vector<std::string> directories, states, stopped, failures;
  for (std::size_t run = 0; run < sweep.run_count(); ++run) {
    points.push_back(run / sweep.seeds.size());
    numbers.push_back(static_cast<std::int64_t>(points.back()));
    seeds.push_back(static_cast<std::int64_t>(sweep.seed_of(run)));
    directories.push_back(sweep.directory_of(run).string());
    states.emplace_back(to_string(results.runs[run].state));
    stopped.push_back(results.runs[run].stopped);
    failures.push_back(results.runs[run].failure);
  }
  write_column(table.get(), "point", numbers);
  write_column(table.get(), "seed", seeds);
  write_column(table.get(), "directory", directories);
  write_column(table.get(), "state", states);
  write_column(table.get(), "stopped", stopped);
  write_column(table.get(), "failure", failures);
  write_parameters(table.get(), sweep, points);
  const Hdf5Id group = create_group(table.get(), "numbers");
  for (std::size_t k = 0; k < results.numbers.size(); ++k) {
    std::vector<double> values;
    for (const std::vector<std::optional<double>>& run : results.values) values.push_back(number(run[k]));
    write_numbers(group.get(), results.numbers[k], results.units[k], values);
  }
}

void write_provenance(hid_t file, const Sweep& sweep, const SweepResults& results) {
  write_attribute(file, "creator", std::string("carom"));
  detail::write_build(file);
  if (!results.versions.empty()) write_attribute(file, "runs_by", results.versions);
  write_attribute(file, "sweep", sweep.text);
  write_attribute(file, "sweep_source", sweep.source);
  write_attribute(file, "scene", sweep.scene_text);
  write_attribute(file, "scene_source", sweep.scene_path);
}

}  // namespace

std::string sweep_hdf5(const Sweep& sweep, const SweepResults& results) {
  const detail::SilentHdf5 silent;
  constexpr std::size_t increment = std::size_t{1} << 20;
  const Hdf5Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  checked(H5Pset_fapl_core(access.get(), increment, false));
  const Hdf5Id file(H5Fcreate("sweep.h5", H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), H5Fclose);
  write_provenance(file.get(), sweep, results);
  write_points(file.get(), sweep, results);
  write_runs(file.get(), sweep, results);
  checked(H5Fflush(file.get(), H5F_SCOPE_GLOBAL));
  std::string bytes(static_cast<std::size_t>(checked(H5Fget_file_image(file.get(), nullptr, 0))), '\0');
  checked(H5Fget_file_image(file.get(), bytes.data(), bytes.size()));
  return bytes;
}

}  // namespace carom
