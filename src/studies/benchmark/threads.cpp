// carom bench --threads: one run on several cores against the same run on one. They take turns over the same stretches of time,
// and after each turn they must have the same bits.

#include "core/seconds.hpp"
#include "studies/benchmark/command.hpp"
#include "studies/benchmark/timed_engine.hpp"
#include "terminal/progress.hpp"
#include "text/number_in.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <string>
#include <thread>
#include <vector>

namespace carom::cli {

namespace {

using Json = nlohmann::ordered_json;

constexpr int turns_on_cores = 5;
constexpr std::uint64_t fewest_collisions_on_cores = 1'000'000;  ///< in a turn: some tenths of a second
constexpr std::int64_t usual_disks_on_cores = 100'000;
constexpr double latest_on_cores = 1e15;

/// Returns the number of threads that compute at the same time here. More domains than these take turns, each for a whole window:
/// threads that share a processor would interrupt each other, and find the caches full of what others need.
std::size_t processors() { return std::max<std::size_t>(std::thread::hardware_concurrency(), 1); }

/// What one turn of both has taken, in seconds.
struct TurnOnCores {
  double alone_wall = 0.0, shared_wall = 0.0;
  double alone_processor = 0.0;
  double shared_processor = 0.0;  ///< of all threads, without what they wait for each other
  double critical = 0.0;          ///< what would pass with a free processor for each thread
  std::uint64_t collisions = 0;
};

/// Times a run on one core and the same run on several, in turns of the same simulated time.
class CoresTiming {
 public:
  CoresTiming(const Scene& scene, int threads, std::uint64_t run_up, std::uint64_t turn)
      : alone_(make_simulation(scene)), shared_(make_simulation(scene)) {
    shared_.set_threads(
        {.threads = std::min(static_cast<std::size_t>(threads), processors()), .domains = static_cast<std::size_t>(threads)});
    for (Simulation* simulation : {&alone_, &shared_}) simulation->run_until(latest_on_cores, {.collisions = run_up});
    const double per_time = static_cast<double>(run_up) / alone_.time();
    stretch_ = static_cast<double>(turn) / per_time;
    end_ = alone_.time();
    take_turn();  // in which both find their pace, and the disks are shared out
    turns_.clear();
  }

  void take_turn() {
    end_ += stretch_;
    TurnOnCores turn;
    const std::uint64_t before = alone_.counts().pair;
    const auto alone = [&] {
      const auto began = std::chrono::steady_clock::now();
      const std::clock_t processor = std::clock();
      alone_.run_until(end_);
      turn.alone_processor = static_cast<double>(std::clock() - processor) / static_cast<double>(CLOCKS_PER_SEC);
      turn.alone_wall = seconds_since(began);
    };
    const auto shared = [&] {
      const ThreadCounts so_far = shared_.thread_counts();
      const auto began = std::chrono::steady_clock::now();
      shared_.run_until(end_);
      turn.shared_wall = seconds_since(began);
      const ThreadCounts now = shared_.thread_counts();
      turn.shared_processor = now.processor_seconds - so_far.processor_seconds;
      turn.critical = now.critical_seconds - so_far.critical_seconds;
    };
    // The order is reversed in turn: each finds the caches as the other has left them.
    const bool reversed = turns_.size() % 2 == 1;
    if (reversed) shared();
    alone();
    if (!reversed) shared();
    turn.collisions = alone_.counts().pair - before;
    turns_.push_back(turn);
  }

  /// Returns the median over the turns of a number that f(turn) is.
  template <class F>
  [[nodiscard]] double median(F&& f) const {
    std::vector<double> numbers;
    for (const TurnOnCores& turn : turns_) numbers.push_back(f(turn));
    std::sort(numbers.begin(), numbers.end());
    return numbers[numbers.size() / 2];
  }

  [[nodiscard]] bool same_bits() const { return state_hash(alone_.state()) == state_hash(shared_.state()); }
  [[nodiscard]] ThreadCounts counts() const { return shared_.thread_counts(); }
  [[nodiscard]] double memory_ratio() const { return static_cast<double>(shared_.bytes()) / static_cast<double>(alone_.bytes()); }

 private:
  Simulation alone_, shared_;
  double stretch_ = 0.0, end_ = 0.0;
  std::vector<TurnOnCores> turns_;
};

Json json_of(const CoresTiming& timing, std::int64_t disks, double packing_fraction) {
  const ThreadCounts counts = timing.counts();
  const auto ratio = [](double of, double to) { return to > 0.0 ? Json(of / to) : Json(nullptr); };
  return {{"packing_fraction", packing_fraction},
          {"disks", disks},
          {"collisions_per_second_alone",
           timing.median([](const TurnOnCores& turn) { return static_cast<double>(turn.collisions) / turn.alone_wall; })},
          {"collisions_per_second",
           timing.median([](const TurnOnCores& turn) { return static_cast<double>(turn.collisions) / turn.shared_wall; })},
          {"ratio", timing.median([](const TurnOnCores& turn) { return turn.alone_wall / turn.shared_wall; })},
          {"ratio_undisturbed", timing.median([](const TurnOnCores& turn) { return turn.alone_processor / turn.critical; })},
          {"ratio_of_processor_time",
           timing.median([](const TurnOnCores& turn) { return turn.alone_processor / turn.shared_processor; })},
          {"events_computed_twice", ratio(static_cast<double>(counts.copied_events), static_cast<double>(counts.events))},
          {"memory_ratio", timing.memory_ratio()},
          {"domains", counts.domains},
          {"windows", counts.windows},
          {"windows_redone", counts.windows_redone}};
}

void print_heading_on_cores(int threads) {
  fmt::print("{}\n\n", measured_on());
  fmt::print(
      "Millions of pair collisions per second of wall time on one core and on {0}, smooth equal disks in a periodic box; after "
      "every\n"
      "turn both have the same bits. `undisturbed`: how many times as fast {0} processors are that do nothing else, from "
      "processor\n"
      "time. Events that are computed twice; memory of {0} over that of one. Medians of {1} turns.{2}\n\n"
      "| packing fraction |         N | one core | {0:>2} cores | ratio | undisturbed | computed twice | memory |\n"
      "|------------------|-----------|----------|----------|-------|-------------|----------------|--------|\n",
      threads, turns_on_cores,
      static_cast<std::size_t>(threads) <= processors()
          ? ""
          : fmt::format("\nThis machine has {}, on which the parts of the box take turns; `ratio` is that of so many cores.",
                        counted(processors(), "processor")));
  std::fflush(stdout);
}

void print_row_on_cores(const Json& row) {
  const auto number = [&](const char* key) { return row.at(key).is_null() ? 0.0 : row.at(key).get<double>(); };
  fmt::print("| {:<16} | {:>9} | {:>8.2f} | {:>8.2f} | {:>5.2f} | {:>11.2f} | {:>12.1f} % | {:>6.2f} |\n",
             number("packing_fraction"), grouped(row.at("disks").get<std::uint64_t>()),
             number("collisions_per_second_alone") / 1e6, number("collisions_per_second") / 1e6, number("ratio"),
             number("ratio_undisturbed"), 100.0 * number("events_computed_twice"), number("memory_ratio"));
  std::fflush(stdout);
}

int threads_of(const BenchOptions& options) {
  if (options.effects) throw UsageError("--threads and --effects measure different things; give one of the two");
  if (options.collisions == 0) throw UsageError("--collisions 0: a speed needs some collisions");
  for (const std::int64_t n : options.disks)
    if (n < 16 || n > 100'000'000) throw UsageError(fmt::format("--disks {}: it can be 16 to 100,000,000", n));
  const std::string& text = *options.threads;
  if (text.empty()) return std::clamp(static_cast<int>(processors()), 2, 16);
  const std::optional<int> threads = number_in<int>(text);
  if (!threads || *threads < 2 || *threads > most_threads)
    throw UsageError(
        fmt::format("--threads {}: several are measured against one; give a number from 2 to {}", text, most_threads));
  return *threads;
}

}  // namespace

ExitCode bench_threads(const BenchOptions& options) {
  const int threads = threads_of(options);
  std::vector<std::int64_t> sizes = options.disks;
  if (sizes.empty()) sizes = {usual_disks_on_cores};
  if (options.large) sizes.push_back(1'000'000);
  const StatusLine status;
  Json json = measured_on_json();
  json["threads"] = threads;
  json["turns"] = turns_on_cores;
  json["rows"] = Json::array();
  json["failed"] = Json::array();
  if (!options.json) print_heading_on_cores(threads);
  for (const std::int64_t disks : sizes) {
    for (const double packing_fraction : {0.3, 0.6, 0.7}) {
      const auto count = static_cast<std::uint64_t>(disks);
      const std::string what = fmt::format("{} at packing fraction {}", counted(count, "disk"), packing_fraction);
      status.show(fmt::format("{}: both run up", what));
      const std::uint64_t turn = options.collisions.value_or(std::max(fewest_collisions_on_cores, 2 * count));
      CoresTiming timing(bench_scene(disks, packing_fraction), threads, 10 * count, turn);
      for (int k = 1; k <= turns_on_cores && timing.same_bits(); ++k) {
        status.show(fmt::format("{}: turn {} of {}", what, k, turns_on_cores));
        timing.take_turn();
      }
      status.show("");
      if (!timing.same_bits()) {
        json["failed"].push_back(fmt::format("{}: {} threads have other bits than one", what, threads));
        fmt::print(stderr, "carom: {}: {} threads have other bits than one; their speed says nothing\n", what, threads);
        continue;
      }
      json["rows"].push_back(json_of(timing, disks, packing_fraction));
      if (!options.json) print_row_on_cores(json["rows"].back());
    }
  }
  if (options.json)
    fmt::print("{}\n", json.dump(2));
  else
    fmt::print(
        "\nThreads wait for each other several hundred times a second. Where other programs use the processors too, they can be "
        "slower\n"
        "than one: `ratio` is then far below `undisturbed`, and --threads 1 is the better choice.\n");
  return json["failed"].empty() ? exit_done : exit_check_failed;
}

}  // namespace carom::cli
