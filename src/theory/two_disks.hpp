#pragma once
// The configuration integral of one hard disk and of two in a rectangle between hard walls, in closed form: all of them that is
// known exactly. Its logarithm is the free energy over -kT, up to a constant.

#include <cstdint>

namespace carom::theory {

/// Returns the area, or for two disks the product of areas, that centres have in a box of sides `x` and `y`. For two disks that
/// is the square of a b less the part in which they overlap, a = x - d and b = y - d, which is pi d^2 a b - 4/3 d^3 (a + b) + d^4
/// / 2. Throws std::invalid_argument unless there are one or two disks, and a and b are at least d.
[[nodiscard]] double configuration_integral(std::int64_t disks, double diameter, double x, double y);

/// Returns the free energy of the same disks over kT when side x is `to` less that when it is `from`.
[[nodiscard]] double free_energy_difference(std::int64_t disks, double diameter, double from, double to, double y);

}  // namespace carom::theory
