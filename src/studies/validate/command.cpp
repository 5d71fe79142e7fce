// carom validate: holds the engine against kinetic theory and the literature, and says pass or fail with the numbers. Every trial
// is on the disk when it is finished, so that an interrupted validation goes on where it was.

#include "studies/validate/command.hpp"
#include "studies/study_directory.hpp"
#include "studies/validate/files.hpp"
#include "studies/validate/validation.hpp"
#include "terminal/progress.hpp"
#include "terminal/signals.hpp"
#include "text/numbers.hpp"

#include <carom/pages/page.hpp>

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string_view>

namespace carom::cli {

namespace {

/// validation.json comes last: where it is, the validation is complete.
constexpr std::array<std::string_view, 3> validation_products = {"trials.jsonl", "report.html", "validation.json"};

Validation earlier_trials(const RunDirectory& directory, const std::string& key, const ValidateCommandOptions& options) {
  if (!options.resume) return {};
  return as_usage_error([&] { return load_trials(directory.final_name("trials.jsonl"), key); });
}

/// Names the trials that `options` choose, those of --full too.
std::string list(ValidateOptions options) {
  options.full = true;
  std::string text, group;
  for (const validation::Trial& trial : chosen_trials(options)) {
    if (trial.group != group) text += fmt::format("{}{}\n", group.empty() ? "" : "\n", trial.group);
    group = trial.group;
    text += fmt::format("  {}{}\n", trial.name, trial.only_full ? " (--full)" : "");
  }
  return text;
}

/// Returns the results of one trial, in lines of the terminal.
std::string lines_of(const TrialResult& result) {
  std::string text = fmt::format("{} ({})\n", result.trial, duration(result.seconds));
  for (const Check& check : result.checks) {
    const CheckRow row = row_of(check);
    text += fmt::format("  {:<23} {}\n", row.verdict, sentence_of(check));
    if (!check.holds()) text += fmt::format("  {:<23} theory: {}; {}\n", "", row.theory, row.source);
  }
  return text;
}

}  // namespace

ValidateOptions validate_options(const ValidateCommandOptions& options) {
  if (options.quick && options.full) throw UsageError("--quick and --full: give one of them");
  // Each run of a trial has a seed of its own, which a scene must be able to hold.
  constexpr std::int64_t most = 9'000'000'000'000;
  if (options.seed < 0 || options.seed > most) throw UsageError(fmt::format("--seed {}: it can be 0 to {}", options.seed, most));
  constexpr int most_threads = 4096;
  if (options.threads && (*options.threads < 1 || *options.threads > most_threads))
    throw UsageError(fmt::format("--threads {}: it can be 1 to {}", *options.threads, most_threads));
  ValidateOptions chosen{.full = options.full,
                         .seed = static_cast<std::uint64_t>(options.seed),
                         .only = options.only,
                         .threads = options.threads.value_or(0)};
  try {
    (void)chosen_trials(chosen);
  } catch (const std::invalid_argument& error) {
    throw UsageError(
        fmt::format("--only {}: there is no such trial and no such group; carom validate --list names them all", error.what()));
  }
  return chosen;
}

ExitCode validate(const ValidateCommandOptions& options, const Invocation& invocation) {
  const ValidateOptions chosen = validate_options(options);
  if (options.list) {
    fmt::print("{}", list(chosen));
    return exit_done;
  }
  const ProgressMode mode = progress_mode(options.progress, options.quiet);
  const std::string key = validation_key(chosen);
  const StopRequest stop;
  const RunDirectory directory =
      open_study(options.out.empty() ? "validation" : options.out, options.force, options.resume, validation_products);
  try {
    const Validation before = earlier_trials(directory, key, options);
    TrialsFile trials(directory.final_name("trials.jsonl"), key, before);
    const bool as_it_goes = !options.json && !options.markdown && !options.quiet;
    std::size_t finished = before.results.size();
    Validation validation;
    {
      ProgressLine line(mode, Scene{});
      ValidateHooks hooks;
      hooks.proceed = [&](const std::string& doing, double fraction) {
        line.update(doing, fraction);
        return !stop.made();
      };
      hooks.done = [&](const TrialResult& result) {
        trials.add(result);
        ++finished;
        if (as_it_goes) fmt::print("{}", lines_of(result));
        if (as_it_goes) std::fflush(stdout);
      };
      validation = validate(chosen, hooks, before);
    }
    if (!validation.complete) {
      fmt::print(stderr, "carom: validate: interrupted; {} in {}: the same command with --resume goes on from there\n",
                 counted(finished, "finished trial"), directory.final_name("trials.jsonl").string());
      return exit_interrupted;
    }
    const std::string json = validation_json(validation, invocation.command_line);
    write_product(directory, "report.html", html_page(validation_page(validation, invocation.command_line)));
    write_product(directory, "validation.json", json + "\n");
    if (options.json) fmt::print("{}\n", json);
    if (options.markdown) fmt::print("{}", validation_markdown(validation));
    if (!options.json && !options.markdown) {
      fmt::print("{}{}\n", as_it_goes ? "\n" : "", summary_of(validation));
      for (const GroupFit& fit : group_fits(validation)) fmt::print("  {}: {}\n", fit.group, sentence_of(fit));
      if (!options.quiet) fmt::print("Files in {}: report.html, validation.json, trials.jsonl\n", directory.path().string());
    }
    return validation.failed() == 0 ? exit_done : exit_check_failed;
  } catch (...) {
    directory.discard_if_empty();
    throw;
  }
}

}  // namespace carom::cli
