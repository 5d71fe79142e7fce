#pragma once
// Areas of the parts of a circular box: of cells, strips and rings.

#include "core/rectangle_bins.hpp"

#include <carom/box.hpp>

namespace carom {

/// Returns the area of a rectangle inside a circle, in closed form. The error is some 1e-16 of the area of the circle; a
/// rectangle that lies wholly inside has its own area to rounding, and one that lies outside 0. Requires a radius above 0.
[[nodiscard]] double area_in_circle(const Rectangle& rectangle, const Eigen::Vector2d& centre, double radius);

/// Returns the area of a rectangle inside the circle of the box. Requires a circular box.
[[nodiscard]] inline double area_in_circle(const Rectangle& rectangle, const Box& box) {
  return area_in_circle(rectangle, 0.5 * (box.lower + box.upper), 0.5 * box.lengths().x());
}

}  // namespace carom
