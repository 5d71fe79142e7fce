#pragma once
// Equations of state of hard disks, and reference data for them.

#include <array>
#include <cstdint>

namespace carom::theory {

/// The largest packing fraction at which kolafa_rottner() is the fluid's equation of state, and that up to which
/// kolafa_rottner_finite() is good to a few hundred disks.
inline constexpr double densest_fluid = 0.69, densest_finite = 0.63;

/// Compressibility factor Z = beta P A / N of the infinite system at packing fraction eta, 0 <= eta <= densest_fluid.
/// Kolafa & Rottner, Mol. Phys. 104, 3435 (2006): good to about 1e-5 relative in that range.
[[nodiscard]] double kolafa_rottner(double eta);

/// Bound on the relative error of Z - 1 that kolafa_rottner() has, times Z - 1: 1e-5.
[[nodiscard]] double kolafa_rottner_error(double eta);

/// Returns Z of N disks in a periodic box at total momentum zero, with kT = K / (N - 1):
/// Z_N = Z - (eta / 2N) (2 Z' + eta Z'') / (Z + eta Z'), the first order in 1/N, which a fixed number of disks makes of the pair
/// distribution (Lebowitz & Percus, Phys. Rev. 122, 1675 (1961)). Beyond densest_finite higher orders are not small for a few
/// hundred disks.
[[nodiscard]] double kolafa_rottner_finite(double eta, std::int64_t disks);

/// Returns the free energy of N disks in a periodic box at packing fraction `to` less that at `from`, over N kT: the integral of
/// (Z_N - 1) / eta over eta with Z_N of kolafa_rottner_finite(). The box is the same and the disks are larger. Where the box is
/// smaller, ln(to / from) of the ideal gas comes to it.
[[nodiscard]] double excess_free_energy_difference(double from, double to, std::int64_t disks);

/// Returns the limit of the structure factor S(k) at small k: kT times the isothermal compressibility times the density,
/// 1 / (Z + eta Z'). Range and source as above.
[[nodiscard]] double structure_factor_at_zero(double eta);

/// Returns the speed of sound in units of sqrt(kT / m): c^2 = Z + eta Z' + Z^2, the derivative of P by the mass density along an
/// adiabat, dT / T = Z d rho / rho. Range and source as above.
[[nodiscard]] double sound_speed(double eta);

/// Virial coefficients B_n / (pi sigma^2 / 4)^(n - 1), Clisby & McCoy, J. Stat. Phys. 122, 15 (2006): b_2 ... b_10. b_2 to
/// b_4 are rounded exact values; the last one or two digits of the others are uncertain.
inline constexpr std::array<double, 9> virial_coefficients = {2.0,     3.1280178, 4.2578545, 5.336897, 6.36296,
                                                              7.35186, 8.3191,    9.2721,    10.216};

/// Z = 1 + sum of b_n eta^(n - 1). The first term left out is below 12 eta^10.
constexpr double virial_series(double eta) {
  double z = 0.0;
  for (auto b = virial_coefficients.rbegin(); b != virial_coefficients.rend(); ++b) z = (z + *b) * eta;
  return 1.0 + z;
}

/// The pressure of a number of hard disks in a square periodic box.
struct ReferencePressure {
  std::int64_t disks;
  double packing_fraction;
  double pressure;  ///< P sigma^2 / kT
  double error;     ///< one standard error
};

/// Fluids: Li, Nishikawa, Hoellmer, Carillo, Maggs & Krauth, J. Chem. Phys. 157, 234111 (2022), and the data set that belongs to
/// it (github.com/jellyfysh/HistoricDisks, DigitizedData/ThisWork.csv). The values hold for that number of disks, without a
/// correction for its being finite.
inline constexpr std::array<ReferencePressure, 5> li_2022 = {{{72, 0.650, 6.901074, 0.000071},
                                                              {72, 0.660, 7.383221, 0.000087},
                                                              {72, 0.670, 7.85637, 0.00011},
                                                              {72, 0.680, 8.23631, 0.00034},
                                                              {224, 0.670, 7.979479, 0.000058}}};

/// From the same source, 128^2 disks: the fluid that is about to freeze, and liquid and hexatic in one box.
inline constexpr std::array<ReferencePressure, 3> li_2022_transition = {
    {{16384, 0.698, 9.17405, 0.00049}, {16384, 0.708, 9.17630, 0.00074}, {16384, 0.716, 9.1587, 0.0010}}};

}  // namespace carom::theory
