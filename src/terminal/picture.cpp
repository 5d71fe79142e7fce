#include "terminal/picture.hpp"

#include "scene/fixed_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

namespace carom {

namespace {

std::string repeated(const char* sign, int times) {
  std::string text;
  for (int k = 0; k < times; ++k) text += sign;
  return text;
}

/// Shade of a speed: the fraction of disks that is slower, 1 - exp(-v^2 / <v^2>) in equilibrium, so that all colours are used
/// equally.
class SpeedShade {
 public:
  explicit SpeedShade(const State& state) {
    if (state.velocities.cols() == 0) return;
    const double mean = state.velocities.colwise().squaredNorm().mean();
    if (mean > 0.0 && std::isfinite(mean)) per_mean_ = 1.0 / mean;
  }
  [[nodiscard]] double operator()(const Eigen::Vector2d& velocity) const {
    return std::min(-std::expm1(-velocity.squaredNorm() * per_mean_), 1.0);
  }

 private:
  double per_mean_ = 0.0;
};

/// The place of a point of the box on the canvas.
class Placement {
 public:
  Placement(const Box& box, double scale) : box_(box), scale_(scale) {}
  [[nodiscard]] Eigen::Vector2d operator()(const Eigen::Vector2d& point) const {
    return scale_ * Eigen::Vector2d(point.x() - box_.lower.x(), box_.upper.y() - point.y());
  }
  [[nodiscard]] double length(double length) const { return scale_ * length; }

 private:
  Box box_;
  double scale_;
};

/// Returns the box as large as it will get: walls that move keep the picture's scale where they move inwards.
Box whole_box(const Scene& scene, const State& state) {
  Box whole = box_of(scene.box, state);
  whole.lower = whole.lower.cwiseMin(scene.box.lower);
  whole.upper = whole.upper.cwiseMax(scene.box.upper);
  return whole;
}

void draw_shape(DotCanvas& canvas, const Placement& place, const Obstacle& shape) {
  if (const auto* disk = std::get_if<DiskObstacle>(&shape)) {
    canvas.circle(place(disk->centre), place.length(disk->radius));
  } else if (const auto* segment = std::get_if<SegmentObstacle>(&shape)) {
    canvas.line(place(segment->from), place(segment->to));
  } else {
    const auto& arc = std::get<ArcObstacle>(shape);
    const int pieces = std::clamp(static_cast<int>(place.length(arc.radius) * (arc.to - arc.from) / 90.0), 8, 720);
    const auto point = [&](int k) {
      return place(arc.centre + arc.radius * direction(arc.from + (arc.to - arc.from) * k / pieces));
    };
    for (int k = 0; k < pieces; ++k) canvas.line(point(k), point(k + 1));
  }
}

/// Walls that have left the edge of the picture.
void draw_walls(DotCanvas& canvas, const Placement& place, const Box& whole, const Box& box) {
  for (int axis = 0; axis < 2; ++axis)
    for (const bool upper : {false, true}) {
      const double at = upper ? box.upper[axis] : box.lower[axis];
      if (at == (upper ? whole.upper : whole.lower)[axis]) continue;
      Eigen::Vector2d from = whole.lower, to = whole.upper;
      from[axis] = to[axis] = at;
      canvas.line(place(from), place(to));
    }
}

}  // namespace

std::vector<std::string> terminal_picture(const Scene& scene, const Disks& disks, const State& state, TextArea room,
                                          TerminalColours colours) {
  const Box whole = whole_box(scene, state);
  const Eigen::Vector2d lengths = whole.lengths();
  const double scale = std::min(2.0 * (room.columns - 2) / lengths.x(), 4.0 * (room.rows - 2) / lengths.y());
  DotCanvas canvas(std::clamp(static_cast<int>(std::ceil(0.5 * scale * lengths.x() - 1e-9)), 1, room.columns - 2),
                   std::clamp(static_cast<int>(std::ceil(0.25 * scale * lengths.y() - 1e-9)), 1, room.rows - 2));
  const Placement place(whole, scale);
  const SpeedShade shade(state);
  for (Eigen::Index i = 0; i < state.positions.cols(); ++i)
    canvas.disk(place(state.positions.col(i)), place.length(state.scale * disks.radius[static_cast<std::size_t>(i)]),
                shade(state.velocities.col(i)));
  for (const Obstacle& shape : fixed_shapes(scene.effects)) draw_shape(canvas, place, shape);
  draw_walls(canvas, place, whole, box_of(scene.box, state));

  const char* side = scene.box.periodic(0) ? "┊" : "│";
  const std::string edge = repeated(scene.box.periodic(1) ? "┈" : "─", canvas.width() / 2);
  std::vector<std::string> lines = {"┌" + edge + "┐"};
  for (const std::string& row : canvas.text(colours)) lines.push_back(side + row + side);
  lines.push_back("└" + edge + "┘");
  return lines;
}

}  // namespace carom
