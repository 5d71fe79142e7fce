#pragma once
// Fixed disks and segments that disks bounce off: which of them a disk's path meets first, and where from it then moves on.
// Segments are hard from both sides and end in corners of radius zero.

#include "core/domain.hpp"
#include "effects/obstacle_bins.hpp"
#include "effects/obstacle_shapes.hpp"

#include <carom/effects.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

namespace carom {

template <class Real>
class Obstacles {
 public:
  using Meeting = ObstacleMeeting<Real>;

  Obstacles(const Box& box, const std::vector<Obstacle>& obstacles)
      : domain_(box), bins_(box, bounds_of(obstacles)), shapes_(domain_, bins_, obstacles) {}

  [[nodiscard]] bool empty() const { return shapes_.count() == 0; }
  [[nodiscard]] std::size_t bytes() const { return shapes_.bytes() + bins_.bytes(); }

  /// First meeting of a disk on the path r + v s + g s^2/2, 0 <= s <= until, its radius being radius + expansion s, with any
  /// obstacle; of meetings at the same time, with the obstacle of the lowest index. Disks that touch or overlap an obstacle and
  /// approach it meet it now; those that recede do not.
  ///
  /// radius > 0. r may lie beyond a periodic edge, and the path cross any number of them. `until` may be infinite, where weight
  /// acts only across walls: the path then ends where its centre leaves the box across a wall, or after 10^4 box lengths, and
  /// a disk that has met nothing by then meets nothing. Errors: those of contact_time and its kin.
  [[nodiscard]] Meeting next(const Vec2<Real>& r, const Vec2<Real>& v, const Vec2<Real>& g, Real radius, Real expansion,
                             Real until) const {
    if (empty()) return {};
    const DiskPath<Real> path{r, v, g, radius, expansion};
    Meeting first;
    bins_.follow(
        search_path(path, until),
        [&](std::int32_t o, const ObstacleBins::Image& image) { shapes_.meet(first, path, o, image, until); },
        [&first](double time) { return first.time <= Real(time); });
    return first;
  }

  /// Returns the vector to r from the nearest point of that obstacle's nearest image, for a disk obstacle from its centre: the
  /// line of centres at contact.
  [[nodiscard]] Vec2<Real> from_nearest_point(std::int32_t obstacle, const Vec2<Real>& r) const {
    using std::floor;
    using std::sqrt;
    const auto* segment = std::get_if<Segment<Real>>(&shapes_.shape(obstacle));
    const Vec2<Real> middle = segment ? Vec2<Real>((segment->from + segment->to) / Real(2))
                                      : std::get<typename ObstacleShapes<Real>::Disk>(shapes_.shape(obstacle)).centre;
    Vec2<Real> image = Vec2<Real>::Zero();  // in box lengths: the one whose middle is nearest
    for (int a = 0; a < 2; ++a)
      if (domain_.periodic[a]) image[a] = floor((r[a] - middle[a]) / domain_.length[a] + Real(0.5));
    Vec2<Real> best = shapes_.from_image(obstacle, r - image.cwiseProduct(domain_.length));
    if (!segment) return best;

    // Another image of a segment may be nearer than that, if not by more than its size and the distance found. Of images that are
    // equally near but for rounding, that which r is abreast of.
    const Real range = sqrt(best.squaredNorm()) + segment->length / 2;
    Vec2<Real> steps = Vec2<Real>::Zero();
    for (int a = 0; a < 2; ++a)
      if (domain_.periodic[a]) steps[a] = floor(range / domain_.length[a] + Real(0.5));
    const auto effort = [&](const Vec2<Real>& shifted, const Vec2<Real>& apart) {
      return apart.squaredNorm() * (abreast(*segment, shifted) ? 1 : 1 + 16 * epsilon<Real>);
    };
    Real least = effort(r - image.cwiseProduct(domain_.length), best);
    for (Real y = -steps[1]; y <= steps[1]; y += 1)
      for (Real x = -steps[0]; x <= steps[0]; x += 1) {
        const Vec2<Real> shifted = r - (image + Vec2<Real>(x, y)).cwiseProduct(domain_.length);
        const Vec2<Real> apart = shapes_.from_image(obstacle, shifted);
        if (const Real found = effort(shifted, apart); found < least) best = apart, least = found;
      }
    return best;
  }

 private:
  [[nodiscard]] static bool abreast(const Segment<Real>& segment, const Vec2<Real>& r) {
    const Real x = segment.along.dot(r - segment.from);
    return x >= 0 && x <= segment.length;
  }

  Domain<Real> domain_;
  ObstacleBins bins_;
  ObstacleShapes<Real> shapes_;
};

}  // namespace carom
