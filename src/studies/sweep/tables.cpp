// Numbers have the fewest digits that read back as the same double; what is absent is an empty cell.

#include "studies/sweep/tables.hpp"

#include "studies/sweep/values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

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

}  // namespace carom
