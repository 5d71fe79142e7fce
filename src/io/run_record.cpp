// Puts together what summary.json and trajectory.h5md say.

#include "io/run_record.hpp"

#include "io/finished_run.hpp"
#include "io/h5md_parts.hpp"
#include "io/summary.hpp"
#include "simulation/start.hpp"

#include <nlohmann/json.hpp>

namespace carom {

namespace {

using detail::Hdf5Error;

using detail::parameters;
using detail::particles;

/// Returns the columns of a table, of one length.
std::vector<Column> columns_in(hid_t file, const std::string& group) {
  const std::vector<std::string> names = detail::read_strings_attribute(file, group, "columns");
  const std::vector<std::string> units = detail::read_strings_attribute(file, group, "units");
  std::vector<Column> columns;
  for (std::size_t c = 0; c < names.size(); ++c) {
    const std::vector<hsize_t> extents = detail::extents_of(file, group + "/" + names[c]);
    if (extents.size() != 1) throw Hdf5Error(group + " has no column " + names[c]);
    Column column{names[c], c < units.size() ? units[c] : "", {}};
    if (extents[0] > 0) column.values = detail::read_rows(file, group + "/" + names[c], 0, extents[0]);
    if (!columns.empty() && column.values.size() != columns.front().values.size())
      throw Hdf5Error("the columns of " + group + " differ in length");
    columns.push_back(std::move(column));
  }
  return columns;
}

Disks disks_in(hid_t file) {
  const std::vector<hsize_t> extents = detail::extents_of(file, particles + "/mass");
  if (extents.size() != 1) throw Hdf5Error("there are no masses");
  Disks disks;
  if (extents[0] == 0) return disks;
  disks.mass = detail::read_rows(file, particles + "/mass", 0, extents[0]);
  disks.radius = detail::read_rows(file, particles + "/radius", 0, extents[0]);
  for (const double species : detail::read_rows(file, particles + "/species", 0, extents[0]))
    disks.species.push_back(static_cast<std::int32_t>(species));
  return disks;
}

/// Returns a list thinned to at most a thousand entries at equal distances.
std::vector<double> thinned(const std::vector<double>& all) {
  constexpr std::size_t most = 1000;  // a plot shows no more
  const std::size_t step = (all.size() + most - 1) / most;
  std::vector<double> some;
  for (std::size_t k = 0; k < all.size(); k += step) some.push_back(all[k]);
  return some;
}

/// Reads quantities of one number per sample.
void read_sampled(hid_t file, RunRecord::Source& source) {
  if (source.samples == 0) return;
  source.times = thinned(detail::read_rows(file, particles + "/position/time", 0, source.samples));
  for (const std::string& name : detail::members_of(file, "/observables")) {
    const std::string values = "/observables/" + name + "/value";
    const std::vector<hsize_t> extents = detail::extents_of(file, values);
    if (extents.size() == 1 && extents[0] >= source.samples)
      source.sampled.push_back({name, "", thinned(detail::read_rows(file, values, 0, source.samples))});
  }
}

RunRecord::Source source_in(const std::filesystem::path& path, std::vector<Measurement>& observables) {
  return detail::reading_hdf5(path, [&] {
    const detail::Hdf5Id opened = detail::open_trajectory(path);
    const hid_t file = opened.get();
    RunRecord::Source source;
    source.scene = detail::scene_in(file, path);
    source.disks = disks_in(file);
    source.species = detail::read_strings_attribute(file, parameters, "species_names");
    source.text = detail::read_string_attribute(file, parameters, "scene");
    source.resolved = detail::read_string_attribute(file, parameters, "resolved_scene");
    source.overrides = detail::read_strings_attribute(file, parameters, "overrides");
    for (const std::int32_t species : source.disks.species)
      if (species < 0 || static_cast<std::size_t>(species) >= source.species.size())
        throw Hdf5Error("a disk belongs to a species without a name");
    const std::vector<hsize_t> samples = detail::extents_of(file, particles + "/position/time");
    const std::vector<hsize_t> events = detail::extents_of(file, "/events/time");
    if (!samples.empty()) source.samples = samples[0];
    if (!events.empty()) source.events = events[0];
    read_sampled(file, source);
    for (Measurement& measured : observables)
      for (Table& table : measured.tables)
        table.columns = columns_in(file, "/measurements/" + measured.name + "/table_" + table.name);
    return source;
  });
}

/// Returns the data that follow from the scene alone.
RunRecord::Source source_of(const std::string& resolved, std::int64_t disks, const std::filesystem::path& path) {
  RunRecord::Source source;
  source.scene = detail::scene_of(resolved, path);
  source.resolved = resolved;
  for (const Species& species : source.scene.species) source.species.push_back(species.name);
  if (source.scene.disk_count() != disks) return source;  // not the species of the run
  source.disks = disks_of(source.scene);
  return source;
}

}  // namespace

RunRecord read_run_record(const std::filesystem::path& directory) {
  detail::require_finished_run(directory);
  const nlohmann::ordered_json summary = detail::summary_in(directory);
  RunRecord record;
  std::string resolved;
  try {
    record.report = run_report_of(summary);
    const auto& build = summary.at("carom");
    const auto text = [&](const char* key) { return build.at(key).get<std::string>(); };
    record.build = {text("version"), text("commit"), text("compiler"), text("flags")};
    record.command_line = summary.at("command_line").get<std::string>();
    resolved = summary.value("resolved_scene", "");
  } catch (const nlohmann::json::exception&) {
    throw detail::no_summary(directory);
  }
  record.has_trajectory = detail::has_trajectory(directory);
  if (record.has_trajectory)
    record.source = source_in(directory / "trajectory.h5md", record.report.observables);
  else if (!resolved.empty())
    record.source = source_of(resolved, record.report.disks, directory / "summary.json");
  return record;
}

}  // namespace carom
