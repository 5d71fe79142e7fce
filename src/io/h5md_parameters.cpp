// The facts about the program that wrote the file, and about the run.

#include "io/h5md_parameters.hpp"

#include "core/instructions.hpp"

#include <carom/version.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace carom::detail {

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
  write_attribute(group, "command_line", provenance.command_line);
  write_attribute(group, "version", build_info().version);
  write_attribute(group, "commit", build_info().commit);
  write_attribute(group, "compiler", build_info().compiler);
  write_attribute(group, "flags", build_info().flags);
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

}  // namespace carom::detail
