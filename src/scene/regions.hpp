#pragma once
// The part of the box in which the disks of a species are put at random: a rectangle or a circle.

#include "core/rectangle_bins.hpp"

#include <carom/scene.hpp>

#include <numbers>
#include <variant>

namespace carom::detail {

using Region = std::variant<RectangleRegion, CircleRegion>;

/// Returns the rectangle round a region.
[[nodiscard]] inline Rectangle bounds_of(const Region& region) {
  if (const auto* rectangle = std::get_if<RectangleRegion>(&region)) return {rectangle->lower, rectangle->upper};
  const auto& circle = std::get<CircleRegion>(region);
  const Eigen::Vector2d radius = Eigen::Vector2d::Constant(circle.radius);
  return {circle.centre - radius, circle.centre + radius};
}

[[nodiscard]] inline double area_of(const Region& region) {
  if (const auto* rectangle = std::get_if<RectangleRegion>(&region)) return (rectangle->upper - rectangle->lower).prod();
  const double radius = std::get<CircleRegion>(region).radius;
  return std::numbers::pi * radius * radius;
}

/// Returns whether a disk lies in the region, nowhere across its edge. Requires that it lies in bounds_of() of it.
[[nodiscard]] inline bool holds_disk(const Region& region, const Eigen::Vector2d& position, double radius) {
  const auto* circle = std::get_if<CircleRegion>(&region);
  return circle == nullptr || (position - circle->centre).norm() <= circle->radius - radius;
}

}  // namespace carom::detail
