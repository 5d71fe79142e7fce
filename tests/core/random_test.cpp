#include "core/random.hpp"

#include <gtest/gtest.h>

#include <set>

namespace carom::test {
namespace {

TEST(RandomStream, TheGeneratorIsPhilox4x32WithTenRounds) {
  // Known answers that Random123 ships (kat_vectors): philox4x32 10, all bits of counter and key clear, then set.
  const r123::Philox4x32 philox;
  EXPECT_EQ(philox({{0, 0, 0, 0}}, {{0, 0}}), (r123::Philox4x32::ctr_type{{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}}));
  EXPECT_EQ(philox({{~0u, ~0u, ~0u, ~0u}}, {{~0u, ~0u}}),
            (r123::Philox4x32::ctr_type{{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}}));
}

TEST(RandomStream, SeedNameAndIndexEachGiveAnotherStream) {
  std::set<std::uint64_t> first;
  int streams = 0;
  for (const std::uint64_t seed : {0ull, 1ull, 1ull << 32, ~0ull}) {
    for (const Stream name : {Stream::positions, Stream::velocities, Stream::lattice_sites}) {
      for (const std::uint64_t index : {0ull, 1ull, 1ull << 32}) {
        RandomStream random(seed, name, index);
        const std::uint64_t high = random();
        first.insert(high << 32 | random());
        ++streams;
      }
    }
  }
  EXPECT_EQ(first.size(), static_cast<std::size_t>(streams));
}

TEST(RandomStream, DrawsDoNotDependOnOtherStreams) {
  RandomStream alone(7, Stream::velocities, 3);
  RandomStream among(7, Stream::velocities, 3);
  RandomStream other(7, Stream::velocities, 4);
  for (int k = 0; k < 100; ++k) {
    other();
    EXPECT_EQ(alone(), among());
  }
}

}  // namespace
}  // namespace carom::test
