#pragma once
// The rectangular box that holds the disks.

#include <Eigen/Core>

#include <array>
#include <cstddef>

namespace carom {

/// The kind of the two sides across one axis of the box.
enum class Boundary { walls, periodic };

/// The rectangle [lower, upper], with the kind of boundary of each axis (x, y).
struct Box {
  Eigen::Vector2d lower = Eigen::Vector2d::Zero();
  Eigen::Vector2d upper = Eigen::Vector2d::Zero();
  std::array<Boundary, 2> boundary = {Boundary::walls, Boundary::walls};

  [[nodiscard]] Eigen::Vector2d lengths() const { return upper - lower; }
  [[nodiscard]] double area() const { return lengths().prod(); }
  [[nodiscard]] bool periodic(int axis) const { return boundary[static_cast<std::size_t>(axis)] == Boundary::periodic; }
};

}  // namespace carom
