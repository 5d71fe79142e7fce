#pragma once
// The rectangular box that holds the disks.

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <numbers>

namespace carom {

/// The kind of the two sides across one axis of the box.
enum class Boundary { walls, periodic };

/// The rectangle [lower, upper], with the kind of boundary of each axis (x, y); or the circle in that square.
struct Box {
  Eigen::Vector2d lower = Eigen::Vector2d::Zero();
  Eigen::Vector2d upper = Eigen::Vector2d::Zero();
  std::array<Boundary, 2> boundary = {Boundary::walls, Boundary::walls};
  /// Whether a circle, Effects::circle, holds the disks in the place of walls; [lower, upper] is the square round it.
  bool is_circle = false;

  [[nodiscard]] Eigen::Vector2d lengths() const { return upper - lower; }
  [[nodiscard]] double area() const { return lengths().prod() * (is_circle ? std::numbers::pi / 4.0 : 1.0); }
  [[nodiscard]] bool periodic(int axis) const { return boundary[static_cast<std::size_t>(axis)] == Boundary::periodic; }
};

}  // namespace carom
