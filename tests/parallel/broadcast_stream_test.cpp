// What rank 0 writes into a stream is what all others read, however long it is and however much of it they read.

#include "parallel/broadcast_stream.hpp"

#include "support/memory_ranks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <vector>

namespace carom::test {
namespace {

constexpr std::size_t block = std::size_t{1} << 20;

/// Bytes that repeat after 251, a prime, so that a block in the place of another shows.
std::string some_bytes(std::size_t count) {
  std::string bytes(count, '\0');
  for (std::size_t k = 0; k < count; ++k) bytes[k] = static_cast<char>(k % 251);
  return bytes;
}

TEST(BroadcastStream, BringsAnyNumberOfBytesToAllOthers) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, block - 1, block, block + 1, 2 * block, 3 * block + 17}) {
    Mailboxes mailboxes;
    MemoryRanks first(mailboxes, 0, 3), second(mailboxes, 1, 3), third(mailboxes, 2, 3);
    std::size_t longest = 0;
    first.on_the_way = [&](int, const std::string& bytes) { return longest = std::max(longest, bytes.size()), bytes; };
    const std::string sent = some_bytes(count);
    { detail::BroadcastOutput(first).write(sent.data(), static_cast<std::streamsize>(count)); }
    EXPECT_EQ(longest, std::min(count, block));
    for (MemoryRanks* const rank : {&second, &third}) {
      detail::BroadcastInput in(*rank);
      EXPECT_TRUE(std::string(std::istreambuf_iterator<char>(in), {}) == sent) << count << " bytes";
    }
  }
}

TEST(BroadcastStream, LeavesTheNextMessageToBeReadWhereItsReaderStopsEarly) {
  for (const std::size_t count : {std::size_t{0}, block / 2, block, 2 * block + 5}) {
    Mailboxes mailboxes;
    MemoryRanks first(mailboxes, 0, 2), second(mailboxes, 1, 2);
    const std::string sent = some_bytes(count);
    { detail::BroadcastOutput(first).write(sent.data(), static_cast<std::streamsize>(count)); }
    std::string next = "the next message";
    first.broadcast(next);
    {
      detail::BroadcastInput in(second);
      std::vector<char> some(std::min<std::size_t>(count, 10));
      EXPECT_TRUE(in.read(some.data(), static_cast<std::streamsize>(some.size())));
    }
    std::string received;
    second.broadcast(received);
    EXPECT_EQ(received, "the next message") << count << " bytes";
  }
}

}  // namespace
}  // namespace carom::test
