#pragma once
// A gas of equal disks with weight, at one temperature.

#include <cstddef>
#include <vector>

namespace carom::theory {

/// Disks per area at heights (k + 1/2) height / steps, k = 0 ... steps - 1, from hydrostatics: d ln n / dy = -(m g / kT) / (Z +
/// eta Z'), with `per_floor` disks above each unit of length of the floor. `weight` is m g / kT, an inverse length; `height` that
/// of where centres can be. The equation of state is that of Kolafa and Rottner: requires a fluid at the floor.
[[nodiscard]] std::vector<double> barometer(double weight, double per_floor, double radius, double height, std::size_t steps);

}  // namespace carom::theory
