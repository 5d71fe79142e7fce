#pragma once
// Where equations of state hold for a number of equal disks in a box, to 0.2 %.

#include <carom/scene.hpp>

#include <cstdint>
#include <optional>

namespace carom::theory {

/// From so many disks on, Z of infinitely many is good to 0.2 % at packing fractions between densest_finite and densest_fluid: it
/// is 2 % more than that of 144 disks at 0.69, and the difference falls as 1/N.
inline constexpr std::int64_t many_dense_disks = 2000;

/// Returns whether a periodic box is so wide that its shape, and terms beyond the first in 1/N, matter less than 0.1 % to Z: in a
/// narrower one disks meet images of their own neighbours. Runs of 9 to 144 disks in squares, with 20 million collisions each,
/// differ by 0.05 % in boxes of 6.6 diameters at 0.45, 0.2 % in those of 5; at 0.62 by 0.0 % of 11.3, 0.2 % of 9, 0.8 % of 6.8.
[[nodiscard]] bool is_wide(const Box& box, double sigma, double eta);

struct FluidZ {
  double value = 0.0;
  bool of_so_many = true;  ///< disks; else of infinitely many
};

/// Returns Z of a fluid of so many equal disks in a wide periodic box; nothing where no equation of state is good to 0.2 %.
[[nodiscard]] std::optional<FluidZ> fluid_Z(double eta, std::int64_t disks);

}  // namespace carom::theory
