#pragma once
// Asking for memory that will be needed soon.

namespace carom {

/// Begins to bring the cache line at `address` into the cache. It may be any address.
///
/// Without the empty statement GCC 12 takes a function that only fetches for one without effect, and leaves out the calls of it.
inline void fetch(const void* address) {
  __builtin_prefetch(address);
  asm volatile("");
}

}  // namespace carom
