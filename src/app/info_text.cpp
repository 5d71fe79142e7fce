// Descriptions of trajectory.xyz, samples.csv and other tables. They are read line by line, so their size does not matter.

#include "app/info_parts.hpp"
#include "io/observable_output.hpp"
#include "io/output_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <optional>

namespace carom::detail {

namespace {

/// Returns the number that `text` begins with.
template <class Number>
std::optional<Number> leading_number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end == text.data()) return std::nullopt;
  return value;
}

/// Returns the text after `key` in `line`, up to the next space or quote.
std::string_view value_of(std::string_view line, std::string_view key) {
  const std::size_t found = line.find(key);
  if (found == std::string_view::npos) return {};
  std::string_view rest = line.substr(found + key.size());
  const bool quoted = rest.starts_with('"');
  if (quoted) rest.remove_prefix(1);
  return rest.substr(0, rest.find(quoted ? '"' : ' '));
}

/// Counts whole samples: those of which every line is there.
struct Tally {
  std::uint64_t samples = 0;
  double first = 0.0;
  double last = 0.0;

  void add(double time) {
    if (samples++ == 0) first = time;
    last = time;
  }
};

std::string state_of(bool torn) { return torn ? info_line("note", "the last sample is cut short") : std::string(); }

}  // namespace

std::string describe_xyz(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  std::string first_comment;
  Tally tally;
  std::uint64_t disks = 0;
  bool torn = false;
  while (!torn && std::getline(file, line)) {
    const auto count = leading_number<std::uint64_t>(line);
    if (file.eof()) {  // every line that Carom writes ends with a newline
      torn = true;
      break;
    }
    std::string comment;
    const bool has_comment = static_cast<bool>(std::getline(file, comment));
    const auto time = leading_number<double>(value_of(comment, " Time="));
    if (!count || (has_comment && !file.eof() && !time)) {
      throw OutputError(
          fmt::format("{}: sample {} is not extended XYZ as Carom writes it (a number of disks, then a line with "
                      "Lattice, Properties and Time); it may be another program's",
                      path.string(), tally.samples));
    }
    for (std::uint64_t i = 0; i < *count && !torn; ++i) torn = !std::getline(file, line) || file.eof();
    if (torn || !time) {
      torn = true;
      break;
    }
    if (tally.samples == 0) first_comment = comment;
    disks = *count;
    tally.add(*time);
  }
  if (tally.samples == 0)
    throw OutputError(fmt::format(
        "{}: this file does not hold one whole sample of extended XYZ; its run may have been killed early", path.string()));
  std::string text = fmt::format("{}: trajectory, extended XYZ\n", path.string());
  text += info_line("disks", fmt::format("{}", disks));
  text +=
      info_line("lattice", fmt::format("{} from ({})", value_of(first_comment, "Lattice="), value_of(first_comment, "Origin=")));
  text += info_line("periodic", value_of(first_comment, "pbc="));
  text += info_line("samples", samples_text(tally.samples, tally.first, tally.last));
  return text + state_of(torn);
}

namespace {

/// Describes the table of an observable: a comment about averages and units, a heading, rows.
std::string describe_observable_table(const std::filesystem::path& path, const std::string& comment, std::ifstream& file) {
  std::string heading, line;
  std::getline(file, heading);
  std::uint64_t rows = 0;
  while (std::getline(file, line)) ++rows;
  std::string text = fmt::format("{}: table of an observable\n", path.string());
  text += info_line("columns", heading);
  text += info_line("rows", fmt::format("{}", rows));
  return text + info_line("about", comment.substr(2));
}

}  // namespace

std::string describe_csv(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  if (average_in_comment(line)) return describe_observable_table(path, line, file);
  if (is_sweep_table(line)) return describe_sweep_table(path);
  if (is_columns_of_sweep(line)) return describe_columns_of_sweep(path);
  const std::string heading = line;
  const bool rough = heading == "time,id,x,y,vx,vy,spin";
  if (heading != "time,id,x,y,vx,vy" && !rough)
    throw OutputError(
        fmt::format("{}: this table is not one of samples; Carom's begin with the line time,id,x,y,vx,vy", path.string()));

  Tally tally;
  std::uint64_t disks = 0;
  std::uint64_t rows = 0;  // of the sample being read
  double current = 0.0;    // its time
  bool torn = false;
  std::uint64_t number = 1;
  const auto end_sample = [&] {
    if (rows == 0) return;
    if (tally.samples == 0) disks = rows;
    torn = torn || rows != disks;
    if (!torn) tally.add(current);
    rows = 0;
  };
  while (std::getline(file, line)) {
    ++number;
    if (file.eof()) {
      torn = true;
      break;
    }
    const std::size_t comma = line.find(',');
    const auto time = leading_number<double>(std::string_view(line).substr(0, comma));
    const auto id =
        comma == std::string::npos ? std::nullopt : leading_number<std::uint64_t>(std::string_view(line).substr(comma + 1));
    if (!time || !id || std::count(line.begin(), line.end(), ',') != (rough ? 6 : 5))
      throw OutputError(
          fmt::format("{}:{}: this line has not {} numbers, as every line of these samples has; the file is damaged",
                      path.string(), number, rough ? "seven" : "six"));
    if (*id == 0) end_sample();
    current = *time;
    ++rows;
  }
  end_sample();
  std::string text = fmt::format("{}: table of samples, {}\n", path.string(), heading);
  text += info_line("disks", fmt::format("{}", disks));
  text += info_line("samples", samples_text(tally.samples, tally.first, tally.last));
  return text + state_of(torn);
}

}  // namespace carom::detail
