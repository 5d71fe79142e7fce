#include "app/info_parts.hpp"

#include "io/hdf5_handle.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <fstream>
#include <numeric>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace carom::detail {

namespace fs = std::filesystem;

namespace {

hsize_t rows_of(hid_t file, const std::string& column) {
  const std::vector<hsize_t> extents = extents_of(file, column);
  if (extents.size() != 1) throw Hdf5Error(fmt::format("there is no column {}", column));
  return extents[0];
}

}  // namespace

bool is_sweep(hid_t file) {
  return read_string_attribute(file, "/", "creator") == "carom" && !members_of(file, "/points").empty();
}

std::string sweep_lines(hid_t file) {
  std::string text = info_line("written by", fmt::format("carom {} ({})", read_string_attribute(file, "/", "version"),
                                                         read_string_attribute(file, "/", "commit")));
  text += info_line("sweep", read_string_attribute(file, "/", "sweep_source"));
  text += info_line("scene", read_string_attribute(file, "/", "scene_source"));
  const hsize_t points = rows_of(file, "/points/name"), runs = rows_of(file, "/runs/state");
  const std::vector<std::string> keys = members_of(file, "/points/parameters");
  text += info_line("points", keys.empty() ? fmt::format("{}", points) : fmt::format("{}, of {}", points, fmt::join(keys, ", ")));
  const auto in_all = [&](const char* column) {
    const std::vector<double> counts = read_rows(file, column, 0, points);
    return std::accumulate(counts.begin(), counts.end(), 0.0);
  };
  const double finished = in_all("/points/finished"), failed = in_all("/points/failed");
  std::string of_runs = fmt::format("{}, {} finished", runs, finished);
  if (failed > 0.0) of_runs += fmt::format(", {} failed", failed);
  text += info_line("runs", of_runs);
  text += info_line("numbers", fmt::format("{}", fmt::join(members_of(file, "/points/mean"), ", ")));
  if (finished + failed < static_cast<double>(runs)) text += info_line("state", "incomplete: the same command continues it");
  return text;
}

bool is_sweep_table(std::string_view heading) { return heading.starts_with("point,"); }

std::string describe_sweep_table(const fs::path& path) {
  std::ifstream file(path);
  std::string heading, line;
  std::getline(file, heading);
  std::uint64_t rows = 0;
  while (std::getline(file, line)) ++rows;
  const bool of_runs = heading.find(",directory,state,") != std::string::npos;
  std::string text = fmt::format("{}: table of a sweep, a row per {}\n", path.string(), of_runs ? "run" : "point");
  text += info_line("columns", heading);
  return text + info_line("rows", fmt::format("{}", rows));
}

bool is_columns_of_sweep(std::string_view heading) { return heading == "file,column,unit,meaning"; }

std::string describe_columns_of_sweep(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  std::uint64_t rows = 0;
  while (std::getline(file, line)) ++rows;
  return fmt::format("{}: units and meanings of the columns of sweep.csv and runs.csv\n", path.string()) +
         info_line("columns", fmt::format("{}", rows));
}

std::string describe_runs_of_sweep(const fs::path& path) {
  std::uintmax_t begun = 0, finished = 0;
  std::error_code error;
  for (fs::directory_iterator point(path, error), end; !error && point != end; point.increment(error)) {
    std::error_code below;
    if (!point->is_directory(below)) continue;
    for (fs::directory_iterator run(point->path(), below); !below && run != end; run.increment(below)) {
      if (!run->path().filename().string().starts_with("seed=")) continue;
      ++begun;
      std::error_code absent;
      if (fs::exists(run->path() / "summary.json", absent)) ++finished;
    }
  }
  if (begun == 0) return {};
  std::string text = fmt::format("{}: runs of a sweep, without its tables\n", path.string());
  text += info_line("runs", fmt::format("{} begun, {} with results", begun, finished));
  return text + info_line("state", "incomplete: the sweep has not ended, or was killed; the same command continues it");
}

}  // namespace carom::detail
