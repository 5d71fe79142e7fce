#pragma once
// The four walls of a scene: their names, axes and properties.

#include <carom/box.hpp>
#include <carom/effects.hpp>
#include <carom/state.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace carom {

/// The names of the walls in the order of Effects::walls. Wall w lies across axis w / 2, and is the upper one where w is odd.
inline constexpr std::array<const char*, 4> wall_names = {"left", "right", "bottom", "top"};

constexpr int axis_of_wall(std::size_t wall) { return static_cast<int>(wall / 2); }
constexpr bool is_upper_wall(std::size_t wall) { return wall % 2 == 1; }
/// Returns the edge of the box at which a wall stands.
inline double& edge_of(Box& box, std::size_t wall) { return (is_upper_wall(wall) ? box.upper : box.lower)[axis_of_wall(wall)]; }
inline double edge_of(const Box& box, std::size_t wall) {
  return (is_upper_wall(wall) ? box.upper : box.lower)[axis_of_wall(wall)];
}
/// Returns four walls at rest where the box ends, as a change leaves them that has stopped the last one which moved.
inline std::vector<WallState> walls_at_rest(const Box& box) {
  std::vector<WallState> walls;
  for (std::size_t wall = 0; wall < wall_names.size(); ++wall) walls.push_back({edge_of(box, wall), 0.0});
  return walls;
}

/// Returns whether a change has stopped the last wall that moved, so that the box is another than the `first`, and the state does
/// not say any more where walls are.
inline bool have_settled(const State& state, const Box& first, const Box& now) {
  return state.walls.empty() && (now.lower != first.lower || now.upper != first.upper);
}

/// Returns whether a wall can be anywhere but where the scene puts it.
inline bool moves(const WallProperties& wall) {
  return wall.mass || wall.velocity.value_or(0.0) != 0.0 || (wall.oscillation && wall.oscillation->moves());
}
/// Returns whether the scene lets this wall move, even if its velocity is 0.
inline bool may_move(const WallProperties& wall) { return wall.mass || wall.velocity || wall.oscillation; }

/// Returns how far inward of its start a wall is that has vibrated for some time, to the rounding of doubles.
double inward_after(const Oscillation& oscillation, double time);
/// Returns how far inward of its start a wall that vibrates comes. length, >= 0.
double inward_reach(const Oscillation& oscillation);
/// Returns how far two walls that face each other and vibrate come towards each other from where they start, as far as that
/// depends on their amplitudes. length, >= 0.
double joint_reach(const std::optional<Oscillation>& one, const std::optional<Oscillation>& other);

/// Returns whether one of the four walls at least has a property.
template <class Property>
bool any_wall(const Effects& effects, Property property) {
  return std::any_of(effects.walls.begin(), effects.walls.end(), property);
}

}  // namespace carom
