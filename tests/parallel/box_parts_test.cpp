// Parts into which a box is cut: what they know of their widths.

#include "parallel/box_parts.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

namespace carom::test {
namespace {

TEST(BoxParts, KnowTheWidthOfTheThinnest) {
  constexpr std::array side{0x1p-32, 0x1p-32};  // of a step, in a box of side 1
  std::vector<NeighbourhoodCentre> even, uneven;
  for (std::int64_t x = 0; x < 64; ++x)
    for (std::int64_t y = 0; y < 64; ++y) {
      const auto at = [](std::int64_t place, std::int64_t unit) { return static_cast<std::int32_t>(place * unit - (1LL << 31)); };
      even.push_back({at(x, 1 << 26), at(y, 1 << 26)});
      uneven.push_back({at(x, x < 32 ? 1 << 20 : 1 << 26), at(y, 1 << 26)});  // half of them in a strip 1/128 wide
    }
  EXPECT_NEAR(BoxParts(4, even, side).thinnest(), 0.5, 1.0 / 64.0);
  EXPECT_LT(BoxParts(16, uneven, side).thinnest(), 1.0 / 128.0);
}

}  // namespace
}  // namespace carom::test
