#pragma once
// Energy, momentum and temperature of a state.

#include <carom/box.hpp>
#include <carom/state.hpp>

#include <Eigen/Core>

namespace carom {

/// sum of m v^2 / 2
[[nodiscard]] double kinetic_energy(const Disks& disks, const State& state);

/// sum of m v
[[nodiscard]] Eigen::Vector2d total_momentum(const Disks& disks, const State& state);

/// kT = 2 K' / f: K' is the kinetic energy without that of the common motion along periodic axes, whose momentum no
/// collision changes, and f = 2 N minus the number of such axes. 0 where no degree of freedom is left.
[[nodiscard]] double kinetic_temperature(const Box& box, const Disks& disks, const State& state);

}  // namespace carom
