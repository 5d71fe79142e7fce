// carom bench: how fast this machine is, in the rows of the table in docs/performance.md. Both engines run the same scenes
// in turns, so that what disturbs the machine disturbs both, and no speed is shown whose answer is wrong.

#include "studies/benchmark/command.hpp"
#include "core/instructions.hpp"
#include "io/json.hpp"
#include "studies/benchmark/timed_engine.hpp"
#include "studies/machine.hpp"
#include "terminal/progress.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>
#include <carom/version.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace carom::cli {

namespace {

using Json = nlohmann::ordered_json;

constexpr double packing_fractions[] = {0.3, 0.6, 0.7};
constexpr int turns = 5;

/// Collisions in a turn of the textbook engine: a few tenths of a second on machines of today.
constexpr std::uint64_t usual_turn = 200'000;

struct Runner {
  const char* engine;
  std::uint64_t share;  ///< so many times the collisions: turns of about one length
};
constexpr Runner runners[] = {{"fast", 4}, {"textbook", 1}};

/// Times both engines on one scene, in turns.
std::vector<TimedEngine> time_in_turns(std::int64_t disks, double packing_fraction, std::uint64_t turn,
                                       const StatusLine& status) {
  const Scene scene = bench_scene(disks, packing_fraction);
  const std::string what =
      fmt::format("{} at packing fraction {}", counted(static_cast<std::uint64_t>(disks), "disk"), packing_fraction);
  std::vector<TimedEngine> engines;
  engines.reserve(std::size(runners));
  for (const Runner& runner : runners) {
    status.show(fmt::format("{}: {} runs up", what, runner.engine));
    // At least 20 collisions of every disk, after which the lattice of the start is gone from a fluid.
    engines.emplace_back(scene, runner.engine, std::max(10 * static_cast<std::uint64_t>(disks), runner.share * turn));
  }
  for (int k = 1; k <= turns; ++k) {
    status.show(fmt::format("{}: turn {} of {}", what, k, turns));
    for (std::size_t c = 0; c < engines.size(); ++c) engines[c].take_turn(runners[c].share * turn);
  }
  status.show("");
  return engines;
}

Json json_of(const TimedEngine& engine) {
  const Totals totals = engine.totals();
  const auto pairs = static_cast<double>(totals.pair);
  const auto [slowest, fastest] = std::minmax_element(engine.rates().begin(), engine.rates().end());
  const std::optional<double> bytes = engine.bytes_per_disk();
  return {{"collisions_per_second", engine.median_rate()},
          {"slowest_turn", *slowest},
          {"fastest_turn", *fastest},
          {"collisions", totals.pair},
          {"stale_per_collision", static_cast<double>(totals.stale) / pairs},
          {"other_per_collision", static_cast<double>(totals.other) / pairs},
          {"bytes_per_disk", bytes ? Json(*bytes) : Json(nullptr)},
          {"Z", engine.compressibility()},
          {"relative_energy_drift", engine.energy_drift()}};
}

void print_heading() {
  fmt::print("{}\n\n", measured_on());
  fmt::print(
      "Pair collisions per second on one core, smooth equal disks in a periodic box; memory per disk, fast and textbook:\n\n"
      "| packing fraction |         N |     fast | textbook | ratio | bytes per disk |\n"
      "|------------------|-----------|----------|----------|-------|----------------|\n");
  std::fflush(stdout);
}

void print_row(std::int64_t disks, double packing_fraction, const TimedEngine& fast, const TimedEngine& textbook) {
  const auto bytes = [](const TimedEngine& engine) {
    const std::optional<double> number = engine.bytes_per_disk();
    return number ? fmt::format("{:.0f}", *number) : "?";
  };
  fmt::print("| {:<16} | {:>9} | {:>6.2f}e6 | {:>6.2f}e6 | {:>5.1f} | {:>14} |\n", packing_fraction,
             grouped(static_cast<std::uint64_t>(disks)), fast.median_rate() / 1e6, textbook.median_rate() / 1e6,
             fast.median_rate() / textbook.median_rate(), fmt::format("{}, {}", bytes(fast), bytes(textbook)));
  std::fflush(stdout);
}

std::vector<std::int64_t> sizes(const BenchOptions& options) {
  if (options.collisions == 0) throw UsageError("--collisions 0: a speed needs some collisions");
  std::vector<std::int64_t> disks = options.disks;
  if (disks.empty()) disks = {1'000, 10'000, 100'000};
  if (options.large) disks.push_back(1'000'000);
  for (const std::int64_t n : disks) {
    if (n < 16 || n > 100'000'000) throw UsageError(fmt::format("--disks {}: it can be 16 to 100,000,000", n));
  }
  return disks;
}

}  // namespace

ExitCode bench(const BenchOptions& options) {
  if (options.threads) return bench_threads(options);
  if (options.effects) return bench_effects(options);
  const std::vector<std::int64_t> all_disks = sizes(options);
  const StatusLine status;
  Json json = measured_on_json();
  json["turns"] = turns;
  json["rows"] = Json::array();
  json["failed"] = Json::array();
  if (!options.json) print_heading();
  for (const double packing_fraction : packing_fractions) {
    for (const std::int64_t disks : all_disks) {
      const std::uint64_t turn = options.collisions.value_or(std::max(usual_turn, static_cast<std::uint64_t>(disks)));
      const std::vector<TimedEngine> engines = time_in_turns(disks, packing_fraction, turn, status);
      bool right = true;
      for (const TimedEngine& engine : engines) {
        const std::string fault = engine.fault();
        if (fault.empty()) continue;
        right = false;
        json["failed"].push_back(fault);
        fmt::print(stderr, "carom: {}; its speed says nothing\n", fault);
      }
      if (!right) continue;
      Json row = {{"packing_fraction", packing_fraction},
                  {"disks", disks},
                  {"ratio", engines[0].median_rate() / engines[1].median_rate()}};
      for (const TimedEngine& engine : engines) row[engine.engine()] = json_of(engine);
      json["rows"].push_back(row);
      if (!options.json) print_row(disks, packing_fraction, engines[0], engines[1]);
    }
  }
  if (options.json) fmt::print("{}\n", json.dump(2));
  return json["failed"].empty() ? exit_done : exit_check_failed;
}

std::string measured_on() {
  const BuildInfo& build = build_info();
  const std::optional<std::size_t> cache = second_level_cache();
  return fmt::format("{}{}; carom {} (commit {}; {}; {}), {} instructions.", processor(),
                     cache ? fmt::format(", {} KiB of second-level cache", *cache / 1024) : "", build.version, build.commit,
                     build.compiler, build.flags, name_of(chosen_instructions()));
}

nlohmann::ordered_json measured_on_json() {
  const std::optional<std::size_t> cache = second_level_cache();
  return {{"carom", detail::build_json()},
          {"machine", {{"processor", processor()}, {"second_level_cache", cache ? Json(*cache) : Json(nullptr)}}},
          {"instructions", name_of(chosen_instructions())}};
}

}  // namespace carom::cli
