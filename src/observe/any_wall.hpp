#pragma once

#include <carom/effects.hpp>

#include <algorithm>

namespace carom {

/// Returns whether a wall can be anywhere but where the scene puts it.
inline bool moves(const WallProperties& wall) { return wall.mass || wall.velocity.value_or(0.0) != 0.0; }
/// Returns whether the scene lets this wall move, even if its velocity is 0.
inline bool may_move(const WallProperties& wall) { return wall.mass || wall.velocity; }

/// Returns whether one of the four walls at least has a property.
template <class Property>
bool any_wall(const Effects& effects, Property property) {
  return std::any_of(effects.walls.begin(), effects.walls.end(), property);
}

}  // namespace carom
