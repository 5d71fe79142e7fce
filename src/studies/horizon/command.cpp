// carom horizon SCENE: how far the scene's trajectory can be trusted, in a table and one sentence. Writes no files.

#include "studies/horizon/command.hpp"
#include "studies/horizon/json.hpp"
#include "studies/horizon/method.hpp"
#include "studies/horizon/report.hpp"
#include "studies/horizon/spectrum.hpp"
#include "studies/horizon/text.hpp"

#include <fmt/format.h>
#include <carom/simulation.hpp>

#include <cstdio>
#include <new>
#include <optional>
#include <string_view>
#include <utility>

namespace carom::cli {

namespace {

ExitCode measure_all_exponents(const Scene& scene, const State& start, const HorizonCommandOptions& options, ProgressMode mode,
                               const StopRequest& stop) {
  std::optional<LyapunovSpectrum> found;
  {
    ProgressLine line(mode, scene);
    found = measure_spectrum(scene, start, {.collisions = options.collisions.value_or(0), .proceed = [&](double fraction) {
                                              line.update("Lyapunov exponents", fraction);
                                              return !stop.made();
                                            }});
  }
  if (!found) {
    fmt::print(stderr, "carom: {}: {}\n", scene.source,
               stop.made() ? std::string_view("interrupted before the exponents were measured") : no_exponents);
    return stop.made() ? exit_interrupted : exit_failed;
  }
  fmt::print("{}", options.json ? spectrum_json(*found, scene) + "\n" : spectrum_text(*found, scene));
  return exit_done;
}

ExitCode measure(const HorizonCommandOptions& options) {
  if (options.collisions == 0) throw UsageError("--collisions 0: an exponent needs some collisions");
  const ProgressMode mode = progress_mode(options.progress, options.quiet);
  const std::string& engine = checked_engine(options.scene);
  const Scene scene = load(options.scene);
  require_comparable(scene, "carom horizon");
  if (options.spectrum)
    if (const std::string words = why_no_spectrum(scene); !words.empty()) throw UsageError("--spectrum: " + words);
  const StopRequest stop;
  const std::optional<State> start = [&] {
    ProgressLine line(mode, scene);
    return measured_start(scene, engine, [&](const Progress& progress) {
      line.update(progress);
      return !stop.made();
    });
  }();
  if (!start) {
    fmt::print(stderr, "carom: {}: {} while equilibrating, before anything was compared\n", scene.source,
               stop.made() ? "interrupted" : "the scene stopped");
    return stop.made() ? exit_interrupted : exit_failed;
  }
  if (options.spectrum) return measure_all_exponents(scene, *start, options, mode, stop);
  const Horizon horizon =
      horizon_with_progress(scene, *start, {.engine = engine, .lyapunov_collisions = options.collisions.value_or(0)}, mode, stop);
  if (options.json) {
    fmt::print("{}\n", horizon_study_json(horizon, scene));
  } else {
    fmt::print("{}{}\n", options.quiet ? "" : horizon_table(horizon, scene) + "\n", sentence_of(horizon));
  }
  return horizon.ended == HorizonEnd::interrupted ? exit_interrupted : exit_done;
}

}  // namespace

ExitCode horizon(const HorizonCommandOptions& options) {
  try {
    return measure(options);
  } catch (const std::bad_alloc&) {
    throw std::runtime_error(fmt::format("{}: {}; fewer disks need less", options.scene.path, no_memory_for_horizon));
  }
}

}  // namespace carom::cli
