#pragma once
// The pressure of the hard-disk fluid: what the literature knows.

#include <cstdint>

namespace carom::theory {

/// Compressibility factor Z = beta P A / N of the infinite system at packing fraction eta, 0 <= eta <= 0.69 (fluid).
/// Kolafa & Rottner, Mol. Phys. 104, 3435 (2006): good to about 1e-5 relative in that range.
[[nodiscard]] double kolafa_rottner(double eta);

/// The same for N disks in a periodic box at total momentum zero, with kT = K / (N - 1):
/// Z_N = Z - (eta / 2N) (2 Z' + eta Z'') / (Z + eta Z'), the first order in 1/N. Requires eta <= 0.63.
[[nodiscard]] double kolafa_rottner_finite(double eta, std::int64_t disks);

/// What the structure factor S(k) comes to at small k: kT times the isothermal compressibility times the density, 1 / (Z + eta
/// Z'). Same range and source.
[[nodiscard]] double structure_factor_at_zero(double eta);

}  // namespace carom::theory
