#include "core/instructions.hpp"

#include <cstdlib>
#include <string_view>

namespace carom {

namespace {

/// The features tested here must cover the flags in CMakeLists.txt by which the kernels are compiled.
Instructions best_instructions() {
  Instructions best = Instructions::portable;
#if CAROM_HAS_AVX2
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("popcnt")) best = Instructions::avx2;
#endif
#if CAROM_HAS_AVX512
  if (best == Instructions::avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2"))
    best = Instructions::avx512;
#endif
  return best;
}

}  // namespace

const char* name_of(Instructions set) {
  return set == Instructions::avx512 ? "avx512" : set == Instructions::avx2 ? "avx2" : "portable";
}

Instructions chosen_instructions() {
  const Instructions best = best_instructions();
  const char* asked = std::getenv("CAROM_INSTRUCTIONS");
  if (asked == nullptr) return best;
  for (const Instructions set : {Instructions::portable, Instructions::avx2})
    if (set < best && std::string_view(asked) == name_of(set)) return set;
  return best;
}

}  // namespace carom
