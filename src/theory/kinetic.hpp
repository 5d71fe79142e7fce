#pragma once
// Kinetic theory of one kind of smooth hard disks, as Boltzmann and Enskog have it. The units are the diameter, the mass and kT.

#include <cstdint>

namespace carom::theory {

/// Contact value of g(r) from the equation of state: (Z - 1) / (2 eta), Z after Kolafa and Rottner. Requires 0 < eta <= 0.69.
[[nodiscard]] double contact_value(double eta);

/// Collisions of a disk per time in a gas of this compressibility factor: (4 / sqrt pi) (Z - 1).
[[nodiscard]] double disk_collision_rate(double Z);

/// The same for N disks in a periodic box, of one energy and total momentum zero, with kT = K / (N - 1): Z of so many disks, and
/// what a fixed energy makes of the mean relative speed, as it does of the mean speed. Requires eta <= 0.63 and N > 2.
[[nodiscard]] double disk_collision_rate(double eta, std::int64_t disks);

/// Mean free path of an infinite system, 1 / (2 sqrt2 rho g).
[[nodiscard]] double mean_free_path(double eta);

/// Coefficients of self-diffusion, shear viscosity and heat conductivity after Enskog: Gass, J. Chem. Phys. 54, 1898 (1971). The
/// theory leaves out that collisions are correlated: near 5 % up to eta = 0.3 and 10 % at 0.4, more beyond.
[[nodiscard]] double enskog_diffusion(double eta);
[[nodiscard]] double enskog_viscosity(double eta);
[[nodiscard]] double enskog_conductivity(double eta);

/// How often a disk of speed v (in units of sqrt(kT / m)) collides, over the mean of all disks: the mean of |v - v'| over
/// Maxwell's v', over sqrt(pi). Boltzmann's theory, and Enskog's.
[[nodiscard]] double relative_rate(double speed);

/// Share of the flights between collisions that last longer than `time` mean free times. A disk leaves a collision with a speed
/// that it is the likelier to have the more often disks of that speed collide, and flies on as long as its rate says: exact for a
/// dilute gas (Visco, van Wijland & Trizac, Phys. Rev. E 77, 041117 (2008)).
[[nodiscard]] double flights_longer_than(double time);

/// The density of these times, in mean free times: minus the derivative.
[[nodiscard]] double flight_time_density(double time);
/// The density of the lengths of these flights, in thermal velocities sqrt(kT / m) times mean free times; their mean is sqrt(pi /
/// 2).
[[nodiscard]] double flight_length_density(double length);

/// Kurtosis <v^4> / <v^2>^2 of a gas of restitution e that cools evenly: 2 (1 + a2), with a2 from the second Sonine
/// polynomial (van Noije & Ernst, Granular Matter 1, 57 (1998)), here for disks.
[[nodiscard]] double cooling_kurtosis(double restitution);

}  // namespace carom::theory
