#pragma once
// Kinetic theory of hard disks, as Boltzmann and Enskog have it. Where disks are of one kind, the units are the diameter, the
// mass and kT.

#include <complex>
#include <cstdint>
#include <span>

namespace carom::theory {

/// One kind of disk in a gas.
struct Component {
  double density = 0.0;  ///< disks per area
  double radius = 0.0;
  double mass = 0.0;
};

/// Contact value g_ij of disks of these radii in a gas. It has the form that scaled particle theory gives it, 1 / (1 - eta) +
/// c (sigma_i sigma_j / sigma_ij) <sigma> / <sigma^2>, with c such that disks of one size have contact_value(eta): good to the
/// error of that for equal disks, to one or two per cent for mixtures. Requires a packing fraction above 0 and of at most 0.69
/// (fluid).
[[nodiscard]] double contact_value(std::span<const Component> gas, double radius_i, double radius_j);

/// Pair collisions per area and time at temperature kT > 0: half the sum of n_i omega_ij over all kinds i and j, with
/// omega_ij = n_j sigma_ij g_ij sqrt(2 pi kT / mu_ij), g_ij by contact_value(). Requires a packing fraction of at most 0.69
/// (fluid).
[[nodiscard]] double collision_rate(std::span<const Component> gas, double kT);

/// Contact value of g(r) from the equation of state: (Z - 1) / (2 eta), Z after Kolafa and Rottner. Requires 0 < eta <= 0.69.
[[nodiscard]] double contact_value(double eta);

/// Collisions of a disk per time in a gas of this compressibility factor: (4 / sqrt pi) (Z - 1).
[[nodiscard]] double disk_collision_rate(double Z);

/// Returns the collision rate of a disk among N disks in a periodic box, of one energy and total momentum zero, with
/// kT = K / (N - 1): with Z of N disks, and with the mean relative speed at fixed energy. Requires eta <= 0.63 and N > 2.
[[nodiscard]] double disk_collision_rate(double eta, std::int64_t disks);

/// Mean free path of an infinite system, 1 / (2 sqrt2 rho g).
[[nodiscard]] double mean_free_path(double eta);

/// Coefficients of self-diffusion, shear viscosity and heat conductivity after Enskog: Gass, J. Chem. Phys. 54, 1898 (1971). The
/// theory leaves out that collisions are correlated: near 5 % up to eta = 0.3 and 10 % at 0.4, more beyond.
[[nodiscard]] double enskog_diffusion(double eta);
[[nodiscard]] double enskog_viscosity(double eta);
[[nodiscard]] double enskog_conductivity(double eta);

/// Returns the collision rate of a disk of speed v (in units of sqrt(kT / m)) over the mean of all disks: the mean of |v - v'|
/// over Maxwell's v', over sqrt(pi). It is the same in the theories of Boltzmann and Enskog.
[[nodiscard]] double relative_rate(double speed);

/// Returns the relative rate in a periodic box of `disks` disks at fixed energy and zero total momentum, exactly: the velocities
/// of the others then depend a little on that of the disk. `speed` is in units of sqrt(kT / m) with kT = K / (N - 1). Requires
/// disks > 3.
[[nodiscard]] double relative_rate(double speed, std::int64_t disks);

/// Returns the mean of relative_rate(v, disks) over the disks with speeds of `from` to `to`.
[[nodiscard]] double mean_relative_rate(double from, double to, std::int64_t disks);

/// Mean of v / relative_rate(v) over Maxwell's v, over the mean speed: the mean path of a disk from an instant to its next
/// collision, over the mean free path.
[[nodiscard]] double path_ahead();

/// Share of the flights between collisions that last longer than `time` mean free times. A disk leaves a collision with a speed
/// that it is the likelier to have the more often disks of that speed collide, and flies on as long as its rate says: exact for a
/// dilute gas (Visco, van Wijland & Trizac, Phys. Rev. E 77, 041117 (2008)).
[[nodiscard]] double flights_longer_than(double time);

/// Returns the fraction of flights longer than `time` among those that begin and end within a run of `run` mean free times: long
/// flights are less likely to fit.
[[nodiscard]] double flights_longer_within(double time, double run);

/// Returns the density of these times, in mean free times: minus the derivative.
[[nodiscard]] double flight_time_density(double time);
/// Returns the density of the lengths of these flights, in thermal velocities sqrt(kT / m) times mean free times; their mean is
/// sqrt(pi / 2).
[[nodiscard]] double flight_length_density(double length);

/// Shear viscosity and heat conductivity at once: the limits, for short times t, of the mean squares of what Helfand's moments
/// have grown by, over 2 t A kT (viscosity) and 2 t A kT^2 (conductivity). Collisions alone contribute, by what they carry from
/// one centre to the other, so that both follow from the pressure of this many disks. Exact for N disks of one energy
/// and zero total momentum; derived in docs/validation.md. Requires eta <= 0.63 and disks > 2.
[[nodiscard]] double instantaneous_viscosity(double eta, std::int64_t disks);
[[nodiscard]] double instantaneous_conductivity(double eta, std::int64_t disks);

/// Returns the exponent of a sound wave of wave number k > 0, whose amplitude is the real part of exp(lambda t): the complex root
/// of linearised hydrodynamics (Navier, Stokes, Fourier) with Enskog's coefficients. For small k it is i c k - Gamma k^2; terms
/// of higher order than hydrodynamics has are left out.
[[nodiscard]] std::complex<double> sound_wave(double eta, double k);

/// Returns <v_x(0) v_x(t)> of disks in a square periodic box at late times t > 0, when the slow modes of the fluid carry the
/// velocity of a disk: the sum over the wave vectors k of the box, but 0,
///   C(t) = kT / (2 m N) sum of exp(-(D + nu) k^2 t) + cos(c k t) exp(-(D + Gamma) k^2 t),
/// with Enskog's D, viscosity and conductivity. For a large box and late times it approaches the tail kT / (8 pi rho m (D + nu)
/// t) of Ernst, Hauge & van Leeuwen, Phys. Rev. Lett. 25, 1254 (1970). It holds beyond some 20 mean free times (Erpenbeck & Wood,
/// Phys. Rev. A 26, 1648 (1982), with the same sum).
[[nodiscard]] double velocity_correlation_of_modes(double eta, std::int64_t disks, double t);

/// Returns the integral of velocity_correlation_of_modes() between two times, by which the diffusion coefficient D(t) increases.
[[nodiscard]] double diffusion_growth(double eta, std::int64_t disks, double from, double to);

/// Returns the coefficient a2 of the second Sonine polynomial in the velocities of a gas of restitution e that cools evenly (van
/// Noije & Ernst, Granular Matter 1, 57 (1998)), here for disks.
[[nodiscard]] double cooling_sonine(double restitution);

/// Returns 1 / t_H of Haff's law for the mean of T^-1/2 over many starts, 1 + t / t_H for kT(0) = K / (N - 1) = 1 and N disks in
/// a periodic box: (1 - e^2) omega / 4 N / (N - 1), omega the rate that belongs to the pressure of this many disks, with what a2
/// (1 + 3 a2 / 16) and the fixed energy make of the mean cube of the relative speed, and with the lumps in which collisions take
/// energy (1 + 3 (1 - e^2) / 2 N). Requires eta <= 0.63 and disks > 2.
[[nodiscard]] double haff_rate(double restitution, double eta, std::int64_t disks);

/// Returns the number of disks in a square box above which its longest shear wave grows, in units of the thermal speed, while the
/// gas cools: k^2 = zeta / 2 nu at k = 2 pi / L, zeta / 2 = 1 / t_H and Enskog's viscosity.
[[nodiscard]] double shear_instability(double restitution, double eta);

/// Returns the fraction by which shear waves slow the cooling down in a box in which all decay. A wave of wave number k holds one
/// part in 2 N of the energy, times 1 / (1 - zeta / 2 nu k^2). That cools nothing, and what collisions take goes as the 3/2 power
/// of the rest. Counted are waves with k l < 1, l the mean free path: shorter ones are no flow. Requires disks <
/// shear_instability().
[[nodiscard]] double haff_slowing(double restitution, double eta, std::int64_t disks);

/// Kurtosis <v^4> / <v^2>^2 of a gas of restitution e that cools evenly: 2 (1 + a2).
[[nodiscard]] double cooling_kurtosis(double restitution);

}  // namespace carom::theory
