// carom hardcases: runs the corpus of hard cases, or those that are named, and says of each whether what must hold does.

#include "studies/hard_cases/command.hpp"
#include "studies/hard_cases/hard_case.hpp"
#include "studies/hard_cases/steps.hpp"
#include "studies/hard_cases/table.hpp"
#include "terminal/output_paths.hpp"
#include "terminal/signals.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <carom/simulation.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace carom::cli {

namespace fs = std::filesystem;

namespace {

const HardCase& case_named(const std::string& name) {
  const auto& corpus = hard_case_corpus();
  const auto found = std::find_if(corpus.begin(), corpus.end(), [&](const HardCase& one) { return one.name == name; });
  if (found == corpus.end())
    throw UsageError(fmt::format(
        "{}: there is no such case; carom hardcases --list names them all, and a file of your own ends in .toml", name));
  return *found;
}

void require_known(const HardCasesOptions& options) {
  const std::vector<std::string> engines = engine_names();
  if (options.engine != "auto" && std::find(engines.begin(), engines.end(), options.engine) == engines.end())
    throw UsageError(
        fmt::format("--engine {}: there is no such engine; choose one of: {}", options.engine, fmt::join(engines, ", ")));
  const std::vector<std::string> methods = fixed_step_names();
  if (!options.method.empty() && std::find(methods.begin(), methods.end(), options.method) == methods.end())
    throw UsageError(
        fmt::format("--method {}: there is no such method; choose one of: {}", options.method, fmt::join(methods, ", ")));
  if (options.dt && options.method.empty())
    throw UsageError("--dt is the step of a fixed-step method; give --method, or leave it out");
  if (options.dt && !(*options.dt > 0.0)) throw UsageError(fmt::format("--dt {:g}: a time step must be above zero", *options.dt));
  const auto refuse_beside_method = [&](bool is_given, const char* option) {
    if (is_given && !options.method.empty())
      throw UsageError(fmt::format("--method and {} do not go together: a method is shown as a table or in Markdown", option));
  };
  refuse_beside_method(options.json, "--json");
  refuse_beside_method(!options.page.empty(), "--page");
  refuse_beside_method(options.engine != "auto", "--engine");
  const auto& families = hard_case_families();
  if (!options.family.empty() && std::find(families.begin(), families.end(), options.family) == families.end())
    throw UsageError(
        fmt::format("--family {}: there is no such family; choose one of: {}", options.family, fmt::join(families, ", ")));
}

/// Runs the cases by a fixed-step method, whose errors are no failure of the program.
ExitCode in_steps(const HardCasesOptions& options, const std::vector<HardCase>& cases) {
  std::vector<StepTrial> trials;
  for (const HardCase& one : cases) trials.push_back(run_in_steps(one, options.method, options.dt));
  fmt::print("{}", options.markdown ? steps_markdown(trials, options.method) : steps_table(trials));
  return exit_done;
}

ExitCode exit_code_of(const std::vector<CaseVerdict>& verdicts) {
  const auto all = [&](auto&& holds) { return std::all_of(verdicts.begin(), verdicts.end(), holds); };
  if (!all([](const CaseVerdict& one) { return one.keeps_invariants(); })) return exit_invalid_state;
  return all([](const CaseVerdict& one) { return one.holds(); }) ? exit_done : exit_check_failed;
}

}  // namespace

std::vector<HardCase> chosen_cases(const HardCasesOptions& options) {
  require_known(options);
  std::vector<HardCase> cases;
  for (const std::string& name : options.cases)
    cases.push_back(name.ends_with(".toml") ? load_hard_case(name) : case_named(name));
  if (!options.cases.empty()) return cases;
  for (const HardCase& one : hard_case_corpus())
    if ((options.family.empty() || one.family == options.family) && (options.takes_long || options.list || !one.takes_long))
      cases.push_back(one);
  return cases;
}

ExitCode hardcases(const HardCasesOptions& options, const Invocation& invocation) {
  if (!options.show.empty()) {
    require_known(options);
    fmt::print("{}", case_named(options.show).text);
    return exit_done;
  }
  const std::vector<HardCase> cases = chosen_cases(options);
  if (options.list) {
    fmt::print("{}", hardcases_list(cases));
    return exit_done;
  }
  if (!options.method.empty()) return in_steps(options, cases);
  const fs::path page =
      options.page.empty() ? fs::path() : place_for_page(options.page, {}, {"page of hard cases", hard_cases_mark, "--page"});
  const bool as_it_goes = !options.json && !options.markdown;
  const StopRequest stop;
  std::vector<CaseVerdict> verdicts;
  if (as_it_goes) fmt::print("{}", hardcases_header());
  for (const HardCase& one : cases) {
    verdicts.push_back(run_hard_case(one, options.engine, [&stop] { return !stop.made(); }));
    if (stop.made()) {
      fmt::print(stderr, "carom: interrupted in {}, after {} of {}\n", one.name, verdicts.size() - 1,
                 counted(cases.size(), "case"));
      return exit_interrupted;
    }
    if (as_it_goes) fmt::print("{}", hardcases_row(verdicts.back()));
    if (as_it_goes) std::fflush(stdout);
  }
  if (std::all_of(verdicts.begin(), verdicts.end(), [](const CaseVerdict& one) { return one.checks.empty(); }))
    throw UsageError(fmt::format("--engine {}: this engine covers none of these cases; leave it out", options.engine));
  if (as_it_goes) fmt::print("{}", hardcases_footer(verdicts));
  if (options.json) fmt::print("{}\n", hard_cases_json(verdicts));
  if (options.markdown) fmt::print("{}", hard_cases_markdown(verdicts));
  if (!page.empty()) write_whole_file(page, html_page(hard_case_page(cases, verdicts, invocation.command_line)));
  return exit_code_of(verdicts);
}

}  // namespace carom::cli
