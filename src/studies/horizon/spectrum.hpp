#pragma once
// All Lyapunov exponents of a scene, and the rate at which its trajectories lose the memory of their start.

#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// The Lyapunov exponents of N disks, four for each.
struct LyapunovSpectrum {
  std::vector<double> exponents;              ///< 1 / time, the largest first
  std::vector<std::optional<double>> errors;  ///< standard errors over blocks; empty with fewer than 8 blocks
  double entropy = 0.0;                       ///< Kolmogorov-Sinai entropy per time: the sum of the positive exponents
  std::optional<double> entropy_error;        ///< standard error of the entropy
  double pairing = 0.0;          ///< largest |exponent i + exponent 4N + 1 - i|, 1 / time: 0 where the dynamics is Hamiltonian
  double collision_rate = 0.0;   ///< collisions of one disk per time
  std::uint64_t collisions = 0;  ///< number of pair collisions that the exponents were measured over
};

/// The most disks whose spectrum is measured: work grows with the cube of their number.
inline constexpr std::int64_t most_disks_of_a_spectrum = 256;

struct SpectrumOptions {
  std::uint64_t collisions = 0;                       ///< number of pair collisions; 0: 20,000
  std::function<bool(double fraction)> proceed = {};  ///< several times a second; false ends it
};

/// Benettin's method (benettin1980) for all directions of the tangent space: 4 N vectors (TangentFlow) are made orthogonal by a
/// QR decomposition every few collisions, sooner where one of them has grown a hundredfold, and the logarithms of R's diagonal
/// are averaged. Lengths and velocities are weighed by the masses, and vectors begin in an order in which the decomposition of a
/// symplectic map is symplectic: exponents are then paired over any length of time, so that `pairing` tests the tangent map to
/// rounding. The first fifth is left out.
///
/// Empty where disks do not collide, too few collisions came, contacts dissipate energy, or the caller said stop. Requires at
/// most most_disks_of_a_spectrum disks, and effects that TangentFlow knows. Throws as make_simulation.
[[nodiscard]] std::optional<LyapunovSpectrum> measure_spectrum(const Scene& scene, const State& start,
                                                               const SpectrumOptions& options = {});

/// Why measure_spectrum() found nothing, where nobody has stopped it.
inline constexpr std::string_view no_exponents =
    "no exponents were measured: too few collisions of pairs were followed, or collisions lose energy";

/// Returns why the spectrum of this scene is not measured, as a sentence; empty where it is.
[[nodiscard]] std::string why_no_spectrum(const Scene& scene);

/// Returns the spectrum as JSON, with the scene and the program.
[[nodiscard]] std::string spectrum_json(const LyapunovSpectrum& spectrum, const Scene& scene);

/// Returns a few lines: the largest exponents, how many vanish, the entropy.
[[nodiscard]] std::string spectrum_text(const LyapunovSpectrum& spectrum, const Scene& scene);

}  // namespace carom
