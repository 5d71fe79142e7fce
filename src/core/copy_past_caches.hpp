#pragma once
// For what another processor will read: a line that is written in the usual way is first fetched from where it was last read, and
// stores leave the processor in order, so that all behind it waits.

#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>
#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace carom {

/// Requires `to` to be aligned as T, at 16 bytes or more, and to have room.
template <class T>
void copy_past_caches(std::span<const T> from, T* to) {
  static_assert(std::is_trivially_copyable_v<T> && alignof(T) % 16 == 0);
#if defined(__SSE2__)
  const auto* source = reinterpret_cast<const __m128i*>(from.data());
  auto* target = reinterpret_cast<__m128i*>(to);
  for (std::size_t i = 0; i < from.size_bytes() / sizeof(__m128i); ++i) _mm_stream_si128(target + i, _mm_load_si128(source + i));
#else
  std::memcpy(to, from.data(), from.size_bytes());
#endif
}

/// What was copied so before is seen by whoever sees what is written after.
inline void end_of_copies() {
#if defined(__SSE2__)
  _mm_sfence();
#endif
}

}  // namespace carom
