// No include guard: four doubles at a time, or eight, for kernels that are compiled once per instruction set, in the namespace
// CAROM_INSTRUCTIONS. The vectors are those of GCC and Clang; every operation is IEEE's.

#include <cmath>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

// One function after inlining: what several parts share stays in registers, and they run side by side.
#define CAROM_INLINE [[gnu::always_inline]] inline

namespace carom::CAROM_INSTRUCTIONS {
namespace {

using Doubles = double __attribute__((vector_size(32)));

CAROM_INLINE Doubles all(double x) { return Doubles{x, x, x, x}; }

#if defined(__AVX512F__)
/// Eight at a time, where one instruction does that: fewer instructions leave more room for those of the events after.
using EightDoubles = double __attribute__((vector_size(64)));

CAROM_INLINE EightDoubles all_eight(double x) { return EightDoubles{x, x, x, x, x, x, x, x}; }

CAROM_INLINE EightDoubles square_root(EightDoubles x) {
  return reinterpret_cast<EightDoubles>(_mm512_maskz_sqrt_pd(0xFF, reinterpret_cast<__m512d>(x)));
}
#endif

CAROM_INLINE Doubles square_root(Doubles x) {
#if defined(__AVX__)
  return reinterpret_cast<Doubles>(_mm256_sqrt_pd(reinterpret_cast<__m256d>(x)));
#elif defined(__SSE2__)
  const __m128d low = _mm_sqrt_pd(_mm_set_pd(x[1], x[0]));
  const __m128d high = _mm_sqrt_pd(_mm_set_pd(x[3], x[2]));
  return Doubles{low[0], low[1], high[0], high[1]};
#else
  return Doubles{std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3])};
#endif
}

}  // namespace
}  // namespace carom::CAROM_INSTRUCTIONS
