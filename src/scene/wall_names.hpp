#pragma once
// The four sides of the box in the order of Effects::walls: side w lies across axis w / 2, and is the upper one where w is odd.

#include <array>
#include <cstddef>

namespace carom {

inline constexpr std::array<const char*, 4> wall_names = {"left", "right", "bottom", "top"};

constexpr int axis_of_wall(std::size_t wall) { return static_cast<int>(wall / 2); }

}  // namespace carom
