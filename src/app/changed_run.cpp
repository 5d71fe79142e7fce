// carom run SCENE --changes FILE: a run that was changed while it went on, again.

#include "app/commands.hpp"
#include "io/csv_writer.hpp"
#include "io/json.hpp"
#include "io/run_directory.hpp"
#include "live/live_run.hpp"
#include "scene/checks.hpp"
#include "scene/refusal.hpp"
#include "terminal/signals.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <carom/simulation.hpp>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace carom::cli {

namespace {

/// A run with changes can be repeated and sampled; what only a run of one scene has is refused.
void require_only_what_it_has(const RunOptions& options) {
  const auto refuse = [](bool is_given, const char* option) {
    if (is_given) throw UsageError(fmt::format("--changes and {} do not go together; leave out one of the two", option));
  };
  refuse(options.method != "exact", "--method");
  refuse(options.dt.has_value(), "--dt");
  refuse(options.stiffness.has_value(), "--stiffness");
  refuse(options.pace.has_value(), "--pace");
  refuse(options.scene.engine != "auto", "--engine");
  refuse(options.verify.has_value(), "--verify");
  refuse(options.verify_horizon, "--verify-horizon");
  refuse(options.report, "--report");
  refuse(options.watch, "--watch");
  refuse(options.checkpoint_every.has_value(), "--checkpoint-every");
  refuse(options.walltime.has_value(), "--walltime");
  refuse(options.threads != "auto", "--threads");
  refuse(options.scene.xyz, "--xyz");
  refuse(options.scene.events, "--events");
  refuse(options.scene.unwrapped, "--unwrapped");
}

/// Names what the scene and the list of changes ask for and such a run has not.
std::vector<std::string> left_out(const Scene& scene, const std::vector<Change>& changes, double end) {
  std::vector<std::string> names;
  if (scene.run.collisions) names.emplace_back("run.collisions");
  if (!scene.observe.empty()) names.emplace_back("[observe]");
  if (scene.output.csv && !scene.run.sample_every) names.emplace_back("output.csv, which needs run.sample_every");
  if (scene.output.xyz) names.emplace_back("output.xyz");
  if (scene.output.events) names.emplace_back("output.events");
  const auto late = std::count_if(changes.begin(), changes.end(), [end](const Change& change) { return change.time > end; });
  if (late > 0) names.push_back(counted(static_cast<std::size_t>(late), "change") + " after the end");
  return names;
}

/// samples.csv, one line per disk and sample: the number of disks may change on the way.
class Samples {
 public:
  Samples(const RunOptions& options, const Scene& scene)
      : directory_(as_usage_error([&] {
          const bool is_named = !options.out.empty();
          return RunDirectory(is_named ? std::filesystem::path(options.out) : std::filesystem::path(options.scene.path).stem(),
                              options.force);
        })),
        writer_(directory_.partial_name(file), scene.effects.collision.roughness.has_value()),
        step_(*scene.run.sample_every) {}

  [[nodiscard]] double next() const { return static_cast<double>(taken_) * step_; }
  void take(const LiveRun& run) {
    run.state(state_);
    writer_.sample(state_);
    ++taken_;
  }
  void finish() {
    writer_.close();
    directory_.publish(file);
  }
  /// Removes what was written, because the list of changes is wrong.
  void discard() {
    std::error_code ignored;
    std::filesystem::remove(directory_.partial_name(file), ignored);
    directory_.discard_if_empty();
  }
  [[nodiscard]] std::string path() const { return directory_.final_name(file).string(); }

 private:
  static constexpr const char* file = "samples.csv";

  RunDirectory directory_;
  CsvWriter writer_;
  double step_;
  std::uint64_t taken_ = 0;
  State state_;
};

/// Makes a change of `file`, which lasts `until` then. Throws UsageError where it cannot be made, or not for so long.
void make(LiveRun& run, const Change& change, double until, const std::string& file) {
  const auto refuse = [&](const std::exception& error) {
    throw UsageError(fmt::format("{}: the change at time {:g} cannot be made: {}", file, change.time, error.what()));
  };
  try {
    run.apply(change);
    Scene changed = run.simulation().scene();
    changed.run.time = std::max(0.0, until - change.time);
    detail::check_scales(changed);
  } catch (const SceneError& error) {
    refuse(error);
  } catch (const detail::Refusal& error) {
    refuse(error);
  } catch (const std::invalid_argument& error) {
    refuse(error);
  }
}

/// Runs to `end` with the changes of `file` on the way; returns why it stopped before, or `time`.
StopReason run_to(LiveRun& run, double end, const std::vector<Change>& changes, const std::string& file, Samples* samples) {
  const StopRequest stop;
  auto change = changes.begin();
  for (;;) {
    double target = end;
    if (change != changes.end()) target = std::min(target, change->time);
    if (samples != nullptr) target = std::min(target, samples->next());
    constexpr std::uint64_t events_at_once = 1'000'000;  // a signal waits for no more
    const StopReason stopped = run.run_until(target, events_at_once);
    if (stop.made()) return StopReason::interrupted;
    if (stopped == StopReason::events) continue;
    if (stopped != StopReason::time) return stopped;
    if (samples != nullptr && samples->next() <= target) samples->take(run);
    if (change != changes.end() && change->time <= target) {
      const auto next = std::next(change);
      make(run, *change, next == changes.end() ? end : std::min(end, next->time), file);
      change = next;
    }
    const bool done = (change == changes.end() || change->time > end) && (samples == nullptr || samples->next() > end);
    if (target >= end && done) return StopReason::time;
  }
}

}  // namespace

ExitCode run_with_changes(const RunOptions& options) {
  require_only_what_it_has(options);
  const Scene scene = load(options.scene);
  if (!scene.run.time)
    throw UsageError(fmt::format("{}: a run with --changes ends at a time; give the scene a run.time", options.scene.path));
  const std::vector<Change> changes = load_changes(options.changes);
  LiveRun run(scene);
  std::optional<Samples> samples;
  if (scene.output.csv && scene.run.sample_every) samples.emplace(options, scene);
  StopReason stopped = StopReason::time;
  try {
    stopped = run_to(run, *scene.run.time, changes, options.changes, samples ? &*samples : nullptr);
  } catch (const UsageError&) {
    if (samples) samples->discard();
    throw;
  }
  if (samples) samples->finish();
  const std::vector<std::string> missing = left_out(scene, changes, *scene.run.time);

  const std::size_t made = run.changes().size();
  if (options.json) {
    detail::Json json{{"scene", options.scene.path}, {"changes", options.changes}, {"changes_made", made}};
    json["stopped"] = to_string(stopped);
    json["time"] = run.time();
    json["disks"] = run.simulation().disks().count();
    json["pair_collisions"] = run.pairs();
    json["wall_collisions"] = run.walls();
    json["obstacle_collisions"] = run.obstacles();
    json["state_hash"] = run.hash();
    json["left_out"] = missing;
    fmt::print("{}\n", json.dump(2));
  } else if (!options.quiet) {
    fmt::print("{} with {} of {}\n", options.scene.path, counted(made, "change"), options.changes);
    fmt::print("  {:<12}{}, at time {:.6g}\n", "ended by", to_string(stopped), run.time());
    fmt::print("  {:<12}{} of {}, {} with walls and obstacles\n", "events", counted(run.pairs(), "collision"),
               counted(run.simulation().disks().count(), "disk"), grouped(run.walls() + run.obstacles()));
    if (samples) fmt::print("  {:<12}{}\n", "files", samples->path());
    fmt::print("  {:<12}{}\n", "state hash", run.hash());
    if (!missing.empty()) fmt::print("  {:<12}{}\n", "left out", fmt::join(missing, ", "));
  }
  return stopped == StopReason::interrupted ? exit_interrupted : exit_done;
}

}  // namespace carom::cli
