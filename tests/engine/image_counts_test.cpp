// Counts of box lengths: 64 bits in the space of 32.

#include "engine/image_counts.hpp"
#include "core/archive.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cstdint>
#include <limits>
#include <sstream>
#include <vector>

namespace carom::test {
namespace {

constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max(), least = std::numeric_limits<std::int32_t>::min();

TEST(ImageCounts, GoOnBeyond32BitsAndComeBack) {
  for (const auto& [from, by] : {std::array<std::int64_t, 2>{most, 1}, {least, -1}, {3 * (most + 1) - 1, 1}}) {
    ImageCounts counts(2);
    counts.set(1, 0, from);
    const auto step = static_cast<std::int32_t>(by);
    for (int k = 0; k < 3; ++k) counts.step(1, 0, step);
    EXPECT_EQ(counts.of(1, 0), from + 3 * by);
    for (int k = 0; k < 5; ++k) counts.step(1, 0, -step);
    EXPECT_EQ(counts.of(1, 0), from - 2 * by);
    EXPECT_EQ(counts.of(1, 1), 0);
    EXPECT_EQ(counts.of(0, 0), 0);
  }
}

RC_GTEST_PROP(PropertyImageCounts, AreThoseOf64BitsKept, ()) {
  ImageCounts counts(3);
  std::vector<std::array<std::int64_t, 2>> twin(3);
  const int moves = *rc::gen::inRange(0, 60);
  for (int m = 0; m < moves; ++m) {
    const auto i = *rc::gen::inRange<std::int32_t>(0, 3);
    const int axis = *rc::gen::inRange(0, 2);
    std::int64_t& expected = twin[static_cast<std::size_t>(i)][static_cast<std::size_t>(axis)];
    if (*rc::gen::inRange(0, 3) == 0) {
      const auto near =
          *rc::gen::element<std::int64_t>(0, most, least, most + 1, least - 1, 2 * most, 7 * least, std::int64_t{1} << 60);
      counts.set(i, axis, expected = near + *rc::gen::inRange(-2, 3));
    } else {
      const std::int32_t by = *rc::gen::element(1, -1);
      counts.step(i, axis, by);
      expected += by;
    }
  }
  std::stringstream saved;
  {
    SavingArchive archive(saved);
    archive(counts);
  }
  ImageCounts restored(3);
  LoadingArchive archive(saved);
  archive(restored);
  for (std::int32_t i = 0; i < 3; ++i)
    for (int axis = 0; axis < 2; ++axis) {
      const std::int64_t expected = twin[static_cast<std::size_t>(i)][static_cast<std::size_t>(axis)];
      RC_ASSERT(counts.of(i, axis) == expected);
      RC_ASSERT(restored.of(i, axis) == expected);
    }
}

}  // namespace
}  // namespace carom::test
