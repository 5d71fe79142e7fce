#include "simulation/finite_state.hpp"

#include <fmt/format.h>

#include <cmath>

namespace carom::detail {

namespace {

template <class Columns>
std::string first_not_finite(const Columns& columns, const char* what) {
  if (columns.allFinite()) return {};
  for (Eigen::Index i = 0; i < columns.cols(); ++i)
    if (!columns.col(i).allFinite()) return fmt::format("disk {}: its {} is not finite", i, what);
  return {};
}

}  // namespace

std::string not_finite(const State& state) {
  for (const std::string& found : {first_not_finite(state.velocities, "velocity"), first_not_finite(state.positions, "position"),
                                   first_not_finite(state.spins.transpose(), "spin")})
    if (!found.empty()) return found;
  for (const WallState& wall : state.walls)
    if (!std::isfinite(wall.position) || !std::isfinite(wall.velocity)) return "the place or speed of a wall is not finite";
  if (!std::isfinite(state.scale)) return "the size of the disks is not finite";
  if (!std::isfinite(state.time) || !std::isfinite(state.shear_displacement)) return "the clock is not finite";
  return {};
}

}  // namespace carom::detail
