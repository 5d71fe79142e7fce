#pragma once
// Pressures of systems of hard disks in a square periodic box: Li, Nishikawa, Hoellmer, Carillo, Maggs & Krauth, J. Chem. Phys.
// 157, 234111 (2022), and the data set that belongs to it (github.com/jellyfysh/HistoricDisks, DigitizedData/ThisWork.csv). They
// hold for that number of disks, without any correction for its being finite.

#include <array>
#include <cstdint>

namespace carom::theory {

struct ReferencePressure {
  std::int64_t disks;
  double packing_fraction;
  double pressure;  ///< P sigma^2 / kT
  double error;     ///< one standard error
};

/// Fluids.
inline constexpr std::array<ReferencePressure, 5> li_2022 = {{{72, 0.650, 6.901074, 0.000071},
                                                              {72, 0.660, 7.383221, 0.000087},
                                                              {72, 0.670, 7.85637, 0.00011},
                                                              {72, 0.680, 8.23631, 0.00034},
                                                              {224, 0.670, 7.979479, 0.000058}}};

/// 128^2 disks: the fluid that is about to freeze, and liquid and hexatic in one box.
inline constexpr std::array<ReferencePressure, 3> li_2022_transition = {
    {{16384, 0.698, 9.17405, 0.00049}, {16384, 0.708, 9.17630, 0.00074}, {16384, 0.716, 9.1587, 0.0010}}};

}  // namespace carom::theory
