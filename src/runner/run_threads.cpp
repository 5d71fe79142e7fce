#include "runner/run_threads.hpp"

#include "runner/free_processors.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <stdexcept>
#include <system_error>

namespace carom {

namespace {

// Below, what domains compute twice is a fifth of the work, and windows are so short that threads mostly wait for each other.
constexpr std::int64_t fewest_disks = 50'000;

constexpr int most_suggested = 16;
constexpr int most = 32;

constexpr const char* range = "give auto, or a number from 1 to 32";

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
  int threads = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), threads);
  if (error != std::errc{} || end != text.data() + text.size() || threads < 1 || threads > most)
    throw std::invalid_argument(range);
  return threads;
}

void set_threads_of_run(Simulation& simulation, std::optional<int> threads) {
  const int wanted = threads ? *threads : suggested_threads(simulation).threads;
  if (wanted < 1 || wanted > most) throw std::invalid_argument(range);
  const std::string reason = simulation.why_not_threads();
  if (reason.empty()) return simulation.set_threads({.threads = static_cast<std::size_t>(wanted)});
  if (wanted == 1 || (wanted == 2 && !simulation.scene().observe.empty())) return;
  throw std::invalid_argument(fmt::format("only one core can compute this run, for {}; give 1, or leave it out", reason));
}

}  // namespace carom
