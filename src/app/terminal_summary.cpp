// A scene in words, and the summary of a run on the terminal: what was simulated, what happened, how exact it was, what it
// measured, where the files are, and what to try next.

#include "app/terminal_summary.hpp"

#include "observe/drift.hpp"
#include "pages/scene_words.hpp"
#include "pages/summary_rows.hpp"
#include "scene/drawn.hpp"
#include "studies/horizon/json.hpp"
#include "studies/horizon/report.hpp"
#include "terminal/observed_lines.hpp"
#include "text/methods.hpp"
#include "text/numbers.hpp"
#include "text/shell.hpp"
#include "text/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <carom/simulation.hpp>

#include <algorithm>
#include <cmath>

namespace carom::cli {

namespace {

std::string lines_of(const RunReport& report, const Scene& scene) {
  TerminalTable table("lll");
  for (const SummaryRows& rows :
       {rows_of_what_happened(report, &scene), rows_of_accuracy(report), rows_of_results(report, &scene)}) {
    for (const SummaryRow& row : rows)
      row.remark.empty() ? table.add({row.quantity, row.value}) : table.add({row.quantity, row.value, row.remark});
    table.add({});
  }
  return table.text();
}

std::string heading(const RunReport& report, const Scene& scene) {
  return fmt::format(
      "{}\n{}, packing fraction {:.4g}; {}; seed {}, {}; numbers in scene units\n\n",
      report.title.empty() ? report.scene : report.title, counted(static_cast<std::uint64_t>(report.disks), "disk"),
      report.packing_fraction, fmt::join(report.effects, ", "), scene.run.seed,
      (report.time_step ? "method " : "engine ") + method_words(report.engine, report.time_step, report.stiffness));
}

/// Returns one line per observable, with its first number.
std::string what_was_observed(const RunReport& report) {
  if (report.observables.empty()) return {};
  TerminalTable table("ll");
  for (const Measurement& measured : report.observables) {
    const auto known = std::find_if(measured.scalars.begin(), measured.scalars.end(),
                                    [](const Scalar& scalar) { return scalar.value.has_value(); });
    std::string words = measured.tables.empty() ? measured.note : fmt::format("in observe_{}.csv", measured.tables.front().name);
    if (words.empty() && !measured.scalars.empty()) words = measured.scalars.front().note;
    if (known != measured.scalars.end()) {
      words = known->name + " " + number_words(*known);
      if (!known->unit.empty()) words += fmt::format(" ({})", unit_words(known->unit));
    }
    table.add({measured.name, words});
  }
  return "Observables: the first number of each with its standard error, in scene units (summary.json has all)\n" + table.text() +
         "\n";
}

std::string what_drifts(const RunReport& report) {
  std::vector<std::string> drifting = drifting_numbers(report.observables);
  if (!report.Z_note.empty()) drifting.insert(drifting.begin(), "Z");
  if (drifting.empty()) return {};
  const bool expected = says_not_in_equilibrium(report.Z_note) || some_not_in_equilibrium(report.observables);
  return fmt::format("{}\n{}\n\n", sentence_of_drifts(drifting, expected),
                     expected ? "Let it equilibrate for longer, run.equilibrate, or take the numbers as those of a change."
                              : "Take the numbers as those of a change.");
}

std::string how_far_to_trust(const RunReport& report, const Scene& scene) {
  std::optional<Horizon> horizon = horizon_in(report);
  if (!horizon) return "";
  horizon->run_time = scene.run.time;
  return sentence_of(*horizon) + "\n\n";
}

std::string where_the_files_are(const Results& results) {
  std::vector<std::string> names;
  for (const std::string& file : results.files) names.push_back(std::filesystem::path(file).filename().string());
  return fmt::format("Files in {}: {}\n", results.directory.string(), fmt::join(names, ", "));
}

/// The command that runs the scene with the changes of this run; with `seed` or without the one that was asked for.
std::string again(const RunReport& report, const Scene& scene, const Results& results, bool seed) {
  std::string command = fmt::format("{} run {}", results.program, shell_quoted(report.scene));
  for (const std::string& change : scene.overrides)
    if (seed || !change.starts_with("run.seed=")) command += " --set " + shell_quoted(change);
  return command;
}

/// Returns a name beside the directory of the results that nothing has yet.
std::string free_name(const Results& results, const std::string& ending) {
  const std::filesystem::path here = std::filesystem::absolute(results.directory / "").lexically_normal().parent_path();
  const std::string name = std::filesystem::proximate(here).string() + ending;
  std::error_code error;
  std::string free = name;
  for (int k = 2; std::filesystem::exists(free, error); ++k) free = fmt::format("{}-{}", name, k);
  return shell_quoted(free);
}

/// Returns commands that work as they stand here.
std::string what_to_try_next(const RunReport& report, const Scene& scene, const Results& results) {
  const std::string directory = shell_quoted(results.directory.string());
  const std::string program = results.program;
  std::error_code error;
  const bool has_scene = std::filesystem::exists(report.scene, error);  // not where a run is resumed from another directory
  const auto has_file = [&](std::string_view name) {
    return std::ranges::any_of(results.files,
                               [&](const std::string& file) { return std::filesystem::path(file).filename() == name; });
  };
  const bool has_trajectory = has_file("trajectory.h5md");
  std::string text = "\nTry next\n";
  if (report.time_step && has_scene)
    text += fmt::format("  {} --out {}   # the same scene by exact events\n", again(report, scene, results, true),
                        free_name(results, "-exact"));
  if (has_trajectory && report.samples > 0 && scene.output.trajectory)
    text += fmt::format("  {} play {}   # write a page that replays it\n", program, directory);
  if (!has_file("report.html"))
    text += fmt::format("  {} report {}   # write a page with numbers and plots\n", program, directory);
  if (has_trajectory)
    text += fmt::format("  {} info {}\n", program, shell_quoted((results.directory / "trajectory.h5md").string()));
  if (has_scene && scene.effects.collision.rule == CollisionRule::reversal) {
    text += fmt::format("  {} --set collision.rule=specular --out {}   # smooth hard disks\n",
                        again(report, scene, results, true), free_name(results, "-specular"));
  } else if (has_scene && run_is_drawn(scene)) {
    text += fmt::format("  {} --seed {} --out {}   # another seed\n", again(report, scene, results, false),
                        scene.run.seed == 1 ? 2 : 1, free_name(results, "-again"));
  }
  return text + fmt::format("  {} init --list   # other scenes to start from\n", program);
}

}  // namespace

std::string terminal_summary(const RunReport& report, const Scene& scene, const Results& results) {
  return heading(report, scene) + lines_of(report, scene) + what_was_observed(report) + what_drifts(report) +
         how_far_to_trust(report, scene) + where_the_files_are(results) + what_to_try_next(report, scene, results);
}

std::string describe(const Scene& scene) {
  std::string text;
  for (const SummaryRow& row : words_of(scene)) text += fmt::format("  {:<11} {}\n", row.quantity, row.value);
  return text;
}

std::optional<std::uint64_t> expected_samples(const Scene& scene) {
  const Run& run = scene.run;
  if (!run.is_sampled()) return 0;
  if (run.sample_every_collisions ? !run.collisions || run.time : !run.time || run.collisions) return std::nullopt;
  return last_sample(scene.run) + 1;
}

}  // namespace carom::cli
