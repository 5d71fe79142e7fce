#include "runner/run_threads.hpp"

#include "text/number_in.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

namespace carom {

namespace {

// Below, what domains compute twice is a fifth of the work, and windows are so short that threads mostly wait for each other.
constexpr std::int64_t fewest_disks = 50'000;

constexpr int most_suggested = 16;

[[noreturn]] void refuse_number() {
  throw std::invalid_argument(fmt::format("give auto, or a number from 1 to {}", most_threads));
}

}  // namespace

SuggestedThreads suggested_threads(const Simulation& simulation) {
  return suggested_threads(simulation, free_processors(), processors());
}

SuggestedThreads suggested_threads(const Simulation& simulation, int free, int processors) {
  if (const std::string reason = simulation.why_not_threads(); !reason.empty()) return {1, "one core: " + reason};
  const std::int64_t disks = simulation.scene().disk_count();
  if (disks < fewest_disks)
    return {1, fmt::format("one core: {} {} fewer than the {} from which on several cores pay",
                           counted(static_cast<std::uint64_t>(disks), "disk"), disks == 1 ? "is" : "are",
                           grouped(static_cast<std::uint64_t>(fewest_disks)))};
  if (processors < 2) return {1, "one core: there is no other"};
  if (free < 2) return {1, "one core: other programs keep the rest busy"};
  const int threads = std::min(free, most_suggested);
  return {threads, fmt::format("{} cores: {} of {} {} free", threads, free, processors, free == 1 ? "is" : "are")};
}

std::optional<int> threads_in(std::string_view text) {
  if (text == "auto") return std::nullopt;
  const std::optional<int> threads = number_in<int>(text);
  if (!threads || *threads < 1 || *threads > most_threads) refuse_number();
  return threads;
}

void set_threads_of_run(Simulation& simulation, std::optional<int> threads) {
  const int wanted = threads ? *threads : suggested_threads(simulation).threads;
  if (wanted < 1 || wanted > most_threads) refuse_number();
  const std::string reason = simulation.why_not_threads();
  if (reason.empty()) return simulation.set_threads({.threads = static_cast<std::size_t>(wanted)});
  if (wanted == 1 || (wanted == 2 && !simulation.scene().observe.empty())) return;
  throw std::invalid_argument(fmt::format("only one core can compute this run, for {}; give 1, or leave it out", reason));
}

void set_threads_of_ranks(Simulation& simulation, std::optional<int> threads, Ranks& ranks) {
  if (const std::string reason = simulation.why_not_threads(); !reason.empty())
    throw std::invalid_argument(fmt::format(
        "only one process can compute this run, for {}, and MPI has started {}; start one without it", reason, ranks.size()));
  simulation.set_threads({.threads = static_cast<std::size_t>(threads.value_or(1))}, ranks);
}

namespace {

/// Returns how many threads of the whole machine run or want to run at this moment, the caller among them. Linux says so in the
/// fourth number of this file: "0.20 0.18 0.12 3/412 1234".
std::optional<int> running_now() {
  std::ifstream file("/proc/loadavg");
  double minute = 0.0;
  int running = 0;
  if (!(file >> minute >> minute >> minute >> running) || running < 1) return std::nullopt;
  return running;
}

}  // namespace

int processors() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

int free_processors() {
  const int all = processors();
  const long of_machine = sysconf(_SC_NPROCESSORS_ONLN);
  if (all == 1 || of_machine < all) return all;
  std::optional<int> fewest;  // who computes for long is there every time
  for (int look = 0; look < 3; ++look) {
    if (look > 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    const std::optional<int> running = running_now();
    if (!running) return all;
    fewest = std::min(fewest.value_or(*running), *running);
  }
  const int others = std::max(0, *fewest - 1);
  return std::clamp(static_cast<int>(of_machine) - others, 1, all);
}

}  // namespace carom
