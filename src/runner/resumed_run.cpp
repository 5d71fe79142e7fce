#include "runner/resumed_run.hpp"

#include "io/run_writer.hpp"

#include <fmt/format.h>

#include <cmath>
#include <istream>
#include <stdexcept>
#include <system_error>

namespace carom {

namespace {

/// Returns the scene of the run, to the bit, with the end that is asked for.
Scene scene_of(const CheckpointFacts& facts, const LaterEnd& end) {
  Scene scene = parse_scene(facts.provenance.resolved_scene, facts.scene_source);
  scene.text = facts.scene_text;
  scene.overrides = facts.overrides;
  if (end.time) {
    scene.run.time = end.time;
    scene.run.collisions.reset();
  }
  if (end.collisions) {
    scene.run.collisions = end.collisions;
    scene.run.time.reset();
  }
  return scene;
}

}  // namespace

ResumedRun::ResumedRun(const std::filesystem::path& path, const LaterEnd& end)
    : directory(RunDirectory::reopen(path)), from(directory.path()), scene(scene_of(from.facts(), end)) {}

void ResumedRun::check_end(const LaterEnd& end) const {
  const CheckpointFacts& facts = from.facts();
  if (end.time && !(*end.time > facts.time && std::isfinite(*end.time)))
    throw std::invalid_argument(fmt::format("the run has come to time {:g} already; give a later one", facts.time));
  if (end.collisions && *end.collisions <= facts.collisions)
    throw std::invalid_argument(fmt::format("the run has had {} already; give more", facts.collisions));
  if (!end.given()) return;
  try {  // it must bear its new end as it would have borne it from the start: moving walls, samples
    (void)parse_scene(resolved_toml(scene), scene.source);
  } catch (const SceneError& error) {
    throw std::invalid_argument(error.sentence());
  }
}

bool ResumedRun::complete() const {
  // Without a summary it was killed between its last event and its last file.
  std::error_code error;
  return from.facts().finished && std::filesystem::exists(directory.path() / "summary.json", error);
}

Simulation ResumedRun::simulation() const {
  from.read("files", [&](std::istream& in) { RunWriter::require_files(directory, scene, in); });
  std::optional<Simulation> simulation;
  from.read("simulation", [&](std::istream& in) { simulation.emplace(restore_simulation(scene, in)); });
  return std::move(*simulation);
}

Provenance ResumedRun::provenance() const {
  Provenance provenance = from.facts().provenance;
  provenance.resolved_scene = resolved_toml(scene);
  return provenance;
}

}  // namespace carom
