#include "core/instructions.hpp"

#include <cstdlib>
#include <string_view>

namespace carom {

bool use_avx2() {
#if CAROM_HAS_AVX2
  const char* asked = std::getenv("CAROM_INSTRUCTIONS");
  if (asked != nullptr && std::string_view(asked) == "portable") return false;
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("popcnt");
#else
  return false;
#endif
}

}  // namespace carom
