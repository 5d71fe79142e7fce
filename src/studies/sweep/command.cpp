// carom sweep SWEEP: many runs of one scene, each in a process and a directory of its own, on the threads of one machine or under
// mpirun on many; then one table of all finished runs. The same command continues a sweep that was interrupted or killed: its
// only state is the files that are there.

#include "studies/sweep/command.hpp"
#include "io/observable_output.hpp"
#include "studies/study_directory.hpp"
#include "studies/sweep/child_runs.hpp"
#include "studies/sweep/products.hpp"
#include "studies/sweep/ranks.hpp"
#include "studies/sweep/results.hpp"
#include "studies/sweep/seed_tables.hpp"
#include "studies/sweep/sweep.hpp"
#include "studies/sweep/text.hpp"
#include "terminal/processes.hpp"
#include "text/numbers.hpp"

#include <carom/pages/page.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <future>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace carom::cli {

namespace fs = std::filesystem;

namespace {

int threads_for(const SweepCommandOptions& options, bool of_several) {
  constexpr int most = 4096;
  if (options.threads && (*options.threads < 1 || *options.threads > most))
    throw UsageError(fmt::format("--threads {}: it can be 1 to {}", *options.threads, most));
  return options.threads.value_or(of_several ? 1 : std::max(1, static_cast<int>(std::thread::hardware_concurrency())));
}

fs::path directory_for(const SweepCommandOptions& options) {
  const fs::path directory = options.out.empty() ? fs::path(options.path).stem() : fs::path(options.out);
  std::error_code error;
  if (fs::exists(directory / "summary.json", error))
    throw UsageError(fmt::format("{}: this directory holds the results of a run, not of a sweep; name another one with --out",
                                 directory.string()));
  return directory;
}

/// The runs that are not finished. Throws UsageError where results of something else are in the way.
std::vector<std::size_t> runs_to_do(const Sweep& sweep, const fs::path& directory, bool force) {
  std::vector<std::size_t> runs;
  for (std::size_t run = 0; run < sweep.run_count(); ++run) {
    const fs::path place = directory / sweep.directory_of(run);
    const RunState state = find_run(place, [&] { return resolved_toml(sweep.scene_of(run)); }).state;
    if (state == RunState::other && !force)
      throw UsageError(fmt::format(
          "{}: this directory holds a run of another scene than {} now asks for; replace such runs with --force, or name another "
          "directory with --out",
          place.string(), sweep.source));
    if (state != RunState::finished) runs.push_back(run);
  }
  return runs;
}

/// Hands out runs, in the order of the sweep, until there are no more or it is to stop. Any thread may ask.
class RunDispatcher {
 public:
  RunDispatcher(const Sweep& sweep, const fs::path& directory, const std::vector<std::size_t>& runs, const StopRequest& stop,
                SweepProgress& progress, std::string checkpoint_every)
      : sweep_(sweep),
        directory_(directory),
        runs_(runs),
        stop_(stop),
        progress_(progress),
        checkpoint_every_(std::move(checkpoint_every)) {}

  [[nodiscard]] RunSource source() {
    return {.next = [this] { return next(); },
            .done =
                [this](const RunOrder& order, const RunOutcome& outcome) {
                  progress_.ended(outcome);
                  if (failure_.empty() && !outcome.failure.empty()) failure_ = order.directory.string() + ": " + outcome.failure;
                }};
  }
  /// Returns what went wrong in the first run that failed; empty where none did.
  [[nodiscard]] const std::string& failure() const { return failure_; }

 private:
  std::optional<RunOrder> next() {
    const std::scoped_lock lock(mutex_);
    if (stop_.made() || at_ == runs_.size()) return {};
    const std::size_t run = runs_[at_++];
    progress_.begun();
    return RunOrder{.run = run,
                    .directory = directory_ / sweep_.directory_of(run),
                    .scene = resolved_toml(sweep_.scene_of(run)),
                    .checkpoint_every = checkpoint_every_};
  }

  std::mutex mutex_;
  const Sweep& sweep_;
  const fs::path& directory_;
  const std::vector<std::size_t>& runs_;
  const StopRequest& stop_;
  SweepProgress& progress_;
  std::string checkpoint_every_;
  std::string failure_;
  std::size_t at_ = 0;
};

void run_all(RunDispatcher& dispatcher, int threads, SweepServer* server, const StopRequest& stop, SweepProgress& progress) {
  const RunSource source = dispatcher.source();
  const auto work = [&](const RunOrder& order) {
    return carry_out(order, stop, [&] {
      progress.tick();
      return true;
    });
  };
  if (server == nullptr) {
    run_in_threads(threads, source, work);
    return;
  }
  auto here = std::async(std::launch::async, [&] { run_in_threads(threads, source, work); });
  const auto done_here = [&] { return here.wait_for(std::chrono::seconds(0)) == std::future_status::ready; };
  server->serve(source, done_here, [&] { return stop.made(); });
  here.get();
}

/// Says which points are left out, because they are there already.
void tell_of_repeated_points(const Sweep& sweep) {
  if (sweep.repeated.empty()) return;
  constexpr std::size_t most = 10;
  std::vector<std::string> names;
  for (const RepeatedPoint& point : sweep.repeated)
    if (names.size() < most) names.push_back(fmt::format("{} (as {})", point.name, point.of));
  const std::size_t more = sweep.repeated.size() - names.size();
  fmt::print(stderr, "carom: {}: points whose scenes are there already are left out: {}{}\n", sweep.source,
             fmt::join(names, ", "), more == 0 ? "" : fmt::format(" and {} more", more));
}

/// Warns of numbers that were asked for and that no run has.
void warn_of_absent_numbers(const Sweep& sweep, const SweepResults& results) {
  if (results.count(RunState::finished) == 0) return;
  for (std::size_t k = 0; k < sweep.table.size(); ++k) {
    bool there = false;
    for (const auto& averages : results.averages) there = there || averages[k].mean.has_value();
    if (!there) fmt::print(stderr, "carom: {}: no run has the number \"{}\" of the table\n", sweep.source, sweep.table[k]);
  }
}

/// Says which tables have no mean over the seeds: of each, once.
void warn_of_tables(const Sweep& sweep, const std::vector<SeedTable>& tables) {
  std::set<std::string> told;
  for (const SeedTable& one : tables)
    if (!one.fault.empty() && told.insert(one.table.name).second)
      fmt::print(stderr, "carom: {}: the table {} of {} has no mean over seeds: {}\n", sweep.source, one.table.name,
                 sweep.points[one.point].name, one.fault);
}

ExitCode sweep_scene(const SweepCommandOptions& options, const Invocation& invocation, SweepServer* server) {
  const ProgressMode mode = progress_mode(options.progress, options.quiet);
  const int threads = threads_for(options, server != nullptr);
  if (!options.checkpoint_every.empty()) (void)read_option("--checkpoint-every", options.checkpoint_every, saving_plan);
  const Sweep sweep = load_sweep(options.path, options.overrides);
  const fs::path path = directory_for(options);
  tell_of_repeated_points(sweep);
  if (options.list) {
    fmt::print("{}", commands_of(sweep, runs_to_do(sweep, path, options.force), path, invocation));
    return exit_done;
  }
  (void)runs_to_do(sweep, path, options.force);  // whatever is in the way is said before anything is written
  const StopRequest stop;
  const RunDirectory directory = open_study(path, false, true, {}, LockHolder::process_and_children);
  const std::vector<std::size_t> runs = runs_to_do(sweep, path, options.force);
  std::string failure;
  {
    SweepProgress progress(mode, sweep.run_count(), sweep.run_count() - runs.size());
    RunDispatcher dispatcher(sweep, path, runs, stop, progress, options.checkpoint_every);
    run_all(dispatcher, std::min(threads, std::max(1, static_cast<int>(runs.size()))), server, stop, progress);
    failure = dispatcher.failure();
  }
  const SweepResults results = collect(sweep, path);
  write_product(directory, "runs.csv", runs_csv(sweep, results));
  write_product(directory, "sweep.h5", sweep_hdf5(sweep, results));
  const std::vector<SeedTable> tables = seed_tables_of(sweep, results, path);
  for (const SeedTable& one : tables)
    if (one.fault.empty())
      write_product(directory, (fs::path(sweep.points[one.point].name) / table_file(one.table)).string(), seed_table_csv(one));
  write_product(directory, "report.html", html_page(sweep_page(sweep, results, tables)));
  write_product(directory, "columns.csv", columns_csv(sweep, results));
  write_product(directory, "sweep.csv", points_csv(sweep, results));
  if (options.json) fmt::print("{}\n", sweep_json(sweep, results));
  if (!options.quiet && !options.json) fmt::print("{}", sweep_text(sweep, results, path));
  warn_of_absent_numbers(sweep, results);
  warn_of_tables(sweep, tables);
  if (results.versions.size() > 1)
    fmt::print(stderr, "carom: {}: these runs were made by {} versions of carom; report.html names them\n", sweep.source,
               results.versions.size());
  const std::size_t finished = results.count(RunState::finished), failed = results.count(RunState::failed);
  // A failure that no file tells of, because none can be written there.
  const bool is_untold = finished + failed < sweep.run_count() && !stop.made() && failed == 0 && !failure.empty();
  if (is_untold) {
    fmt::print(stderr, "carom: {}: {} of {} runs are finished; {}\n", sweep.source, finished, sweep.run_count(), failure);
    return exit_failed;
  }
  if (finished + failed < sweep.run_count()) {
    fmt::print(stderr, "carom: {}: interrupted; {} of {} runs are finished, and the same command goes on from there\n",
               sweep.source, finished, sweep.run_count());
    return stop.made() || failed == 0 ? exit_interrupted : exit_failed;
  }
  if (failed == 0) return exit_done;
  fmt::print(stderr, "carom: {}: {} of {} runs failed, as runs.csv says; the same command tries them again\n", sweep.source,
             failed, sweep.run_count());
  return exit_failed;
}

}  // namespace

ExitCode sweep(const SweepCommandOptions& options, const Invocation& invocation) {
  const Launch started = launch();
  std::unique_ptr<Processes> ranks;
  try {
    ranks = join_processes(started);
  } catch (const UsageError&) {
    if (started.rank > 0) return exit_done;  // the first one says it
    throw;
  }
  if (ranks == nullptr) return sweep_scene(options, invocation, nullptr);
  if (ranks->rank() > 0) return work_for_first_rank(*ranks, std::max(1, options.threads.value_or(1)));
  SweepServer server(*ranks);
  return sweep_scene(options, invocation, &server);
}

}  // namespace carom::cli
