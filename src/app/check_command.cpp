// carom check SCENE: reads a scene, draws its initial state, and prints what would be simulated, by which engine, and at what
// cost.

#include "app/commands.hpp"
#include "app/terminal_summary.hpp"
#include "observe/mechanics.hpp"
#include "pages/scene_words.hpp"
#include "runner/expected_cost.hpp"
#include "runner/expected_memory.hpp"
#include "runner/run_threads.hpp"
#include "scene/changes.hpp"
#include "scene/drawn.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>
#include <carom/simulation.hpp>

#include <algorithm>
#include <cstdio>
#include <optional>

namespace carom::cli {

namespace {

// Drawing more disks than this takes longer than a user waits for a check.
constexpr std::int64_t most_disks_drawn = 1'000'000;

// Three coordinates of position and of velocity, and three image flags, for one disk in one frame.
constexpr double bytes_per_disk_and_frame = 6 * sizeof(double) + 3 * sizeof(std::int32_t);
// Step, time, edges of the box, energies and momenta of one frame; more where effects keep numbers of their own.
constexpr double bytes_per_frame = 24 * sizeof(double);
// Four numbers of some 18 digits and what goes with them, for one disk in one frame.
constexpr double bytes_of_text_per_disk_and_frame = 100;
// Time, disks and velocities, of which compression leaves two thirds.
constexpr double bytes_per_event = 40;

std::string start_and_engine(const Scene& scene, const Simulation& simulation) {
  const double kT = kinetic_temperature(scene.box, scene.effects, simulation.disks(), simulation.state());
  const auto bytes = static_cast<double>(simulation.bytes());
  const auto disks = static_cast<double>(scene.disk_count());
  return fmt::format(
      "  start       {}; {}; kT = {:.4g}\n"
      "  engine      {}: {}{}; {} of memory{}\n",
      start_is_drawn(scene) ? "drawn at random" : "given",
      scene.run.accept_overlap ? "overlaps are accepted" : "no disks overlap", kT, simulation.engine(),
      simulation.engine_reason(), scene.changes.empty() ? "" : ", until a change asks for more", size(bytes),
      disks > 0.0 ? fmt::format(", {:.0f} bytes per disk", bytes / disks) : "");
}

/// Changes themselves may scale velocities, and lift or lower disks in a potential.
std::string conserved_words(const Scene& scene, const Effects& whole_run) {
  std::string words = conserved(scene.box, whole_run);
  return scene.changes.empty() || words == "nothing" ? words : "between changes: " + words;
}

/// `events`: how many a log is expected to have, if that is known.
std::string files(const Scene& scene, std::optional<double> events) {
  const std::optional<std::uint64_t> samples = expected_samples(scene);
  std::string text = "  files       summary.json";
  const bool sampled = scene.run.is_sampled();
  const double frames = static_cast<double>(samples.value_or(0)), disks = static_cast<double>(scene.disk_count());
  const std::string size_of_text =
      samples ? fmt::format(" (some {})", size(frames * disks * bytes_of_text_per_disk_and_frame)) : "";
  if ((scene.output.trajectory && sampled) || scene.output.events || !scene.observe.empty()) {
    text += ", trajectory.h5md";
    if (sampled && samples && scene.output.trajectory) {
      text += fmt::format(" ({}, some {})", counted(*samples, "frame"),
                          size(frames * (disks * bytes_per_disk_and_frame + bytes_per_frame)));
    }
  }
  if (scene.output.xyz && sampled) text += ", trajectory.xyz" + size_of_text;
  if (scene.output.csv && sampled) text += ", samples.csv" + size_of_text;
  if (!scene.observe.empty()) text += ", tables of observables";
  if (scene.output.events)
    text += events ? fmt::format("; all collisions are stored, some {} in all", size(*events * bytes_per_event))
                   : fmt::format("; all collisions are stored, some {:.0f} bytes each", bytes_per_event);
  return text + "\n";
}

}  // namespace

ExitCode check(const CheckOptions& options) {
  const std::string& engine = checked_engine(options.scene);
  const Scene scene = load(options.scene);
  std::optional<Trial> trial;
  if (scene.disk_count() <= most_disks_drawn) trial.emplace(scene, engine);
  if (options.resolved) {
    fmt::print("{}", resolved_toml(scene));
    return exit_done;
  }
  if (options.quiet) return exit_done;
  const Effects whole_run = detail::effects_of_whole_run(scene);
  const std::string start =
      trial ? start_and_engine(scene, trial->simulation())
            : fmt::format("  start       not drawn: more than {} disks; `carom run` draws them\n  memory      {}\n",
                          grouped(most_disks_drawn), expected_memory(scene).words());
  fmt::print("{} is a valid scene{}\n\n", scene.source, scene.title.empty() ? "" : fmt::format(": {}", scene.title));
  fmt::print("{}  conserved   {}\n{}", describe(scene), conserved_words(scene, whole_run), start);
  std::optional<double> logged;
  if (trial) {
    const SuggestedThreads suggested = suggested_threads(trial->simulation());
    const ExpectedCost cost = trial->run();
    logged = cost.logged;
    fmt::print("  threads     {}\n  cost        {}{}\n", suggested.words, cost_words(cost),
               suggested.threads > 1 ? "; the trial had one core" : "");
  }
  fmt::print("{}", files(scene, logged));
  if (const std::string missing = absent(whole_run); !missing.empty()) fmt::print("\nNot simulated: {}.\n", missing);
  return exit_done;
}

}  // namespace carom::cli
