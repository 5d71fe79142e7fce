#pragma once
// Disks in a channel so narrow that they cannot pass each other, and that a disk meets its two neighbours alone: solved exactly
// by a transfer matrix (Montero & Santos, arXiv:2212.08932 (2022) and 2304.14290 (2023); with square wells arXiv:2402.15192
// (2024)). The units are the diameter and kT. Derived in docs/validation.md.

#include <carom/effects.hpp>

#include <cstdint>
#include <vector>

namespace carom::theory {

/// The mean forces and energy of a single file.
struct SingleFile {
  double force;          ///< on a cross-section of the channel, along it
  double wall_pressure;  ///< force on one wall per length
  double energy = 0.0;   ///< potential energy of a disk and the one before it
};

/// Forces in the limit of many disks. `width` is the distance of the walls' faces, 1 < width < 1 + sqrt(3) / 2; `length` that of
/// the channel per disk, more than the sqrt(1 - (width - 1)^2) of a zigzag at close packing: enough more for a force below 200.
/// `steps`: those of the pair potential, of rising widths in diameters, with energies in kT; a disk feels its second neighbours
/// no more than their cores where the last width is at most 2 sqrt(1 - (width - 1)^2). Throws std::invalid_argument outside.
[[nodiscard]] SingleFile single_file(double width, double length, const std::vector<PotentialStep>& steps = {});

/// Forces for this number of disks, 6 or more, in a channel that is periodic along its length. The length is fixed, where the
/// transfer matrix fixes the force: an integral over complex forces leads from one to the other. Takes milliseconds for tens and
/// hundreds of disks. Throws std::invalid_argument for fewer than 6.
[[nodiscard]] SingleFile single_file(double width, double length, std::int64_t disks,
                                     const std::vector<PotentialStep>& steps = {});

}  // namespace carom::theory
