// Where fixed shapes are: what engines need of them, without the reading of scenes.

#include "scene/fixed_shapes.hpp"

#include <cmath>
#include <numbers>

namespace carom {

std::vector<Obstacle> fixed_shapes(const Effects& effects) {
  std::vector<Obstacle> shapes = effects.obstacles;
  if (effects.circle) shapes.emplace_back(ArcObstacle{effects.circle->centre, effects.circle->radius, 0.0, 360.0});
  return shapes;
}

Eigen::Vector2d direction(double degrees) {
  const double turned = std::remainder(degrees, 360.0), quarters = std::round(turned / 90.0);
  const double rest = (turned - 90.0 * quarters) * std::numbers::pi / 180.0, c = std::cos(rest), s = std::sin(rest);
  switch (static_cast<int>(quarters)) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case -1:
      return {s, -c};
    default:
      return {-c, -s};
  }
}

bool spans(const ArcObstacle& arc, const Eigen::Vector2d& from) {
  const auto left_of = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x() >= 0.0; };
  if (arc.to - arc.from >= 360.0) return true;
  const bool behind_first = left_of(direction(arc.from), from), before_last = left_of(from, direction(arc.to));
  return arc.to - arc.from > 180.0 ? behind_first || before_last : behind_first && before_last;
}

Rectangle bounds_of(const ArcObstacle& arc) {
  Eigen::Vector2d lower = direction(arc.from).cwiseMin(direction(arc.to)),
                  upper = direction(arc.from).cwiseMax(direction(arc.to));
  for (const int axis : {0, 1})
    for (const double sign : {-1.0, 1.0}) {
      const Eigen::Vector2d extreme = sign * Eigen::Vector2d::Unit(axis);
      if (!spans(arc, extreme)) continue;
      lower = lower.cwiseMin(extreme);
      upper = upper.cwiseMax(extreme);
    }
  return {arc.centre + arc.radius * lower, arc.centre + arc.radius * upper};
}

}  // namespace carom
