// Facts about the machine, from Linux and glibc.

#include "studies/machine.hpp"

#include "core/large_memory.hpp"

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#if defined(__GLIBC__)
#if __GLIBC_PREREQ(2, 33)
#define CAROM_HAS_MALLINFO2 1
#include <malloc.h>
#endif
#endif

namespace carom::cli {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::optional<std::size_t> second_level_cache() {
#if defined(_SC_LEVEL2_CACHE_SIZE)
  const long size = sysconf(_SC_LEVEL2_CACHE_SIZE);
  if (size > 0) return static_cast<std::size_t>(size);
#endif
  return std::nullopt;
}

std::optional<std::size_t> memory_held() {
#if CAROM_HAS_MALLINFO2
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd + large_memory_held;
#else
  return std::nullopt;
#endif
}

}  // namespace carom::cli
