// The tables [run] and [output].

#include "scene/read_tables.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace carom::detail {
namespace {

Run::Equilibrate read_equilibrate(const toml::table& node) {
  const TableReader table(node, "run.equilibrate", {"collisions_per_disk", "time"});
  Run::Equilibrate equilibrate;
  equilibrate.collisions_per_disk = table.number("collisions_per_disk", Range::zero_or_more, "{ collisions_per_disk = 50 }");
  equilibrate.time = table.number("time", Range::zero_or_more, "{ time = 2.0 }");
  if (equilibrate.collisions_per_disk.has_value() == equilibrate.time.has_value()) {
    throw SceneError(table.where(),
                     fmt::format("run.equilibrate has {}; give exactly one, {{ collisions_per_disk = 50 }} or {{ time = "
                                 "2.0 }}",
                                 equilibrate.time ? "both collisions_per_disk and time" : "neither of its keys"));
  }
  return equilibrate;
}

/// Sample numbers are exact in double precision only below 2^53; k * sample_every needs them exact.
void check_sample_count(const TableReader& table, const char* key, double samples, double step, double time) {
  constexpr double most = 9007199254740992.0;
  if (samples < most) return;
  throw SceneError(table.where(key), fmt::format("{} = {} asks for {:.3g} samples up to time {}; there can be "
                                                 "at most 2^53, so make it larger",
                                                 table.path(key), step, samples, time));
}

/// A time, or { collisions = 1000 }, or false.
void read_sample_every(const TableReader& table, Run& run) {
  const toml::node* node = table.find("sample_every");
  if (node == nullptr) return;
  if (node->is_boolean() && !node->as_boolean()->get()) return;
  if (!node->is_table() && !node->is_number())
    refuse(*node, "run.sample_every",
           "a time above zero, a number of collisions, or false, such as sample_every = 0.001 or "
           "sample_every = { collisions = 1000 }");
  if (!node->is_table()) {
    run.sample_every = table.number("sample_every", Range::above_zero, "sample_every = 0.001");
    return;
  }
  const TableReader counted(*node->as_table(), "run.sample_every", {"collisions"});
  const std::string example = "sample_every = { collisions = 1000 }";
  const std::int64_t collisions =
      read_integer(counted.require("collisions", "give " + example), "run.sample_every.collisions", example);
  if (collisions == 0)
    throw SceneError(counted.where("collisions"),
                     "run.sample_every.collisions is 0; it must be a whole number above zero, such as " + example);
  run.sample_every_collisions = static_cast<std::uint64_t>(collisions);
}

SampleLog read_sample_log(const toml::table& node, const Run& run) {
  constexpr std::int64_t most_per_block = 100'000;
  constexpr double blocks = 10.0;  // of a run whose scene does not say how long they are
  const TableReader table(node, "run.sample_log", {"base", "per_block", "block"});
  const std::string example = "sample_log = { base = 1.3, per_block = 50 }";
  SampleLog log;
  (void)table.require("base", "give the ratio of one time in a block to the one before it, " + example);
  log.base = *table.number_between("base", least_log_base, most_log_ratio, example);
  log.per_block = read_integer(table.require("per_block", "give the number of samples in a block, " + example),
                               "run.sample_log.per_block", example);
  if (log.per_block < 2 || log.per_block > most_per_block)
    throw SceneError(table.where("per_block"),
                     fmt::format("run.sample_log.per_block is {}; it must be a whole number from 2 to {}, such as {}",
                                 log.per_block, most_per_block, example));
  const double ratio = std::pow(log.base, static_cast<double>(log.per_block - 1));
  if (ratio > most_log_ratio)
    throw SceneError(
        table.where(),
        fmt::format("run.sample_log divides a block by {}^{} = {:.3g}; more than {:.0e} cannot be told apart, so make "
                    "base or per_block smaller",
                    log.base, log.per_block - 1, ratio, most_log_ratio));
  if (const auto block = table.number("block", Range::above_zero, "block = 100.0")) {
    log.block = *block;
  } else if (run.time && *run.time / blocks > 0.0) {
    log.block = *run.time / blocks;
  } else {
    throw SceneError(table.where(),
                     "run.sample_log needs the length of a block where the run has no time, such as block = 100.0");
  }
  if (run.time)
    check_sample_count(table, "block", std::floor(*run.time / log.block) * static_cast<double>(log.per_block), log.block,
                       *run.time);
  return log;
}

}  // namespace

Run read_run(const toml::table& node) {
  const TableReader table(
      node, "run",
      {"time", "collisions", "sample_every", "sample_log", "equilibrate", "seed", "keep_momentum", "accept_overlap"});
  Run run;
  run.time = table.number("time", Range::zero_or_more, "time = 5.0");
  if (const auto collisions = table.integer("collisions", "collisions = 1_000_000")) {
    run.collisions = static_cast<std::uint64_t>(*collisions);
  }
  if (!run.time && !run.collisions) {
    throw SceneError(table.where(),
                     "[run] says neither how long nor how many collisions; give time = 5.0, collisions = 1_000_000, or both");
  }
  read_sample_every(table, run);
  if (run.time && run.sample_every)
    check_sample_count(table, "sample_every", std::floor(*run.time / *run.sample_every), *run.sample_every, *run.time);
  if (const toml::table* log = table.table("sample_log", "{ base = 1.3, per_block = 50 }")) {
    if (run.sample_every || run.sample_every_collisions)
      throw SceneError(table.where("sample_log"),
                       "[run] has both sample_every and sample_log; give one of them, even steps or logarithmic blocks");
    run.sample_log = read_sample_log(*log, run);
  }
  if (const toml::table* equilibrate = table.table("equilibrate", "{ collisions_per_disk = 50 }")) {
    run.equilibrate = read_equilibrate(*equilibrate);
  }
  run.seed = static_cast<std::uint64_t>(table.integer("seed", "seed = 1").value_or(1));
  run.keep_momentum = table.on_or_off("keep_momentum").value_or(false);
  run.accept_overlap = table.on_or_off("accept_overlap").value_or(false);
  return run;
}

Output read_output(const toml::table* node, bool sampled) {
  Output output;
  output.trajectory = sampled;
  if (node == nullptr) return output;
  const TableReader table(*node, "output", {"trajectory", "xyz", "csv", "events", "unwrapped"});
  const auto of_samples = [&](const char* key, bool otherwise) {
    const bool wanted = table.on_or_off(key).value_or(otherwise);
    if (wanted && !sampled) {
      throw SceneError(
          table.where(key),
          fmt::format("{} = true needs samples; give sample_every in [run], such as sample_every = 0.001", table.path(key)));
    }
    return wanted;
  };
  output.trajectory = of_samples("trajectory", sampled);
  output.xyz = of_samples("xyz", false);
  output.csv = of_samples("csv", false);
  output.unwrapped = of_samples("unwrapped", false);
  output.events = table.on_or_off("events").value_or(false);
  return output;
}

}  // namespace carom::detail
