#pragma once
// Fixed disks and segments that disks bounce off: which of them a disk's path meets first, and where from it then moves on.
// Segments are hard from both sides and end in corners of radius zero.

#include "core/domain.hpp"
#include "core/rectangle_bins.hpp"
#include "core/segment_contact_time.hpp"
#include "scene/fixed_shapes.hpp"

#include <carom/effects.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <variant>
#include <vector>

namespace carom {

template <class Real>
struct ObstacleMeeting {
  Real time = infinity<Real>;  ///< from the start of the path
  std::int32_t obstacle = -1;
};

/// A path as bins see it.
template <class Real>
[[nodiscard]] SearchPath search_path(const DiskPath<Real>& path, Real until) {
  const auto in_double = [](const Vec2<Real>& a) {
    return Eigen::Vector2d(static_cast<double>(a.x()), static_cast<double>(a.y()));
  };
  return {in_double(path.r),
          in_double(path.v),
          in_double(path.g),
          static_cast<double>(path.radius),
          static_cast<double>(path.expansion),
          static_cast<double>(until),
          std::max(static_cast<double>(epsilon<Real>), 0x1p-52)};
}

/// What a disk may meet, one obstacle and one image at a time: fixed disks, and segments whose ends may be joined.
template <class Real>
class ObstacleShapes {
 public:
  using Image = RectangleBins::Image;
  using Meeting = ObstacleMeeting<Real>;
  struct Disk {
    Vec2<Real> centre;
    Real radius;
  };
  using Shape = std::variant<Disk, Segment<Real>>;

  ObstacleShapes(const Domain<Real>& domain, const RectangleBins& bins, const std::vector<Obstacle>& obstacles)
      : length_(domain.length) {
    for (const Obstacle& obstacle : obstacles) {
      if (const auto* disk = std::get_if<DiskObstacle>(&obstacle)) {
        shapes_.push_back(Disk{disk->centre.cast<Real>(), Real(disk->radius)});
      } else {
        const auto& segment = std::get<SegmentObstacle>(obstacle);
        shapes_.push_back(Segment<Real>(segment.from.cast<Real>(), segment.to.cast<Real>()));
      }
    }
    find_joints(bins);
  }

  [[nodiscard]] std::int32_t count() const { return static_cast<std::int32_t>(shapes_.size()); }
  [[nodiscard]] std::size_t bytes() const {
    std::size_t sum = shapes_.capacity() * sizeof(Shape) + joints_.capacity() * sizeof(joints_[0]);
    for (const auto& joints : joints_) sum += joints.capacity() * sizeof(Joint);
    return sum;
  }
  [[nodiscard]] const Shape& shape(std::int32_t o) const { return shapes_[static_cast<std::size_t>(o)]; }

  /// Keeps the meeting with an image of obstacle o, by `until`, if it comes before the first one so far.
  void meet(Meeting& first, const DiskPath<Real>& path, std::int32_t o, const Image& image, Real until) const {
    DiskPath<Real> seen = path;
    seen.r -= shift(image);
    if (const auto* disk = std::get_if<Disk>(&shape(o))) {
      return take(first,
                  point_contact_time({seen.r - disk->centre, path.v, path.g, disk->radius + path.radius, path.expansion}, until),
                  o);
    }
    const auto& segment = std::get<Segment<Real>>(shape(o));
    if (const Real t = face_contact_time(seen, segment); t <= until) take(first, t, o);
    meet_end(first, seen, segment.from, joints_[2 * static_cast<std::size_t>(o)], until);
    meet_end(first, seen, segment.to, joints_[2 * static_cast<std::size_t>(o) + 1], until);
  }

  /// Returns the vector to r from the nearest point of obstacle o itself, not of an image; for a disk, from its centre. In front
  /// of a face exactly across it: rounding does not turn the velocity along it.
  [[nodiscard]] Vec2<Real> from_image(std::int32_t o, const Vec2<Real>& r) const {
    if (const auto* disk = std::get_if<Disk>(&shape(o))) return r - disk->centre;
    const auto& segment = std::get<Segment<Real>>(shape(o));
    const Vec2<Real> from = r - segment.from;
    const Real x = segment.along.dot(from);
    if (!(x > 0)) return from;
    if (x > segment.length) return r - segment.to;
    return cross<Real>(segment.along, from) * Vec2<Real>(-segment.along.y(), segment.along.x());
  }

 private:
  /// A segment that an end touches, and the image of it that does.
  struct Joint {
    std::int32_t segment;
    Image image;
  };

  [[nodiscard]] Vec2<Real> shift(const Image& image) const {
    return Vec2<Real>(Real(image[0]), Real(image[1])).cwiseProduct(length_);
  }

  /// When a disk on a path comes to a fixed point at the origin, by `until`; else infinity. A disk that would pass within
  /// rounding of contact passes: between two obstacles whose gap is exactly as wide as the disk it would bounce without end.
  [[nodiscard]] static Real point_contact_time(DiskPath<Real> path, Real until) {
    Real start = 0;
    while (start <= until) {
      const Real t = ballistic_contact_time<Real>(path.r, path.v, path.g, path.radius, path.expansion, until - start);
      if (!(t < infinity<Real>)) break;
      start += t;
      path = path.after(t);
      const Real pass = grazing_duration(path);
      if (pass == 0) return start;
      start += pass;
      path = path.after(pass);
    }
    return infinity<Real>;
  }

  /// Returns the time for which a disk in contact with a fixed point at the origin needs no impulse to pass it: 0, unless its
  /// overlap on the way would be less than what rounding makes of the distance, 32 epsilon of it. The overlap after time t is c t
  /// - b t^2/2, where c is the speed of approach and b > 0 the acceleration away, centrifugal and of flight; c^2 / 2b at most,
  /// and none from 2c / b on.
  [[nodiscard]] static Real grazing_duration(const DiskPath<Real>& path) {
    using std::sqrt;
    const Real distance = sqrt(path.r.squaredNorm());
    if (!(distance > 0)) return 0;
    const Vec2<Real> n = path.r / distance;
    const Real along = cross<Real>(n, path.v), approach = path.expansion - n.dot(path.v);
    const Real away = along * along / distance + n.dot(path.g);
    const Real rounding = 32 * epsilon<Real> * path.radius;
    if (!(away > 0) || approach * approach > 2 * away * rounding) return 0;
    return 2 * sqrt(2 * rounding / away);
  }

  static void take(Meeting& first, Real time, std::int32_t obstacle) {
    if (time < first.time || (time == first.time && obstacle < first.obstacle)) first = {time, obstacle};
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
      const Real t = point_contact_time({rest.r - end, rest.v, rest.g, rest.radius, rest.expansion}, until - start);
      if (!(t < infinity<Real>)) return;
      const Joint* passed = nullptr;
      for (const Joint& joint : joints) {
        const PathAtSegment<Real> seen = at_joint(rest, joint);
        if (!seen.is_abreast(t)) continue;
        if (seen.approaches(t, rest.expansion)) return take(first, start + t, joint.segment);
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

  void find_joints(const RectangleBins& bins) {
    joints_.resize(2 * shapes_.size());
    const Real close = std::max<Real>(Real(1e-12), 16 * epsilon<Real>) * (length_[0] + length_[1]);
    for (std::size_t o = 0; o < shapes_.size(); ++o) {
      const auto* segment = std::get_if<Segment<Real>>(&shapes_[o]);
      for (std::size_t end = 0; segment && end < 2; ++end) {
        joints_[2 * o + end].push_back({static_cast<std::int32_t>(o), {}});  // the first one is its own
        const Vec2<Real>& place = end == 0 ? segment->from : segment->to;
        const Vec2<Real> rest = Vec2<Real>::Zero();
        bins.follow(
            search_path<Real>({place, rest, rest, close, Real(0)}, Real(0)),
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

  Vec2<Real> length_;  ///< of the box
  std::vector<Shape> shapes_;
  std::vector<std::vector<Joint>> joints_;  ///< of each obstacle's two ends: its own segment, then the others
};

/// Which of the obstacles a path meets first, and where from it a disk then moves on.
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
        [&](std::int32_t o, const RectangleBins::Image& image) { shapes_.meet(first, path, o, image, until); },
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
  RectangleBins bins_;
  ObstacleShapes<Real> shapes_;
};

}  // namespace carom
