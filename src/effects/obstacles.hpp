#pragma once
// Fixed disks and segments that disks bounce off: which of them a disk's path meets first, and where from it then moves on.
// Segments are hard from both sides and end in corners of radius zero.

#include "core/domain.hpp"
#include "core/segment_contact_time.hpp"
#include "effects/obstacle_bins.hpp"

#include <carom/effects.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

namespace carom {

template <class Real>
class Obstacles {
 public:
  struct Meeting {
    Real time = infinity<Real>;  ///< from the start of the path
    std::int32_t obstacle = -1;
  };

  Obstacles(const Box& box, const std::vector<Obstacle>& obstacles)
      : domain_(box), rounding_(static_cast<double>(epsilon<Real>)), bins_(box, bounds_of(obstacles)) {
    for (const Obstacle& obstacle : obstacles) {
      if (const auto* disk = std::get_if<DiskObstacle>(&obstacle.shape)) {
        shapes_.push_back(Disk{disk->centre.cast<Real>(), Real(disk->radius)});
      } else {
        const auto& segment = std::get<SegmentObstacle>(obstacle.shape);
        shapes_.push_back(Segment<Real>(segment.from.cast<Real>(), segment.to.cast<Real>()));
      }
    }
    find_joints();
  }

  [[nodiscard]] bool empty() const { return shapes_.empty(); }

  /// First meeting of a disk on the path r + v s + g s^2/2, 0 <= s <= until, its radius being radius + growth s, with any
  /// obstacle; of meetings at the same time, with the obstacle of the lowest index. Disks that touch or overlap an obstacle and
  /// approach it meet it now; those that recede do not.
  ///
  /// radius > 0. r may lie beyond a periodic edge, and the path cross any number of them. `until` may be infinite, where gravity
  /// acts only across walls: the path then ends where its centre leaves the box across a wall, or after 10^4 box lengths, and
  /// a disk that has met nothing by then meets nothing. Errors: those of contact_time and its kin.
  [[nodiscard]] Meeting next(const Vec2<Real>& r, const Vec2<Real>& v, const Vec2<Real>& g, Real radius, Real growth,
                             Real until) const {
    if (empty()) return {};
    const DiskPath<Real> path{r, v, g, radius, growth};
    Meeting first;
    bins_.follow(
        search_path(path, until), [&](std::int32_t o, const ObstacleBins::Image& image) { meet(first, path, o, image, until); },
        [&first](double time) { return first.time <= Real(time); });
    return first;
  }

  /// The same by asking every obstacle about every image up to `images` box lengths away: what next() must agree with.
  [[nodiscard]] Meeting next_of_all(const Vec2<Real>& r, const Vec2<Real>& v, const Vec2<Real>& g, Real radius, Real growth,
                                    Real until, std::int64_t images) const {
    const DiskPath<Real> path{r, v, g, radius, growth};
    const std::int64_t columns = domain_.periodic[0] ? images : 0;
    const std::int64_t rows = domain_.periodic[1] ? images : 0;
    Meeting first;
    for (std::int32_t o = 0; o < static_cast<std::int32_t>(shapes_.size()); ++o)
      for (std::int64_t row = -rows; row <= rows; ++row)
        for (std::int64_t column = -columns; column <= columns; ++column) meet(first, path, o, {column, row}, until);
    return first;
  }

  /// From the nearest point of that obstacle's nearest image to r, of a disk obstacle from its centre: the line of centres at
  /// contact.
  [[nodiscard]] Vec2<Real> from_nearest_point(std::int32_t obstacle, const Vec2<Real>& r) const {
    using std::ceil;
    using std::floor;
    using std::sqrt;
    const Vec2<Real> middle = middle_of(obstacle);
    Vec2<Real> image = Vec2<Real>::Zero();  // in box lengths: the one whose middle is nearest
    for (int a = 0; a < 2; ++a)
      if (domain_.periodic[a]) image[a] = floor((r[a] - middle[a]) / domain_.length[a] + Real(0.5));
    Vec2<Real> best = from_image(obstacle, r - image.cwiseProduct(domain_.length));
    const auto* segment = std::get_if<Segment<Real>>(&shape(obstacle));
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
        const Vec2<Real> apart = from_image(obstacle, shifted);
        if (const Real found = effort(shifted, apart); found < least) best = apart, least = found;
      }
    return best;
  }

 private:
  using Image = ObstacleBins::Image;
  struct Disk {
    Vec2<Real> centre;
    Real radius;
  };
  using Shape = std::variant<Disk, Segment<Real>>;
  /// A segment that an end touches, and the image of it that does.
  struct Joint {
    std::int32_t segment;
    Image image;
  };
  [[nodiscard]] const Shape& shape(std::int32_t o) const { return shapes_[static_cast<std::size_t>(o)]; }

  [[nodiscard]] Vec2<Real> shift(const Image& image) const {
    return Vec2<Real>(Real(image[0]), Real(image[1])).cwiseProduct(domain_.length);
  }

  static void take(Meeting& first, Real time, std::int32_t obstacle) {
    if (time < first.time || (time == first.time && obstacle < first.obstacle)) first = {time, obstacle};
  }

  void meet(Meeting& first, const DiskPath<Real>& path, std::int32_t o, const Image& image, Real until) const {
    DiskPath<Real> seen = path;
    seen.r -= shift(image);
    if (const auto* disk = std::get_if<Disk>(&shape(o))) {
      const Real reach = disk->radius + path.radius;
      return take(first, ballistic_contact_time<Real>(seen.r - disk->centre, path.v, path.g, reach, path.growth, until), o);
    }
    const auto& segment = std::get<Segment<Real>>(shape(o));
    if (const Real t = face_contact_time(seen, segment); t <= until) take(first, t, o);
    meet_end(first, seen, segment.from, joints_[2 * static_cast<std::size_t>(o)], until);
    meet_end(first, seen, segment.to, joints_[2 * static_cast<std::size_t>(o) + 1], until);
  }

  /// Meetings with an end, at which the given segments are joined. A disk whose centre is abreast of one of them has its face in
  /// front of it, not the end, although within the root of the rounding from the seam it touches both. So that segment was met,
  /// if the disk approaches it; if not, nothing was, and the search goes on from where it is no longer abreast. Thus a joint of
  /// collinear segments leaves no trace, and a disk that slides along one does not trip over its end.
  void meet_end(Meeting& first, const DiskPath<Real>& path, const Vec2<Real>& end, const std::vector<Joint>& joints,
                Real until) const {
    Real start = 0;
    DiskPath<Real> rest = path;
    for (std::size_t tries = 0; tries < 2 + 2 * joints.size(); ++tries) {
      const Real t = ballistic_contact_time<Real>(rest.r - end, rest.v, rest.g, rest.radius, rest.growth, until - start);
      if (!(t < infinity<Real>)) return;
      const Joint* passed = nullptr;
      for (const Joint& joint : joints) {
        const PathAtSegment<Real> seen = at_joint(rest, joint);
        if (!seen.is_abreast(t)) continue;
        if (seen.approaches(t, rest.growth)) return take(first, start + t, joint.segment);
        if (!passed) passed = &joint;
      }
      if (!passed) return take(first, start + t, joints.front().segment);

      const DiskPath<Real> from_here = rest.after(t);
      const Real exit = t + at_joint(from_here, *passed).exit();
      if (!(start + exit <= until)) return;
      rest = rest.after(exit);
      start += exit;
    }
  }

  [[nodiscard]] PathAtSegment<Real> at_joint(const DiskPath<Real>& path, const Joint& joint) const {
    DiskPath<Real> seen = path;
    seen.r -= shift(joint.image);
    return {seen, std::get<Segment<Real>>(shape(joint.segment))};
  }

  [[nodiscard]] static bool abreast(const Segment<Real>& segment, const Vec2<Real>& r) {
    const Real x = segment.along.dot(r - segment.from);
    return x >= 0 && x <= segment.length;
  }

  void find_joints() {
    joints_.resize(2 * shapes_.size());
    const Real close = Real(1e-12) * (domain_.length[0] + domain_.length[1]);
    for (std::size_t o = 0; o < shapes_.size(); ++o) {
      const auto* segment = std::get_if<Segment<Real>>(&shapes_[o]);
      for (std::size_t end = 0; segment && end < 2; ++end) {
        joints_[2 * o + end].push_back({static_cast<std::int32_t>(o), {}});  // the first one is its own
        const Vec2<Real>& place = end == 0 ? segment->from : segment->to;
        const Vec2<Real> rest = Vec2<Real>::Zero();
        bins_.follow(
            search_path({place, rest, rest, close, Real(0)}, Real(0)),
            [&](std::int32_t other, const Image& image) {
              const bool itself = other == static_cast<std::int32_t>(o) && image == Image{};
              if (itself || !std::holds_alternative<Segment<Real>>(shape(other))) return;
              if (from_image(other, place - shift(image)).squaredNorm() <= close * close)
                joints_[2 * o + end].push_back({other, image});
            },
            [](double) { return true; });
        std::sort(joints_[2 * o + end].begin() + 1, joints_[2 * o + end].end(),
                  [](const Joint& a, const Joint& b) { return std::tie(a.segment, a.image) < std::tie(b.segment, b.image); });
      }
    }
  }

  [[nodiscard]] Vec2<Real> middle_of(std::int32_t o) const {
    if (const auto* segment = std::get_if<Segment<Real>>(&shape(o))) return (segment->from + segment->to) / Real(2);
    return std::get<Disk>(shape(o)).centre;
  }

  /// In front of a face exactly across it: rounding does not turn the velocity along it.
  [[nodiscard]] Vec2<Real> from_image(std::int32_t o, const Vec2<Real>& r) const {
    if (const auto* disk = std::get_if<Disk>(&shape(o))) return r - disk->centre;
    const auto& segment = std::get<Segment<Real>>(shape(o));
    const Vec2<Real> from = r - segment.from;
    const Real x = segment.along.dot(from);
    if (!(x > 0)) return from;
    if (x > segment.length) return r - segment.to;
    return cross<Real>(segment.along, from) * Vec2<Real>(-segment.along.y(), segment.along.x());
  }

  [[nodiscard]] SearchPath search_path(const DiskPath<Real>& path, Real until) const {
    const auto in_double = [](const Vec2<Real>& a) {
      return Eigen::Vector2d(static_cast<double>(a.x()), static_cast<double>(a.y()));
    };
    return {in_double(path.r),
            in_double(path.v),
            in_double(path.g),
            static_cast<double>(path.radius),
            static_cast<double>(path.growth),
            static_cast<double>(until),
            std::max(rounding_, 0x1p-52)};
  }

  static std::vector<ObstacleBounds> bounds_of(const std::vector<Obstacle>& obstacles) {
    std::vector<ObstacleBounds> bounds;
    for (const Obstacle& obstacle : obstacles) {
      if (const auto* disk = std::get_if<DiskObstacle>(&obstacle.shape)) {
        const Eigen::Vector2d radius = Eigen::Vector2d::Constant(disk->radius);
        bounds.push_back({disk->centre - radius, disk->centre + radius});
      } else {
        const auto& segment = std::get<SegmentObstacle>(obstacle.shape);
        bounds.push_back({segment.from.cwiseMin(segment.to), segment.from.cwiseMax(segment.to)});
      }
    }
    return bounds;
  }

  Domain<Real> domain_;
  double rounding_;
  ObstacleBins bins_;
  std::vector<Shape> shapes_;
  std::vector<std::vector<Joint>> joints_;  ///< of each obstacle's two ends: its own segment, then the others
};

}  // namespace carom
