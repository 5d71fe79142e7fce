// The studies: what accuracy costs, how far a trajectory can be trusted, whether theory and the hard cases hold, and the numbers
// of sweeps. Results cross as the JSON and the text that the program writes.

#include "python/buffers.hpp"
#include "python/parts.hpp"
#include "studies/compare/command.hpp"
#include "studies/compare/files.hpp"
#include "studies/compare/page.hpp"
#include "studies/compare/side_by_side_option.hpp"
#include "studies/compare/text.hpp"
#include "studies/diff/diff.hpp"
#include "studies/diff/text.hpp"
#include "studies/hard_cases/command.hpp"
#include "studies/hard_cases/table.hpp"
#include "studies/horizon/command.hpp"
#include "studies/horizon/json.hpp"
#include "studies/horizon/method.hpp"
#include "studies/horizon/report.hpp"
#include "studies/horizon/spectrum.hpp"
#include "studies/horizon/text.hpp"
#include "studies/sweep/numbers.hpp"
#include "studies/sweep/results.hpp"
#include "studies/validate/command.hpp"
#include "studies/validate/files.hpp"

#include <carom/pages/page.hpp>
#include <carom/simulation.hpp>

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <nlohmann/json.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

namespace carom::python {

namespace {

/// Lets a study look at Python some twenty times a second: at signals, and at the caller's `report` of the fraction done. What
/// Python raises stops the study, and is raised anew when the study has ended: some studies take an exception for a result.
class Watch {
 public:
  /// `report` may be None. Requires that it outlives this.
  explicit Watch(const nb::object& report) : report_(report) {}

  /// Returns whether the study may go on. Called without the interpreter's lock.
  bool operator()(double fraction) {
    constexpr std::chrono::milliseconds between(50);
    if (raised_) return false;
    const auto now = std::chrono::steady_clock::now();
    if (now - looked_ < between) return true;
    looked_ = now;
    const nb::gil_scoped_acquire locked;
    try {
      look_at_python([&] {
        if (!report_.is_none()) report_(fraction);
      });
    } catch (const nb::python_error& error) {
      interrupted_ = error.matches(PyExc_KeyboardInterrupt);
      raised_ = std::current_exception();
    }
    return !raised_;
  }

  [[nodiscard]] bool interrupted() const { return interrupted_; }

  void raise() const {
    if (raised_) std::rethrow_exception(raised_);
  }

 private:
  const nb::object& report_;
  std::chrono::steady_clock::time_point looked_;
  std::exception_ptr raised_;
  bool interrupted_ = false;
};

/// Calls `study` without the interpreter's lock. What Python has raised meanwhile comes first, whatever the study made of it.
template <class Study>
auto watched(Watch& watch, Study study) {
  try {
    const nb::gil_scoped_release released;
    return study();
  } catch (...) {
    watch.raise();
    throw;
  }
}

/// compare.json, compare.csv, the terminal's text, the page
using ComparisonParts = std::tuple<std::string, std::string, std::string, std::string>;

ComparisonParts compare_methods(const Scene& scene, const cli::CompareCommandOptions& wishes, const nb::object& report) {
  const CompareOptions options = cli::compare_options(wishes);
  cli::require_comparable(scene, "carom compare");
  Watch watch(report);
  const ComparisonParts parts = watched(watch, [&]() -> ComparisonParts {
    (void)make_simulation(scene, options.engine);
    cli::check_steps(scene, options);
    CompareHooks hooks;
    hooks.proceed = [&](const std::string&, double fraction) { return watch(fraction); };
    const Comparison comparison = carom::compare(scene, options, hooks);
    if (!comparison.complete) return {};
    return {compare_json(comparison, scene, {}), compare_csv(comparison), cli::compare_text(comparison, scene, false),
            html_page(compare_page(comparison, scene, {}))};
  });
  watch.raise();
  return parts;
}

/// The plan of a comparison is all that is needed of it.
std::string side_by_side(const Scene& scene, const std::string& method, std::optional<double> stiffness,
                         const std::string& engine, const nb::object& report) {
  cli::CompareCommandOptions wishes;
  wishes.scene.engine = engine;
  wishes.stiffness = stiffness;
  const CompareOptions options = cli::compare_options(wishes);
  cli::require_comparable(scene, "carom compare");
  Watch watch(report);
  const std::string html = watched(watch, [&] {
    (void)make_simulation(scene, options.engine);
    const cli::PlayChoice choice = cli::checked_play(method, scene, options.stiffness);
    std::optional<cli::SideBySidePage> page;
    bool planned = false;
    CompareHooks hooks;
    hooks.proceed = [&](const std::string&, double fraction) { return !planned && watch(10.0 * fraction); };
    hooks.planned = [&](const ComparePlan& plan, const State& start) {
      planned = true;
      page = cli::make_side_by_side(choice, scene, options.engine, plan, start, {}, [&](double) { return watch(0.5); });
    };
    (void)carom::compare(scene, options, hooks);
    return page ? page->html : std::string();
  });
  watch.raise();
  return html;
}

/// What `carom horizon --json` prints, the table of the terminal, the sentence
using HorizonParts = std::tuple<std::string, std::string, std::string>;

HorizonParts horizon(const Scene& scene, const std::string& engine, std::optional<std::uint64_t> collisions,
                     const nb::object& report) {
  if (collisions == 0) throw cli::UsageError("--collisions 0: an exponent needs some collisions");
  (void)cli::checked_engine({.path = {}, .overrides = {}, .seed = {}, .engine = engine});
  cli::require_comparable(scene, "carom horizon");
  Watch watch(report);
  const HorizonParts parts = watched(watch, [&]() -> HorizonParts {
    const std::optional<State> start = measured_start(scene, engine, [&](const Progress&) { return watch(0.0); });
    if (!start)
      throw std::runtime_error(
          fmt::format("{}: the scene stopped while equilibrating, before anything was compared", scene.source));
    const Horizon measured = measure_horizon(
        scene, *start,
        {.engine = engine, .lyapunov_collisions = collisions.value_or(0), .proceed = [&](const HorizonProgress& progress) {
           return watch(progress.fraction);
         }});
    return {horizon_study_json(measured, scene), cli::horizon_table(measured, scene), sentence_of(measured)};
  });
  watch.raise();
  return parts;
}

/// What `carom horizon --spectrum --json` prints, the lines of the terminal
using SpectrumParts = std::tuple<std::string, std::string>;

SpectrumParts lyapunov_spectrum(const Scene& scene, std::optional<std::uint64_t> collisions, const nb::object& report) {
  if (collisions == 0) throw cli::UsageError("--collisions 0: an exponent needs some collisions");
  cli::require_comparable(scene, "carom horizon");
  if (const std::string words = why_no_spectrum(scene); !words.empty()) throw cli::UsageError(words);
  Watch watch(report);
  const SpectrumParts parts = watched(watch, [&]() -> SpectrumParts {
    const std::optional<State> start = measured_start(scene, "auto", [&](const Progress&) { return watch(0.0); });
    if (!start)
      throw std::runtime_error(
          fmt::format("{}: the scene stopped while equilibrating, before anything was measured", scene.source));
    const std::optional<LyapunovSpectrum> found = measure_spectrum(
        scene, *start, {.collisions = collisions.value_or(0), .proceed = [&](double fraction) { return watch(fraction); }});
    if (!found) throw std::runtime_error(fmt::format("{}: {}", scene.source, no_exponents));
    return {spectrum_json(*found, scene), spectrum_text(*found, scene)};
  });
  watch.raise();
  return parts;
}

/// validation.json, the verdicts of all checks in words, one line on all of them, the page, whether it is complete
using ValidationParts = std::tuple<std::string, std::vector<std::string>, std::string, std::string, bool>;

ValidationParts validate(bool full, const std::vector<std::string>& only, std::int64_t seed, std::optional<int> threads,
                         const nb::object& report) {
  const ValidateOptions options =
      cli::validate_options({.full = full, .seed = seed, .only = only, .threads = threads, .out = {}});
  Watch watch(report);
  ValidationParts parts = watched(watch, [&]() -> ValidationParts {
    ValidateHooks hooks;
    hooks.proceed = [&](const std::string&, double fraction) { return watch(fraction); };
    const Validation validation = carom::validate(options, hooks);
    std::vector<std::string> verdicts;
    for (const TrialResult& result : validation.results)
      for (const Check& check : result.checks) verdicts.push_back(row_of(check).verdict);
    return {validation_json(validation, {}), verdicts, summary_of(validation), html_page(validation_page(validation, {})),
            validation.complete};
  });
  if (!watch.interrupted()) watch.raise();
  return parts;
}

std::vector<std::string> validation_trials(bool full) {
  std::vector<std::string> names;
  for (const validation::Trial& trial : chosen_trials({.full = full})) names.push_back(trial.name);
  return names;
}

/// name, family, statement, names of engines, number of checks, what is nearest to its bound, verdict, seconds
using CaseParts = std::tuple<std::string, std::string, std::string, std::string, std::size_t, std::string, std::string, double>;

/// Returns all cases, and one line on all of them.
std::tuple<std::vector<CaseParts>, std::string> hard_cases(const std::vector<std::string>& names, const std::string& engine,
                                                           const nb::object& report) {
  cli::HardCasesOptions wishes;
  wishes.cases = names;
  wishes.engine = engine;
  const std::vector<HardCase> cases = cli::chosen_cases(wishes);
  Watch watch(report);
  const auto parts = watched(watch, [&] {
    std::vector<CaseVerdict> verdicts;
    std::vector<CaseParts> rows;
    const auto done = [&] { return static_cast<double>(verdicts.size()) / static_cast<double>(cases.size()); };
    for (const HardCase& one : cases) {
      if (!watch(done())) break;
      verdicts.push_back(run_hard_case(one, engine, [&] { return watch(done()); }));
      const HardCaseRow row = row_of(verdicts.back());
      rows.emplace_back(row.name, one.family, one.title, row.engines, verdicts.back().checks.size(), row.worst, row.verdict,
                        verdicts.back().seconds);
    }
    return std::tuple(rows, summary_of(verdicts));
  });
  watch.raise();
  return parts;
}

/// name, value, unit
using NumberParts = std::tuple<std::string, std::optional<double>, std::string>;

std::vector<NumberParts> numbers_in(const std::string& summary) {
  std::vector<NumberParts> numbers;
  for (const SummaryNumber& number : numbers_of(nlohmann::ordered_json::parse(summary)))
    numbers.emplace_back(number.name, number.value, number.unit);
  return numbers;
}

void require_numbers(const Scene& scene, const std::vector<std::string>& names) {
  const std::vector<std::string> known = number_names(scene);
  for (const std::string& name : names)
    if (!has_number(name, scene, known))
      throw std::invalid_argument(fmt::format("numbers: \"{}\": {}", name, fault_of_number_name(name, known)));
}

void translate_usage(const std::exception_ptr& thrown, void*) {
  try {
    std::rethrow_exception(thrown);
  } catch (const cli::UsageError& error) {
    PyErr_SetString(PyExc_ValueError, error.what());
  }
}

}  // namespace

void add_studies(nb::module_& module) {
  nb::register_exception_translator(translate_usage);
  module.def(
      "compare",
      [](const Scene& scene, const std::vector<double>& dts, std::optional<std::int64_t> seeds, double longest,
         std::optional<double> stiffness, const std::string& engine, bool costs, const nb::object& report) {
        cli::CompareCommandOptions wishes;
        wishes.scene.engine = engine;
        wishes.dts = dts;
        wishes.seeds = seeds;
        wishes.longest = longest;
        wishes.stiffness = stiffness;
        wishes.no_costs = !costs;
        return compare_methods(scene, wishes, report);
      },
      nb::arg("scene"), nb::arg("dts"), nb::arg("seeds").none(), nb::arg("longest"), nb::arg("stiffness").none(),
      nb::arg("engine"), nb::arg("costs"), nb::arg("report").none());
  module.def("side_by_side", &side_by_side, nb::arg("scene"), nb::arg("method"), nb::arg("stiffness").none(), nb::arg("engine"),
             nb::arg("report").none());
  module.def(
      "difference",
      [](const std::string& first, const std::string& second) {
        const nb::gil_scoped_release released;
        const RunDifference found = difference_of(open_diff_run(first), open_diff_run(second));
        return std::tuple(diff_json(found), diff_text(found));
      },
      nb::arg("first"), nb::arg("second"), "Returns what carom diff --json prints, and the text of the terminal.");
  module.def("horizon", &horizon, nb::arg("scene"), nb::arg("engine"), nb::arg("collisions").none(), nb::arg("report").none());
  module.def("lyapunov_spectrum", &lyapunov_spectrum, nb::arg("scene"), nb::arg("collisions").none(), nb::arg("report").none());
  module.def("validate", &validate, nb::arg("full"), nb::arg("only"), nb::arg("seed"), nb::arg("threads").none(),
             nb::arg("report").none());
  module.def("validation_trials", &validation_trials, nb::arg("full"));
  module.def("hard_cases", &hard_cases, nb::arg("names"), nb::arg("engine"), nb::arg("report").none());
  module.def("hard_case_names", [] {
    std::vector<std::string> names;
    for (const HardCase& one : hard_case_corpus()) names.push_back(one.name);
    return names;
  });
  module.def("numbers_in", &numbers_in, nb::arg("summary"), "Returns name, value and unit of all numbers of a summary.json.");
  module.def(
      "is_usual_number", [](const std::string& name) { return is_usual_number(name); }, nb::arg("name"));
  module.def("require_numbers", &require_numbers, nb::arg("scene"), nb::arg("names"),
             "Raises ValueError where a run of the scene has no number of such a name.");
  module.def(
      "unit_of_key", [](const std::string& key) { return unit_of_key(key); }, nb::arg("key"));
  module.def(
      "average",
      [](const std::vector<std::optional<double>>& values) {
        const SeedAverage average = average_of(values);
        return std::tuple(average.mean, average.error);
      },
      nb::arg("values").none(), "Returns the mean and its standard error; None where there are too few numbers.");
}

}  // namespace carom::python
