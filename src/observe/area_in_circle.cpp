// The area of polygon and circle together is a sum over the sides of the polygon, as the centre sees them: of a part of a side
// inside the circle the triangle under it, of a part outside the sector.

#include "observe/area_in_circle.hpp"

#include "core/vec2.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace carom {

namespace {

/// Returns the area between the centre, at the origin, and the side from a to b, positive where it runs counterclockwise.
double area_under(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double radius) {
  const auto sector = [radius](const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    return 0.5 * radius * radius * std::atan2(cross<double>(from, to), from.dot(to));
  };
  const Eigen::Vector2d along = b - a;
  const double square = along.squaredNorm();
  if (!(square > 0.0)) return 0.0;
  const double nearest = -a.dot(along) / square, height = cross<double>(along, a) / std::sqrt(square);
  const double under_root = radius * radius - height * height;
  const double half = under_root > 0.0 ? std::sqrt(under_root / square) : 0.0;
  const double enters = std::max(nearest - half, 0.0), leaves = std::min(nearest + half, 1.0);
  if (!(enters < leaves)) return sector(a, b);
  const Eigen::Vector2d first = a + enters * along, last = a + leaves * along;
  double area = 0.5 * cross<double>(first, last);
  if (enters > 0.0) area += sector(a, first);
  if (leaves < 1.0) area += sector(last, b);
  return area;
}

}  // namespace

double area_in_circle(const Rectangle& rectangle, const Eigen::Vector2d& centre, double radius) {
  const Eigen::Vector2d low = rectangle.lower - centre, high = rectangle.upper - centre;
  const Eigen::Vector2d nearest = low.cwiseMax(0.0).cwiseMin(high);
  if (!(nearest.norm() < radius)) return 0.0;
  const std::array<Eigen::Vector2d, 4> corners = {low, Eigen::Vector2d(high.x(), low.y()), high,
                                                  Eigen::Vector2d(low.x(), high.y())};
  if (std::ranges::all_of(corners, [radius](const Eigen::Vector2d& corner) { return corner.norm() <= radius; }))
    return (high - low).prod();
  double area = 0.0;
  for (std::size_t k = 0; k < 4; ++k) area += area_under(corners[k], corners[(k + 1) % 4], radius);
  return std::max(area, 0.0);
}

}  // namespace carom
