#pragma once
// The four sides of the box by axis and end.

#include <carom/state.hpp>

#include <cstddef>

namespace carom {

/// Returns the axis that a wall is across: 0 for left and right, 1 for bottom and top.
[[nodiscard]] constexpr int axis_of(Wall wall) { return wall >= wall_right ? 0 : 1; }
/// Returns whether it is the upper one of its axis: right or top.
[[nodiscard]] constexpr bool is_upper(Wall wall) { return wall == wall_right || wall == wall_top; }
/// Left, right, bottom, top: 0 to 3.
[[nodiscard]] constexpr std::size_t index_of(Wall wall) { return static_cast<std::size_t>(-1 - wall); }
[[nodiscard]] constexpr Wall wall_of(int axis, bool upper) { return static_cast<Wall>(wall_left - 2 * axis - (upper ? 1 : 0)); }

}  // namespace carom
