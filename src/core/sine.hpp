#pragma once
// Sine and cosine of an angle counted in turns, by their power series: the same bits on every machine, in every number type. The
// sine of the standard library differs from one library to another in its last digit.

#include <cmath>
#include <limits>

namespace carom {

template <class Real>
struct SineAndCosine {
  Real sine;
  Real cosine;
};

/// 2 pi, rounded to the number type.
template <class Real>
[[nodiscard]] Real full_turn() {
  // The first 36 digits as sums of doubles, which every type adds without loss but for its own rounding.
  constexpr double first = 0x1.921fb54442d18p+2, second = 0x1.1a62633145c07p-52, third = -0x1.f1976b7ed8fbcp-108;
  return Real(first) + (Real(second) + Real(third));
}

/// Returns sine and cosine of 2 pi times `turns`. The error of each is at most 4 units in the last place of 1, beside what the
/// rounding of `turns` stands for.
template <class Real>
[[nodiscard]] SineAndCosine<Real> sine_and_cosine(Real turns) {
  using std::floor;
  const Real part = turns - floor(turns);
  const Real eighths = floor(8 * part);
  const int quarter = (static_cast<int>(eighths) + 1) / 2;  // the nearest quarter of a turn
  const Real angle = full_turn<Real>() * (part - Real(quarter) / 4);
  const Real square = angle * angle;  // at most (pi / 4)^2
  // The first power that is left out is below a unit in the last place: x^(2n+1) / (2n+1)! at pi / 4.
  constexpr int digits = std::numeric_limits<Real>::digits;
  constexpr int terms = digits <= 24 ? 5 : digits <= 53 ? 8 : digits <= 64 ? 10 : 15;
  Real sine = 1, cosine = 1;
  for (int n = terms; n > 0; --n) {
    sine = 1 - square / Real(2 * n * (2 * n + 1)) * sine;
    cosine = 1 - square / Real(2 * n * (2 * n - 1)) * cosine;
  }
  sine *= angle;
  switch (quarter % 4) {
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    case 3:
      return {-cosine, sine};
    default:
      return {sine, cosine};
  }
}

}  // namespace carom
