#pragma once
// The fixed shapes of a scene as fixed-step methods meet them: obstacles, and the rim of a circular box after the last of them.
//
// Methods that look at the positions of a step alone find what a disk overlaps: a shape whose nearest point is nearer to the
// centre of the disk than its radius. The line from there to the centre is the normal, also where the centre has crossed a
// segment or an arc within the step: such a disk is then on its other side. The rim is met by a disk that reaches beyond it,
// however far.
//
// Methods that find contacts within a step ask for the first one on a flight, as engines do (effects/obstacles.hpp).

#include "core/vec2.hpp"
#include "effects/obstacles.hpp"
#include "scene/fixed_shapes.hpp"

#include <carom/box.hpp>
#include <carom/effects.hpp>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

namespace carom {

class StepShapes {
 public:
  StepShapes(const Box& box, const Effects& effects)
      : obstacles_(box, fixed_shapes(effects)),
        length_(box.lengths()),
        bins_(box, bounds_of(effects.obstacles)),
        shapes_(SimulationBox<double>(box), bins_, effects.obstacles),
        circle_(effects.circle),
        rim_(effects.circle ? static_cast<std::int32_t>(effects.obstacles.size()) : -1) {}

  struct Overlap {
    std::int32_t shape;
    Vec2<double> normal;  ///< of length 1, from the shape to the centre of the disk
    double depth;         ///< > 0
  };

  /// Calls f(overlap) for each shape that a disk at r overlaps, in their order. The rim of a circular box is overlapped by what
  /// is beyond `rim_margin` from it.
  template <class F>
  void for_overlaps(const Vec2<double>& r, double radius, double rim_margin, F&& f) const {
    std::vector<Overlap> found;
    bins_.follow(
        {r, Vec2<double>::Zero(), Vec2<double>::Zero(), radius, 0.0, 0.0, epsilon<double>},
        [&](std::int32_t shape, const RectangleBins::Image& image) {
          const Vec2<double> shift(static_cast<double>(image[0]), static_cast<double>(image[1]));
          const Vec2<double> from = shapes_.from_image(shape, r - shift.cwiseProduct(length_));
          const auto* disk = std::get_if<ObstacleShapes<double>::Disk>(&shapes_.shape(shape));
          const double distance = from.norm(), depth = radius + (disk != nullptr ? disk->radius : 0.0) - distance;
          if (depth > 0.0 && distance > 0.0) found.push_back({shape, from / distance, depth});
        },
        [](double) { return true; });
    std::sort(found.begin(), found.end(), [](const Overlap& a, const Overlap& b) { return a.shape < b.shape; });
    if (circle_) {
      const Vec2<double> from = r - circle_->centre;
      const double distance = from.norm(), depth = distance + rim_margin - circle_->radius;
      if (depth > 0.0 && distance > 0.0) found.push_back({rim_, -from / distance, depth});
    }
    for (const Overlap& overlap : found) f(overlap);
  }

  /// Returns the first contact on a flight of a time `until`.
  [[nodiscard]] ObstacleMeeting<double> next(const DiskPath<double>& path, double until) const {
    return obstacles_.next(path.r, path.v, path.g, path.radius, 0.0, until);
  }

  /// Reflects a disk that is in contact at r; returns the impulse that the shape takes.
  Vec2<double> bounce(std::int32_t shape, const Vec2<double>& r, Vec2<double>& v, const Vec2<double>& g, double mass,
                      double radius) const {
    return obstacles_.bounce(shape, r, v, g, mass, radius, 0.0).impulse;
  }

  /// Returns the part of an impulse away from the centre of the circular box, where the shape is its rim; else 0.
  [[nodiscard]] double on_rim(std::int32_t shape, const Vec2<double>& impulse, const Vec2<double>& r) const {
    return shape == rim_ ? impulse.dot((r - circle_->centre).normalized()) : 0.0;
  }
  [[nodiscard]] bool is_rim(std::int32_t shape) const { return shape == rim_; }

 private:
  Obstacles<double> obstacles_;  ///< with the rim
  Vec2<double> length_;          ///< of the box
  RectangleBins bins_;
  ObstacleShapes<double> shapes_;  ///< without the rim
  std::optional<Circle> circle_;
  std::int32_t rim_;  ///< the circle's index among the shapes; -1 without one
};

/// Returns the shapes of a scene; null where there are none.
[[nodiscard]] inline std::shared_ptr<const StepShapes> step_shapes(const Box& box, const Effects& effects) {
  if (effects.obstacles.empty() && !effects.circle) return nullptr;
  return std::make_shared<const StepShapes>(box, effects);
}

}  // namespace carom
