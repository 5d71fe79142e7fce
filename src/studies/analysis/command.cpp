// carom analyze RUN_DIR [OBSERVABLE...]: measures afterwards, from what a run has kept.

#include "studies/analysis/command.hpp"
#include "io/json.hpp"
#include "io/observable_output.hpp"
#include "io/run_directory.hpp"
#include "studies/analysis/analysis.hpp"
#include "studies/study_directory.hpp"
#include "terminal/observed_lines.hpp"
#include "terminal/output_paths.hpp"
#include "terminal/progress.hpp"
#include "terminal/reading_process.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace carom::cli {

namespace fs = std::filesystem;

namespace {

constexpr const char* json_name = "analysis.json";

/// Returns the tables of observables among what a run may write, and the numbers.
std::vector<std::string_view> analysis_products() {
  std::vector<std::string_view> names;
  for (const std::string_view product : run_products)
    if (product.starts_with("observe_")) names.push_back(product);
  names.emplace_back(json_name);
  return names;
}

/// A damaged file may let HDF5 go round in circles, but from one sample to the next it has not much time.
Analysis measured(const AnalyzeOptions& options) {
  using Clock = std::chrono::steady_clock;
  ProgressLine line(progress_mode(options.progress, options.quiet), Scene{});
  std::optional<ReadingLimit> limit;
  limit.emplace(options.directory);
  Clock::time_point began = Clock::now();
  const auto progress = [&](double share) {
    line.update("analyze", share);
    if (Clock::now() - began < std::chrono::seconds(1)) return;
    limit.emplace(options.directory);
    began = Clock::now();
  };
  try {
    return as_usage_error([&] { return analyse(options.directory, options.observables, progress); });
  } catch (const SceneError& error) {  // it speaks of an override of the scene, which nobody has typed
    constexpr std::string_view override = "--set observe.";
    std::string_view sentence = error.what();
    if (sentence.starts_with(override)) sentence.remove_prefix(override.size());
    throw UsageError(fmt::format("{}: {}", options.directory, sentence));
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("{}: {}", options.directory, error.what()));
  }
}

std::string text_of(const Analysis& analysis, const AnalyzeOptions& options, const Invocation& invocation) {
  nlohmann::ordered_json json;
  json["carom"] = detail::build_json();
  json["run"] = options.directory;
  json["seed"] = analysis.scene.run.seed;
  json["samples"] = analysis.samples;
  json["events"] = analysis.events;
  json["observables"] = detail::observables_json(analysis.observables);
  json["command_line"] = invocation.command_line;
  json["resolved_scene"] = resolved_toml(analysis.scene);
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace

ExitCode analyze(const AnalyzeOptions& options, const Invocation& invocation) {
  return in_reading_process(options.directory, [&] {
    const Analysis analysis = measured(options);
    const fs::path place = options.out.empty() ? named_after(options.directory, "-analysis") : fs::path(options.out);
    const std::vector<std::string_view> names = analysis_products();
    const RunDirectory directory = open_study(place, options.force, false, names);
    std::vector<std::string> files;
    for (const Measurement& found : analysis.observables)
      for (const Table& table : found.tables) {
        files.push_back(table_file(table));
        write_table(directory.partial_name(files.back()), table);
        directory.publish(files.back());
      }
    const std::string json = text_of(analysis, options, invocation);
    write_product(directory, json_name, json + "\n");
    files.emplace_back(json_name);
    if (options.json) {
      fmt::print("{}\n", json);
    } else if (!options.quiet) {
      fmt::print("{}: {}{}\n\n{}\nFiles in {}: {}\n", options.directory, counted(analysis.samples, "sample"),
                 analysis.events > 0 ? ", " + counted(analysis.events, "event") : "",
                 observed_lines(analysis.observables, analysis.scene), place.string(), fmt::join(files, ", "));
    }
    return exit_done;
  });
}

}  // namespace carom::cli
