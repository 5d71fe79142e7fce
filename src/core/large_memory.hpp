#pragma once
// Memory for arrays with an entry per disk: aligned to cache lines and, from 1 MiB on, in pages of 2 MiB where the system
// has them, so that reading all over a large array does not miss the address cache each time. What is left over at the end has a
// page of 2 MiB as well where it fills half of one, and small pages otherwise.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <vector>
#if defined(__has_feature)
#define CAROM_SANITIZES_ADDRESSES __has_feature(address_sanitizer)
#elif defined(__SANITIZE_ADDRESS__)
#define CAROM_SANITIZES_ADDRESSES 1
#endif
#if defined(__linux__) && !CAROM_SANITIZES_ADDRESSES  // which watches the C library's memory alone
#define CAROM_MAPS_MEMORY 1
#include <sys/mman.h>
#endif

namespace carom {

/// Bytes that LargeAllocator has straight from the system, beside the account of the C library.
inline std::atomic<std::size_t> large_memory_held = 0;

template <class T>
struct LargeAllocator {
  using value_type = T;

  LargeAllocator() = default;
  template <class U>
  explicit LargeAllocator(const LargeAllocator<U>&) {}

  [[nodiscard]] T* allocate(std::size_t n) {
    if (n > static_cast<std::size_t>(-1) / 2 / sizeof(T)) throw std::bad_array_new_length();
    const std::size_t bytes = bytes_of(n);
#if CAROM_MAPS_MEMORY
    if (is_large(bytes)) return static_cast<T*>(map_memory(bytes));
#endif
    void* memory = std::aligned_alloc(line, bytes);
    if (memory == nullptr) throw std::bad_alloc();
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, [[maybe_unused]] std::size_t n) {
#if CAROM_MAPS_MEMORY
    if (const std::size_t bytes = bytes_of(n); is_large(bytes)) return give_back(memory, bytes);
#endif
    std::free(memory);
  }

  template <class U>
  bool operator==(const LargeAllocator<U>&) const {
    return true;
  }

 private:
  static constexpr std::size_t line = 64, huge_page = std::size_t{1} << 21;

  static bool is_large(std::size_t bytes) { return in_huge_pages(bytes) > 0; }
  /// The bytes of the large pages that are at least half full, from the start on.
  static std::size_t in_huge_pages(std::size_t bytes) { return (bytes + huge_page / 2) / huge_page * huge_page; }
  static std::size_t held(std::size_t bytes) { return std::max(bytes, in_huge_pages(bytes)); }
  static std::size_t whole_pages(std::size_t bytes) { return (bytes + huge_page - 1) / huge_page * huge_page; }
  static std::size_t bytes_of(std::size_t n) { return (n * sizeof(T) + line - 1) / line * line; }

#if CAROM_MAPS_MEMORY
  /// Memory that was in use before would stay in small pages.
  static void* map_memory(std::size_t bytes) {
    const std::size_t mapped = whole_pages(bytes);
    void* memory = mmap(nullptr, mapped + huge_page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    const std::size_t before = (huge_page - reinterpret_cast<std::uintptr_t>(memory) % huge_page) % huge_page;
    char* const start = static_cast<char*>(memory) + before;
    if (before > 0) munmap(memory, before);
    munmap(start + mapped, huge_page - before);
    madvise(start, in_huge_pages(bytes), MADV_HUGEPAGE);  // a wish: nothing depends on it
    large_memory_held += held(bytes);
    return start;
  }
  static void give_back(void* memory, std::size_t bytes) {
    munmap(memory, whole_pages(bytes));
    large_memory_held -= held(bytes);
  }
#endif
};

template <class T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

/// Makes room for `size` entries and an eighth more, where a vector by itself would double what is large already.
template <class T>
void reserve(LargeVector<T>& large, std::size_t size) {
  if (size > large.capacity()) large.reserve(size + size / 8 + 64);
}

}  // namespace carom
