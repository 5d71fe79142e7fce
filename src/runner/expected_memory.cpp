#include "runner/expected_memory.hpp"

#include "scene/effect_traits.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <fstream>

namespace carom {

namespace {

/// Returns the bytes that programs can still be given, in the words of Linux; empty where the system does not say.
std::optional<double> memory_free() {
  std::ifstream file("/proc/meminfo");
  for (std::string line; std::getline(file, line);)
    if (double kilobytes = 0.0; std::sscanf(line.c_str(), "MemAvailable: %lf kB", &kilobytes) == 1) return 1024.0 * kilobytes;
  return std::nullopt;
}

}  // namespace

ExpectedMemory expected_memory(const Scene& scene) {
  constexpr double without_effects = 215.0;  // of equal disks at a packing fraction of 0.5, as the tests measure it
  ExpectedMemory memory{.bytes_per_disk = without_effects, .free = memory_free()};
  for (const detail::EffectTraits& effect : detail::all_effects())
    if (effect.is_present(scene.effects)) memory.bytes_per_disk += effect.bytes_per_disk;
  constexpr double at_the_start = 135.0;  // more while disks are drawn, of a run of 10^7 (docs/performance.md)
  memory.bytes = (memory.bytes_per_disk + at_the_start) * static_cast<double>(scene.disk_count());
  return memory;
}

std::string ExpectedMemory::words() const {
  return fmt::format("some {:.0f} bytes per disk, and {} in all at the start{}", bytes_per_disk, size(bytes),
                     free ? fmt::format("; {} are free", size(*free)) : "");
}

std::optional<std::string> too_little_memory(const Scene& scene) {
  const ExpectedMemory memory = expected_memory(scene);
  if (!memory.free || memory.bytes <= *memory.free) return std::nullopt;
  return fmt::format("{}: there is not enough memory for {} disks: they need {}; fewer disks need less", scene.source,
                     grouped(static_cast<std::uint64_t>(scene.disk_count())), memory.words());
}

}  // namespace carom
