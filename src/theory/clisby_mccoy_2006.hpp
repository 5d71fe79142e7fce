#pragma once
// Virial coefficients of hard disks: Clisby & McCoy, J. Stat. Phys. 122, 15 (2006). B_n over (pi sigma^2 / 4)^(n - 1).

#include <array>

namespace carom::theory {

/// b_2 ... b_10; b_5 and b_6 on are known to the last digits given, or one or two of them.
inline constexpr std::array<double, 9> virial_coefficients = {2.0,     3.1280178, 4.2578545, 5.336897, 6.36296,
                                                              7.35186, 8.3191,    9.2721,    10.216};

/// Z = 1 + sum of b_n eta^(n - 1). The first term left out is below 12 eta^10.
constexpr double virial_series(double eta) {
  double z = 0.0;
  for (auto b = virial_coefficients.rbegin(); b != virial_coefficients.rend(); ++b) z = (z + *b) * eta;
  return 1.0 + z;
}

}  // namespace carom::theory
