#pragma once
// carom bench: how fast the engines are, or with --effects the price of each effect, or with --threads what more cores bring.

#include "terminal/command.hpp"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace carom::cli {

struct BenchOptions {
  bool json = false;
  bool effects = false;                     ///< the price of each effect, in place of how fast the engines are
  bool large = false;                       ///< a million disks too
  std::optional<std::string> threads = {};  ///< one run on so many cores against one; "": on as many as there are
  std::vector<std::int64_t> disks;          ///< empty: 1000, 10000, 100000
  /// collisions per measurement of the textbook engine; absent: 200000, or one per disk
  std::optional<std::uint64_t> collisions;
};
ExitCode bench(const BenchOptions& options);

/// Returns the time of a collision with each effect, as a ratio to that of the lean engine on the same gas.
ExitCode bench_effects(const BenchOptions& options);

/// Returns how much faster one run is on several cores, once its bits are found to be those of one core.
ExitCode bench_threads(const BenchOptions& options);

/// Returns text such as "Intel(R) Xeon(R) Processor, 2048 KiB of second-level cache; carom 0.1.0 (commit ...), avx512
/// instructions."
std::string measured_on();

/// {"carom": {...}, "machine": {...}, "instructions": "avx512"}
nlohmann::ordered_json measured_on_json();

}  // namespace carom::cli
