#pragma once

namespace carom {

/// a b / (a + b), to the bit the same with a and b exchanged.
[[nodiscard]] constexpr double reduced_mass(double a, double b) { return a < b ? a * (b / (a + b)) : b * (a / (a + b)); }

}  // namespace carom
