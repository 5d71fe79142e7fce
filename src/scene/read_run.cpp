// The tables [run] and [output].

#include "scene/read_tables.hpp"

#include <fmt/format.h>

#include <cmath>

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
void check_sample_count(const TableReader& table, const Run& run) {
  constexpr double most = 9007199254740992.0;
  const double samples = std::floor(*run.time / *run.sample_every);
  if (samples < most) return;
  throw SceneError(table.where("sample_every"),
                   fmt::format("run.sample_every = {} asks for {:.3g} samples up to time {}; there can be "
                               "at most 2^53, so make it larger",
                               *run.sample_every, samples, *run.time));
}

}  // namespace

Run read_run(const toml::table& node) {
  const TableReader table(node, "run",
                          {"time", "collisions", "sample_every", "equilibrate", "seed", "keep_momentum", "accept_overlap"});
  Run run;
  run.time = table.number("time", Range::zero_or_more, "time = 5.0");
  if (const auto collisions = table.integer("collisions", "collisions = 1_000_000")) {
    run.collisions = static_cast<std::uint64_t>(*collisions);
  }
  if (!run.time && !run.collisions) {
    throw SceneError(table.where(),
                     "[run] says neither how long nor how many collisions; give time = 5.0, collisions = 1_000_000, or both");
  }
  run.sample_every = table.number("sample_every", Range::above_zero, "sample_every = 0.001");
  if (run.time && run.sample_every) check_sample_count(table, run);
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
