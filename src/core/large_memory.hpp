#pragma once
// Memory for arrays with an entry per disk: aligned to cache lines and, from 16 MiB on, in pages of 2 MiB where the system
// has them, so that reading all over a large array does not miss the address cache each time.

#include <cstddef>
#include <cstdlib>
#include <new>
#include <vector>
#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace carom {

template <class T>
struct LargeAllocator {
  using value_type = T;

  LargeAllocator() = default;
  template <class U>
  explicit LargeAllocator(const LargeAllocator<U>&) {}

  [[nodiscard]] T* allocate(std::size_t n) {
    constexpr std::size_t line = 64, huge_page = std::size_t{1} << 21, large = 8 * huge_page;
    if (n > static_cast<std::size_t>(-1) / 2 / sizeof(T)) throw std::bad_array_new_length();
    const std::size_t alignment = n * sizeof(T) >= large ? huge_page : line;
    const std::size_t bytes = (n * sizeof(T) + alignment - 1) / alignment * alignment;
    void* memory = std::aligned_alloc(alignment, bytes);
    if (memory == nullptr) throw std::bad_alloc();
#if defined(__linux__)
    if (alignment == huge_page) madvise(memory, bytes, MADV_HUGEPAGE);  // a wish: nothing depends on it
#endif
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t) { std::free(memory); }

  template <class U>
  bool operator==(const LargeAllocator<U>&) const {
    return true;
  }
};

template <class T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

/// Makes room for `size` entries and an eighth more, where a vector by itself would double what is large already.
template <class T>
void reserve(LargeVector<T>& large, std::size_t size) {
  if (size > large.capacity()) large.reserve(size + size / 8 + 64);
}

}  // namespace carom
