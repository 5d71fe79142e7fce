#pragma once
// The room in which disks can grow before one of them fills the box.

#include <carom/box.hpp>

#include <algorithm>

namespace carom::detail {

/// A disk that grows between two walls bounces the faster the less room it has: the number of bounces until a gap is left is
/// proportional to 1 / gap, and infinite until it is filled. The box counts as filled where this share of it is left.
inline constexpr double room_left = 0x1p-16;

/// Returns the factor by which a radius can grow until the disk fills the box along an axis from wall to wall, to room_left, or
/// meets its own image.
[[nodiscard]] inline double growth_room(const Box& box, int axis, double radius) {
  return box.lengths()[axis] * (box.periodic(axis) ? 1.0 : 1.0 - room_left) / (2.0 * radius);
}
/// Returns the smaller growth_room() along both axes.
[[nodiscard]] inline double growth_room(const Box& box, double radius) {
  return std::min(growth_room(box, 0, radius), growth_room(box, 1, radius));
}

}  // namespace carom::detail
