// The [run] table: samples that can be counted, and an end that can be reached. A run that says neither how long nor how many
// collisions is one that a program steers itself: the reader of files and run_schedule() refuse it.

#include "scene/checks.hpp"
#include "scene/number_keys.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <limits>

namespace carom::detail {
namespace {

constexpr std::int64_t most_per_block = 100'000;

void check_sample_log(const SampleLog& log) {
  if (log.per_block < 2 || log.per_block > most_per_block)
    throw Refusal("run.sample_log.per_block",
                  fmt::format("run.sample_log.per_block is {}; it must be a whole number from 2 to {}, such as {}", log.per_block,
                              most_per_block, keys::log_example));
  const double ratio = std::pow(log.base, static_cast<double>(log.per_block - 1));
  if (ratio > most_log_ratio)
    throw Refusal("run.sample_log",
                  fmt::format("run.sample_log divides a block by {}^{} = {:.3g}; more than {:.0e} cannot be resolved, so make "
                              "base or per_block smaller",
                              log.base, log.per_block - 1, ratio, most_log_ratio));
}

void check_samples(const Scene& scene) {
  const Run& run = scene.run;
  if (run.sample_log && (run.sample_every || run.sample_every_collisions))
    throw Refusal("run.sample_log",
                  "[run] has both sample_every and sample_log; give one of them, even steps or logarithmic blocks");
  if (run.sample_every && run.sample_every_collisions)
    throw Refusal("run.sample_every", "run.sample_every is both a time and a number of collisions; give one of them");
  if (run.sample_every_collisions == 0)
    throw Refusal(
        "run.sample_every.collisions",
        fmt::format("run.sample_every.collisions is 0; it must be a whole number above zero, such as {}", keys::counted_example));
  if (run.sample_log) check_sample_log(*run.sample_log);
  if (run.sample_every) check_step(scene, "run.sample_every", *run.sample_every);
  if (const auto& log = run.sample_log)
    check_step(scene, "run.sample_log.block", log->block, static_cast<double>(log->per_block));
}

/// A run that only counts collisions needs two disks to ever end.
void check_end(const Scene& scene) {
  const bool counts = !scene.run.time && scene.run.collisions.value_or(0) > 0;
  const bool equilibrates = scene.run.equilibrate && scene.run.equilibrate->collisions_per_disk.value_or(0.0) > 0.0;
  if (scene.disk_count() >= 2 || (!counts && !equilibrates)) return;
  const char* key = counts ? "collisions" : "equilibrate.collisions_per_disk";
  throw Refusal("run", fmt::format("run.{} waits for collisions of two disks, but the scene has {}; give a time in its place",
                                   key, scene.disk_count()));
}

/// TOML has no whole numbers beyond those of 64 bits with a sign, and the scene of a run is written into its files.
void check_whole_numbers(const Run& run) {
  const auto require_written = [](const char* path, std::uint64_t value) {
    constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
    if (value > most)
      throw Refusal(path,
                    fmt::format("{} is {}; it must be a whole number from 0 to {}, the largest of TOML", path, value, most));
  };
  require_written("run.collisions", run.collisions.value_or(0));
  require_written("run.sample_every.collisions", run.sample_every_collisions.value_or(0));
}

}  // namespace

void check_run(const Scene& scene) {
  check_whole_numbers(scene.run);
  check_samples(scene);
  if (const auto& equilibrate = scene.run.equilibrate;
      equilibrate && equilibrate->time.has_value() == equilibrate->collisions_per_disk.has_value())
    throw Refusal("run.equilibrate", fmt::format("run.equilibrate has {}; give exactly one, {} or {}",
                                                 equilibrate->time ? "both collisions_per_disk and time" : "neither of its keys",
                                                 keys::equilibrate_collisions.example, keys::equilibrate_time.example));
  check_end(scene);
}

}  // namespace carom::detail
