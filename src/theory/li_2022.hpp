#pragma once
// Pressures of small systems of hard disks in a square periodic box: Li, Nishikawa, Hoellmer, Carillo, Maggs & Krauth,
// J. Chem. Phys. 157, 234111 (2022). They hold for that number of disks, without any correction for its being finite.

#include <array>
#include <cstdint>

namespace carom::theory {

struct SmallSystemPressure {
  std::int64_t disks;
  double packing_fraction;
  double pressure;  ///< P sigma^2 / kT
  double error;     ///< one standard error
};

inline constexpr std::array<SmallSystemPressure, 5> li_2022 = {{{72, 0.650, 6.901074, 0.000071},
                                                                {72, 0.660, 7.383221, 0.000087},
                                                                {72, 0.670, 7.85637, 0.00011},
                                                                {72, 0.680, 8.23631, 0.00034},
                                                                {224, 0.670, 7.979479, 0.000058}}};

}  // namespace carom::theory
