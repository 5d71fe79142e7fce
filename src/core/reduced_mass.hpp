#pragma once

#include <limits>

namespace carom {

/// Returns a b / (a + b), to the bit the same with a and b exchanged.
[[nodiscard]] constexpr double reduced_mass(double a, double b) { return a < b ? a * (b / (a + b)) : b * (a / (a + b)); }

/// Returns the reduced mass from the product of the two masses; falls back to the quotients where the product is beyond the range
/// of numbers.
template <class Real>
[[nodiscard]] Real reduced_mass_by_product(Real a, Real b) {
  const Real product = a * b;
  const bool whole = product >= (std::numeric_limits<Real>::min)() && product <= (std::numeric_limits<Real>::max)();
  return whole ? Real(product / (a + b)) : a < b ? Real(a * (b / (a + b))) : Real(b * (a / (a + b)));
}

}  // namespace carom
