#pragma once
// Hard disks in a channel so narrow that they cannot pass each other, and that a disk touches its two neighbours alone: solved
// exactly by a transfer matrix (Montero & Santos, arXiv:2212.08932 (2022) and 2304.14290 (2023)). The units are the diameter and
// kT. Derived in docs/validation.md.

#include <cstdint>

namespace carom::theory {

/// The mean forces of a single file.
struct SingleFile {
  double force;          ///< on a cross-section of the channel, along it
  double wall_pressure;  ///< force on one wall per length
};

/// Forces in the limit of many disks. `width` is the distance of the walls' faces, 1 < width < 1 + sqrt(3) / 2; `length` that of
/// the channel per disk, more than the sqrt(1 - (width - 1)^2) of a zigzag at close packing: enough more for a force below 200.
/// Throws std::invalid_argument outside.
[[nodiscard]] SingleFile single_file(double width, double length);

/// Forces for this number of disks in a channel that is periodic along its length, up to terms of 1/N^2: the length is fixed,
/// where the transfer matrix fixes the force, which adds terms of 1/N. Requires disks > 0.
[[nodiscard]] SingleFile single_file(double width, double length, std::int64_t disks);

}  // namespace carom::theory
