#include "io/h5md_parts.hpp"

#include "core/instructions.hpp"
#include "io/observable_output.hpp"

#include <carom/simulation.hpp>
#include <carom/version.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace carom::detail {

void write_build(hid_t group) {
  write_attribute(group, "version", build_info().version);
  write_attribute(group, "commit", build_info().commit);
  write_attribute(group, "compiler", build_info().compiler);
  write_attribute(group, "flags", build_info().flags);
}

void write_h5md_header(hid_t file) {
  const Hdf5Id h5md = create_group(file, "h5md");
  write_attribute(h5md.get(), "version", std::array<std::int64_t, 2>{1, 1});
  const Hdf5Id author = create_group(h5md.get(), "author");
  write_attribute(author.get(), "name", std::string("unknown"));
  const Hdf5Id creator = create_group(h5md.get(), "creator");
  write_attribute(creator.get(), "name", std::string("carom"));
  write_attribute(creator.get(), "version", build_info().version);
}

void write_parameters(hid_t file, const Scene& scene, const Provenance& provenance) {
  const Hdf5Id handle = create_group(file, "parameters");
  const hid_t group = handle.get();
  write_attribute(group, "title", scene.title);
  write_attribute(group, "scene", scene.text);
  write_attribute(group, "scene_source", scene.source);
  if (!scene.overrides.empty()) write_attribute(group, "overrides", scene.overrides);
  write_attribute(group, "resolved_scene", provenance.resolved_scene);
  write_attribute(group, "seed", scene.run.seed);
  write_attribute(group, "engine", provenance.engine);
  if (provenance.time_step) write_attribute(group, "dt", *provenance.time_step);
  if (provenance.stiffness) write_attribute(group, "stiffness", *provenance.stiffness);
  write_attribute(group, "command_line", provenance.command_line);
  write_build(group);
  write_attribute(group, "instructions", std::string(name_of(chosen_instructions())));

  write_attribute(group, "effects", names_of(scene.effects, !scene.box.periodic(0) || !scene.box.periodic(1)));

  std::vector<std::string> species;
  for (const Species& one : scene.species) species.push_back(one.name);
  if (!species.empty()) write_attribute(group, "species_names", species);
  if (scene.run.sample_every) write_attribute(group, "sample_every", *scene.run.sample_every);
  if (scene.run.sample_every_collisions)
    write_attribute(group, "sample_every_collisions", static_cast<std::int64_t>(*scene.run.sample_every_collisions));
  if (const auto& log = scene.run.sample_log)
    write_attribute(group, "sample_log", std::array{log->base, static_cast<double>(log->per_block), log->block});
  write_attribute(group, "spatial_dimension", std::int64_t{2});
  write_attribute(group, "positions", std::string(scene.output.unwrapped ? "unwrapped" : "wrapped"));
  write_attribute(group, "units",
                  std::string("reduced: lengths, masses and times are in the units of the scene, with kB = 1. The unit "
                              "attributes (Angstrom, ps) are there because readers ask for some; no value was converted."));
}

void write_reference_temperature(hid_t file, double temperature) {
  write_attribute(create_group(file, "parameters").get(), "reference_temperature", temperature);
}

namespace {

/// Absent numbers are NaN: an attribute that is always there needs no asking.
double number_or_nan(const std::optional<double>& value) { return value.value_or(std::numeric_limits<double>::quiet_NaN()); }

void write(hid_t parent, const Scalar& scalar) {
  const Hdf5Id group = create_group(parent, scalar.name);
  write_attribute(group.get(), "value", number_or_nan(scalar.value));
  write_attribute(group.get(), "error", number_or_nan(scalar.error));
  write_attribute(group.get(), "integrated_correlation_time", number_or_nan(scalar.integrated_correlation_time));
  write_attribute(group.get(), "average", average_word(scalar.average));
  if (!scalar.unit.empty()) write_attribute(group.get(), "unit", scalar.unit);
  if (!scalar.note.empty()) write_attribute(group.get(), "note", scalar.note);
}

void write(hid_t parent, const Table& table) {
  const Hdf5Id group = create_group(parent, "table_" + table.name);
  write_attribute(group.get(), "average", average_word(table.average));
  std::vector<std::string> names, units;
  for (const Column& column : table.columns) {
    write_column(group.get(), column.name, std::span<const double>(column.values));
    names.push_back(column.name);
    units.push_back(column.unit);
  }
  if (!names.empty()) write_attribute(group.get(), "columns", names);
  if (!units.empty()) write_attribute(group.get(), "units", units);
}

}  // namespace

void write_measurements(hid_t file, const std::vector<Measurement>& observables) {
  if (observables.empty()) return;
  const Hdf5Id root = create_group(file, "measurements");
  for (const Measurement& measured : observables) {
    const Hdf5Id group = create_group(root.get(), measured.name);
    if (!measured.note.empty()) write_attribute(group.get(), "note", measured.note);
    for (const Scalar& scalar : measured.scalars) write(group.get(), scalar);
    for (const Table& table : measured.tables) write(group.get(), table);
  }
}

namespace {

std::uint64_t expected_frames(const Run& run) {
  const bool known = run.sample_every_collisions ? run.collisions.has_value() : run.time && run.is_sampled();
  return known ? last_sample(run) + 1 : std::numeric_limits<std::uint64_t>::max();
}

}  // namespace

DatasetLayout frame_layout(const Scene& scene, std::size_t bytes_per_number, std::vector<hsize_t> row) {
  const std::size_t numbers = std::accumulate(row.begin(), row.end(), std::size_t{1}, std::multiplies<>());
  return {.row = std::move(row), .rows_per_chunk = rows_per_chunk(numbers * bytes_per_number, expected_frames(scene.run))};
}

void link_steps_and_times(hid_t file, const std::string& group) {
  link_hard(file, "particles/trajectory/position/step", group + "/step");
  link_hard(file, "particles/trajectory/position/time", group + "/time");
}

}  // namespace carom::detail
