// carom compare SCENE: what accuracy costs, in compare.json, compare.csv, report.html and a table. Every point is on the disk
// when it is finished, so that an interrupted study goes on where it was.

#include "studies/compare/command.hpp"

#include "simulation/springs.hpp"
#include "studies/compare/compare.hpp"
#include "studies/compare/external_trajectory.hpp"
#include "studies/compare/files.hpp"
#include "studies/compare/page.hpp"
#include "studies/compare/side_by_side_option.hpp"
#include "studies/compare/text.hpp"
#include "studies/compare/trajectory_file.hpp"
#include "studies/horizon/method.hpp"
#include "studies/study_directory.hpp"
#include "terminal/progress.hpp"
#include "terminal/signals.hpp"

#include <fmt/format.h>
#include <carom/pages/page.hpp>
#include <carom/simulation.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace carom::cli {

namespace {

/// compare.json comes last: where it is, the comparison is complete.
constexpr std::array<std::string_view, 5> compare_products = {"points.jsonl", side_by_side_file, "compare.csv", "report.html",
                                                              "compare.json"};

std::filesystem::path directory_for(const CompareCommandOptions& options) {
  if (!options.out.empty()) return options.out;
  return std::filesystem::path(options.scene.path).stem().string() + "-compare";
}

Comparison earlier_points(const RunDirectory& directory, const std::string& key, const CompareCommandOptions& options) {
  if (!options.resume) return {};
  return as_usage_error([&] { return load_points(directory.final_name("points.jsonl"), key); });
}

/// A trajectory of another program, against exact events.
ExitCode compare_own(const CompareCommandOptions& options) {
  const ProgressMode mode = progress_mode(options.progress, options.quiet);
  const std::string& engine = checked_engine(options.scene);
  const Scene scene = load(options.scene);
  require_comparable(scene, "carom compare");
  const Simulation as_given = make_simulation(scene, engine);
  const std::vector<State> frames =
      as_usage_error([&] { return read_trajectory_file(*options.trajectory, scene, as_given.disks(), options.every); });
  const StopRequest stop;
  auto line = std::make_unique<ProgressLine>(mode, scene);
  const std::optional<State> start = measured_start(scene, engine, [&](const Progress& progress) {
    line->update(progress);
    return !stop.made();
  });
  std::optional<ExternalTrajectory> compared;
  if (start)
    compared = compare_trajectory(scene, *start, frames, [&](double fraction) {
      line->update("comparing frames", fraction);
      return !stop.made();
    });
  line.reset();
  if (!compared && !stop.made()) throw std::runtime_error(fmt::format("{}: the scene stops while it equilibrates", scene.source));
  if (!compared) {
    fmt::print(stderr, "carom: {}: interrupted before the trajectory was compared\n", scene.source);
    return exit_interrupted;
  }
  const auto written = options.json ? external_trajectory_json : external_trajectory_text;
  fmt::print("{}{}", written(*compared, scene, *options.trajectory), options.json ? "\n" : "");
  return exit_done;
}

ExitCode compare_scene(const CompareCommandOptions& options, const Invocation& invocation) {
  const CompareOptions study = compare_options(options);
  const ProgressMode mode = progress_mode(options.progress, options.quiet);
  const Scene scene = load(options.scene);
  require_comparable(scene, "carom compare");
  (void)make_simulation(scene, study.engine);  // whatever is wrong with the scene is said before anything is written
  check_steps(scene, study);
  std::optional<PlayChoice> play;
  if (options.play) play = checked_play(*options.play, scene, study.stiffness);
  const std::string key = study_key(scene, study);
  const StopRequest stop;
  const RunDirectory directory = open_study(directory_for(options), options.force, options.resume, compare_products);
  try {
    Comparison before = earlier_points(directory, key, options);
    std::unique_ptr<PointsFile> points;
    auto line = std::make_unique<ProgressLine>(mode, scene);
    CompareHooks hooks;
    hooks.proceed = [&](const std::string& doing, double fraction) {
      line->update(doing, fraction);
      return !stop.made();
    };
    hooks.planned = [&](const ComparePlan& plan, const State& start) {
      points = std::make_unique<PointsFile>(directory.final_name("points.jsonl"), key, before);
      if (!play) return;
      const auto page = make_side_by_side(*play, scene, study.engine, plan, start, invocation.command_line,
                                          [&](double) { return hooks.proceed("flying side by side", 0.05); });
      if (!page) return;  // the study is about to stop too
      write_product(directory, side_by_side_file, page->html);
      if (options.quiet) return;
      line.reset();  // where it stood, the sentence stands
      fmt::print(stderr, "carom: {}: can be watched while the study goes on{}{}\n",
                 directory.final_name(side_by_side_file).string(), page->shorter.empty() ? "" : "; ", page->shorter);
      line = std::make_unique<ProgressLine>(mode, scene);
    };
    hooks.run_done = [&](const MethodRun& run) { points->add(run); };
    hooks.cost_done = [&](const CostPoint& point) { points->add(point); };
    const Comparison comparison = compare(scene, study, hooks, before);
    if (!comparison.complete) {
      directory.discard_if_empty();
      if (comparison.runs.empty()) {
        fmt::print(stderr, "carom: {}: interrupted before the first point was finished\n", scene.source);
      } else {
        fmt::print(stderr,
                   "carom: {}: interrupted; {} points are kept in {}: the same command with --resume goes on from there\n",
                   scene.source, comparison.runs.size() + comparison.costs.size(), directory.final_name("points.jsonl").string());
      }
      return exit_interrupted;
    }
    line.reset();
    const std::string json = compare_json(comparison, scene, invocation.command_line);
    write_product(directory, "compare.csv", compare_csv(comparison));
    write_product(directory, "report.html", html_page(compare_page(comparison, scene, invocation.command_line)));
    write_product(directory, "compare.json", json + "\n");
    if (options.json) {
      fmt::print("{}\n", json);
    } else {
      fmt::print("{}", compare_text(comparison, scene, options.quiet));
      if (!options.quiet)
        fmt::print("\nFiles in {}: {}report.html, compare.json, compare.csv, points.jsonl\n", directory.path().string(),
                   play ? fmt::format("{}, ", side_by_side_file) : "");
    }
    return exit_done;
  } catch (const std::invalid_argument& error) {
    directory.discard_if_empty();
    throw UsageError(fmt::format("{}: {}", scene.source, error.what()));
  } catch (...) {
    directory.discard_if_empty();
    throw;
  }
}

}  // namespace

CompareOptions compare_options(const CompareCommandOptions& options) {
  // One step of the user's own is the short study: one start, and no other sizes and densities.
  const bool is_short = options.dts.size() == 1;
  const std::int64_t seeds = options.seeds.value_or(is_short ? 1 : 8);
  if (seeds < 1 || seeds > 10'000) throw UsageError(fmt::format("--seeds {}: it can be 1 to 10000", seeds));
  if (!(options.longest > 0.0))
    throw UsageError(fmt::format("--longest {:g}: a run takes some time; give a positive number", options.longest));
  for (const double dt : options.dts)
    if (!(dt > 0.0 && std::isfinite(dt))) throw UsageError(fmt::format("--dt {:g}: a time step must be positive and finite", dt));
  const std::string& engine = checked_engine(options.scene);
  if (engine != "auto" && engine != "fast" && engine != "general" && engine != "textbook")
    throw UsageError(fmt::format(
        "--engine {}: every precision is compared anyway; choose auto, fast, general or textbook for the scene's own run",
        engine));
  if (options.stiffness && !(*options.stiffness > 0.0 && std::isfinite(*options.stiffness)))
    throw UsageError(fmt::format("--stiffness {:g}: it must be positive and finite", *options.stiffness));
  return {.dts = options.dts,
          .seeds = static_cast<std::uint64_t>(seeds),
          .longest = options.longest,
          .engine = engine,
          .costs = !options.no_costs && !is_short,
          .stiffness = options.stiffness};
}

void check_steps(const Scene& scene, const CompareOptions& options) {
  const auto require = [&](const std::string& option, const FixedStep& step) {
    try {
      (void)make_simulation(scene, step);
    } catch (const std::invalid_argument& error) {
      throw UsageError(fmt::format("{}: {}", option, error.what()));
    }
  };
  // The longest step, since what is wrong with a step is that it is too long. Springs need one that is short enough.
  const std::vector<double>& dts = options.dts;
  if (!dts.empty()) {
    const double longest = *std::max_element(dts.begin(), dts.end());
    require(fmt::format("--dt {:g}", longest), {"grid", longest});
  }
  if (!options.stiffness) return;
  const double shortest =
      dts.empty() ? std::min(1.0, 0.1 * detail::stable_step(make_simulation(scene).disks(), scene.effects, *options.stiffness))
                  : *std::min_element(dts.begin(), dts.end());
  require(fmt::format("--stiffness {:g}", *options.stiffness), {"soft", shortest, options.stiffness});
}

ExitCode compare(const CompareCommandOptions& options, const Invocation& invocation) {
  try {
    return options.trajectory ? compare_own(options) : compare_scene(options, invocation);
  } catch (const std::bad_alloc&) {
    throw std::runtime_error(
        fmt::format("{}: there is not enough memory to keep this scene in 113 bits at every sample; fewer disks need less",
                    options.scene.path));
  }
}

}  // namespace carom::cli
