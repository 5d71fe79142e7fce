// carom resume RUN_DIR and carom extend RUN_DIR: a run goes on from its newest sound checkpoint as if it had never stopped.

#include "app/commands.hpp"
#include "app/run_session.hpp"
#include "io/checkpoint.hpp"
#include "io/output_error.hpp"
#include "io/run_writer.hpp"

#include <fmt/format.h>
#include <carom/simulation.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <new>
#include <optional>
#include <stdexcept>

namespace carom::cli {

namespace {

/// Returns the scene of the run, to the bit, with the end that is asked for.
Scene scene_of(const CheckpointFacts& facts, const ResumeOptions& options) {
  Scene scene = parse_scene(facts.provenance.resolved_scene, facts.scene_source);
  scene.text = facts.scene_text;
  scene.overrides = facts.overrides;
  if (options.time) {
    scene.run.time = options.time;
    scene.run.collisions.reset();
  }
  if (options.collisions) {
    scene.run.collisions = options.collisions;
    scene.run.time.reset();
  }
  return scene;
}

/// The scene must bear its new end as it would have borne it from the start: moving walls, samples.
void check_scene(const Scene& scene, const ResumeOptions& options) {
  if (!options.time && !options.collisions) return;
  try {
    (void)parse_scene(resolved_toml(scene), scene.source);
  } catch (const SceneError& error) {
    throw UsageError(fmt::format(
        "{}: {}", options.time ? fmt::format("--time {:g}", *options.time) : fmt::format("--collisions {}", *options.collisions),
        error.sentence()));
  }
}

/// The end must lie ahead.
void check_end(const CheckpointFacts& facts, const ResumeOptions& options) {
  if (options.time && !(*options.time > facts.time && std::isfinite(*options.time)))
    throw UsageError(
        fmt::format("--time {:g}: the run has come to time {:g} already; give a later one", *options.time, facts.time));
  if (options.collisions && *options.collisions <= facts.collisions)
    throw UsageError(
        fmt::format("--collisions {}: the run has had {} already; give more", *options.collisions, facts.collisions));
}

/// Returns the options: those of this command, and where it gives none those of the checkpoint.
RunOptions options_for(const CheckpointFacts& facts, const ResumeOptions& options) {
  RunOptions run = options.run;
  run.scene.path = facts.scene_source;
  run.out = options.directory;
  if (facts.verify > 0) run.verify = facts.verify;
  run.report = run.report || facts.report;
  if (!run.checkpoint_every && !facts.checkpoint_every.empty()) run.checkpoint_every = facts.checkpoint_every;
  return run;
}

template <class Require>
ExitCode go_on(const ResumeOptions& options, const Invocation& invocation, Require require) {
  const auto began = std::chrono::steady_clock::now();
  check_options(options.run);
  std::optional<RunDirectory> directory;
  std::optional<Checkpoint> from;
  try {
    directory = RunDirectory::reopen(options.directory);
    from.emplace(directory->path());
  } catch (const OutputError& error) {
    throw UsageError(error.what());
  }
  if (!from->damage().empty()) fmt::print(stderr, "carom: {}; going on from {} instead\n", from->damage(), from->path().string());
  const CheckpointFacts& facts = from->facts();
  require(facts);
  check_end(facts, options);
  const RunOptions run = options_for(facts, options);
  const Scene scene = scene_of(facts, options);
  check_scene(scene, options);
  try {
    from->read("files", [&](std::istream& in) { RunWriter::require_files(*directory, scene, in); });
  } catch (const OutputError& error) {
    throw UsageError(error.what());
  }
  std::optional<Simulation> simulation;
  from->read("simulation", [&](std::istream& in) { simulation.emplace(restore_simulation(scene, in)); });
  Provenance provenance = facts.provenance;
  provenance.resolved_scene = resolved_toml(scene);
  if (!run.quiet && !run.json)
    fmt::print(stderr, "carom: {}: going on from time {:.6g}\n", directory->path().string(), simulation->time());
  try {
    return carry_out({run, invocation, *simulation, provenance, *directory, &*from, began});
  } catch (const std::bad_alloc&) {
    throw std::runtime_error(fmt::format("{}: there is not enough memory for this run", options.directory));
  }
}

}  // namespace

ExitCode resume(const ResumeOptions& options, const Invocation& invocation) {
  return go_on(options, invocation, [&](const CheckpointFacts& facts) {
    // Without a summary it was killed between its last event and its last file.
    std::error_code error;
    const bool complete =
        facts.finished && std::filesystem::exists(std::filesystem::path(options.directory) / "summary.json", error);
    if (complete && !options.time && !options.collisions)
      throw UsageError(fmt::format("{}: this run has come to its end; carom extend takes it to a later one", options.directory));
  });
}

ExitCode extend(const ResumeOptions& options, const Invocation& invocation) {
  if (!options.time && !options.collisions) throw UsageError("carom extend: give the new end, with --time or with --collisions");
  return go_on(options, invocation, [&](const CheckpointFacts& facts) {
    if (!facts.finished)
      throw UsageError(fmt::format("{}: this run has not come to its end; carom resume goes on with it", options.directory));
  });
}

}  // namespace carom::cli
