#pragma once
// Equations of state of the hard-disk fluid, from the literature.

#include <cstdint>

namespace carom::theory {

/// Compressibility factor Z = beta P A / N of the infinite system at packing fraction eta, 0 <= eta <= 0.69 (fluid).
/// Kolafa & Rottner, Mol. Phys. 104, 3435 (2006): good to about 1e-5 relative in that range.
[[nodiscard]] double kolafa_rottner(double eta);

/// Bound on the relative error of Z - 1 that kolafa_rottner() has, times Z - 1: 1e-5.
[[nodiscard]] double kolafa_rottner_error(double eta);

/// Returns Z of N disks in a periodic box at total momentum zero, with kT = K / (N - 1):
/// Z_N = Z - (eta / 2N) (2 Z' + eta Z'') / (Z + eta Z'), the first order in 1/N, which a fixed number of disks makes of the pair
/// distribution (Lebowitz & Percus, Phys. Rev. 122, 1675 (1961)). Beyond eta = 0.63 higher orders are not small for a few hundred
/// disks.
[[nodiscard]] double kolafa_rottner_finite(double eta, std::int64_t disks);

/// Returns the limit of the structure factor S(k) at small k: kT times the isothermal compressibility times the density,
/// 1 / (Z + eta Z'). Range and source as above.
[[nodiscard]] double structure_factor_at_zero(double eta);

}  // namespace carom::theory
