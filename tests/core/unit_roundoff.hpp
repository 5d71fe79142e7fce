#pragma once
// What one rounding costs at most, relative to the result: u in docs/numerics.md and in the bounds of core/'s headers.

namespace carom::test {

inline constexpr double u = 0x1p-53;

}  // namespace carom::test
