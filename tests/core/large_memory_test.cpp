#include "core/large_memory.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>

namespace carom::test {
namespace {

constexpr std::size_t huge_page = std::size_t{1} << 21;
#if CAROM_MAPS_MEMORY
constexpr bool maps = true;
#else
constexpr bool maps = false;
#endif

TEST(LargeMemory, IsAlignedAndHasRoomFromEndToEnd) {
  for (const std::size_t bytes :
       {std::size_t{1}, huge_page / 2 - 64, huge_page / 2, huge_page - 1, huge_page + 1, 5 * huge_page + 12'345}) {
    LargeVector<char> memory(bytes, 'a');
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory.data()) % (maps && bytes >= huge_page / 2 ? huge_page : 64), 0U) << bytes;
    memory.front() = memory.back() = 'b';
    EXPECT_EQ(memory[bytes / 2], bytes > 2 ? 'a' : 'b');
  }
}

TEST(LargeMemory, IsCountedAndGivenBack) {
  const std::size_t before = large_memory_held;
  {
    LargeVector<double> memory(1'000'000);
    EXPECT_EQ(large_memory_held, before + (maps ? 4 * huge_page : 0)) << "the last page is three quarters full";
    memory.reserve(2'000'000);
    memory.push_back(1.0);
    EXPECT_EQ(large_memory_held, before + (maps ? 8 * huge_page : 0));
    const LargeVector<double> moved = std::move(memory);
    EXPECT_EQ(moved.back(), 1.0);
  }
  EXPECT_EQ(large_memory_held, before);
}

TEST(LargeMemory, IsInSmallPagesWhereLessThanHalfOfALargeOneIsLeftOver) {
  const std::size_t before = large_memory_held, bytes = 3 * huge_page + huge_page / 2 - 64;
  const LargeVector<char> memory(bytes);
  EXPECT_EQ(large_memory_held, before + (maps ? bytes : 0));
}

TEST(LargeMemory, RefusesWhatNoMachineHas) {
  LargeAllocator<double> allocator;
  EXPECT_THROW((void)allocator.allocate(std::numeric_limits<std::size_t>::max() / 8), std::bad_array_new_length);
  if (!maps) return;  // the compiler may see that nothing uses what the C library refuses
  EXPECT_THROW((void)allocator.allocate(std::size_t{1} << 52), std::bad_alloc);
}

}  // namespace
}  // namespace carom::test
