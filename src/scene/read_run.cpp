// The tables [run] and [output].

#include "scene/checks.hpp"
#include "scene/read_tables.hpp"

#include <fmt/format.h>

#include <string>

namespace carom::detail {
namespace {

Run::Equilibrate read_equilibrate(const toml::table& node) {
  const TableReader table(node, "run.equilibrate", {"collisions_per_disk", "time"});
  Run::Equilibrate equilibrate;
  equilibrate.collisions_per_disk = table.number(keys::equilibrate_collisions);
  equilibrate.time = table.number(keys::equilibrate_time);
  return equilibrate;
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
    run.sample_every = table.number(keys::sample_every);
    return;
  }
  const TableReader counted(*node->as_table(), "run.sample_every", {"collisions"});
  const std::string example(keys::counted_example);
  run.sample_every_collisions = static_cast<std::uint64_t>(
      read_integer(counted.require("collisions", "give " + example), "run.sample_every.collisions", example));
}

SampleLog read_sample_log(const toml::table& node, const Run& run) {
  constexpr double blocks = 10.0;  // of a run whose scene does not say how long they are
  const TableReader table(node, "run.sample_log", {"base", "per_block", "block"});
  const std::string example(keys::log_example);
  SampleLog log;
  log.base = read_number(table.require("base", "give the ratio of one time in a block to the one before it, " + example),
                         table.path("base"), keys::log_base);
  log.per_block = read_integer(table.require("per_block", "give the number of samples in a block, " + example),
                               table.path("per_block"), example);
  if (const auto block = table.number(keys::log_block)) {
    log.block = *block;
  } else if (run.time && *run.time / blocks > 0.0) {
    log.block = *run.time / blocks;
  } else {
    throw SceneError(
        table.where(),
        fmt::format("run.sample_log needs the length of a block where the run has no time, such as {}", keys::log_block.example));
  }
  return log;
}

}  // namespace

Run read_run(const toml::table& node) {
  const TableReader table(
      node, "run",
      {"time", "collisions", "sample_every", "sample_log", "equilibrate", "seed", "keep_momentum", "accept_overlap"});
  Run run;
  run.time = table.number(keys::run_time);
  if (const auto collisions = table.integer("collisions", "collisions = 1_000_000")) {
    run.collisions = static_cast<std::uint64_t>(*collisions);
  }
  if (!run.time && !run.collisions) throw Refusal("run", endless_run);
  read_sample_every(table, run);
  if (const toml::table* log = table.table("sample_log", "{ base = 1.3, per_block = 50 }"))
    run.sample_log = read_sample_log(*log, run);
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
