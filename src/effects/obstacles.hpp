#pragma once
// Fixed disks, segments and arcs that disks bounce off: which of them a disk's path meets first, and where from it then moves on.
// Segments and arcs are hard from both sides and end in corners of radius zero. The rim of a circular box is an arc without ends.

#include "core/arc_contact_time.hpp"
#include "core/rectangle_bins.hpp"
#include "core/segment_contact_time.hpp"
#include "core/simulation_box.hpp"
#include "effects/rebound.hpp"
#include "scene/fixed_shapes.hpp"

#include <carom/effects.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <tuple>
#include <variant>
#include <vector>

namespace carom {

template <class Real>
struct ObstacleMeeting {
  Real time = infinity<Real>;  ///< from the start of the path
  std::int32_t obstacle = -1;
};

/// The obstacle that a disk overlaps deepest.
template <class Real>
struct ObstacleOverlap {
  std::int32_t obstacle = -1;
  Real depth = 0;    ///< contact distance minus distance; 0 where the disk overlaps none
  Real contact = 1;  ///< distance between the centre of the disk and that of a fixed disk, or the segment or arc, in contact
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

/// What a disk may meet, one obstacle and one image at a time: fixed disks, and segments and arcs whose ends may be joined.
template <class Real>
class ObstacleShapes {
 public:
  using Image = RectangleBins::Image;
  using Meeting = ObstacleMeeting<Real>;
  struct Disk {
    Vec2<Real> centre;
    Real radius;
  };
  using Shape = std::variant<Disk, Segment<Real>, Arc<Real>>;

  ObstacleShapes(const SimulationBox<Real>& domain, const RectangleBins& bins, const std::vector<Obstacle>& obstacles)
      : length_(domain.length) {
    for (const Obstacle& obstacle : obstacles) {
      if (const auto* disk = std::get_if<DiskObstacle>(&obstacle)) {
        shapes_.push_back(Disk{disk->centre.cast<Real>(), Real(disk->radius)});
      } else if (const auto* segment = std::get_if<SegmentObstacle>(&obstacle)) {
        shapes_.push_back(Segment<Real>(segment->from.cast<Real>(), segment->to.cast<Real>()));
      } else {
        const auto& arc = std::get<ArcObstacle>(obstacle);
        shapes_.push_back(Arc<Real>(arc.centre.cast<Real>(), Real(arc.radius), direction(arc.from).cast<Real>(),
                                    direction(arc.to).cast<Real>(), arc.to - arc.from));
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

  /// Keeps the overlap of a disk with an image of obstacle o, if it is deeper than the deepest one so far.
  void overlap(ObstacleOverlap<Real>& deepest, const Vec2<Real>& r, Real radius, std::int32_t o, const Image& image) const {
    using std::sqrt;
    const auto* disk = std::get_if<Disk>(&shape(o));
    const Real contact = disk ? radius + disk->radius : radius;
    const Real depth = contact - sqrt(from_image(o, r - shift(image)).squaredNorm());
    if (depth > deepest.depth) deepest = {o, depth, contact};
  }

  /// Keeps the meeting with an image of obstacle o, by `until`, if it comes before the first one so far.
  void meet(Meeting& first, const DiskPath<Real>& path, std::int32_t o, const Image& image, Real until) const {
    DiskPath<Real> seen = path;
    seen.r -= shift(image);
    if (const auto* disk = std::get_if<Disk>(&shape(o))) {
      return take(first,
                  point_contact_time({seen.r - disk->centre, path.v, path.g, disk->radius + path.radius, path.expansion}, until),
                  o);
    }
    if (const auto* segment = std::get_if<Segment<Real>>(&shape(o))) {
      if (const Real t = face_contact_time(seen, *segment); t <= until) take(first, t, o);
      return meet_ends(first, seen, *segment, o, until);
    }
    const auto& arc = std::get<Arc<Real>>(shape(o));
    if (const Real t = PathAtArc<Real>(seen, arc).contact_time(until); t <= until) take(first, t, o);
    if (!arc.is_closed) meet_ends(first, seen, arc, o, until);
  }

  /// Returns whether r is in front of the hollow side of obstacle o itself, not of an image.
  [[nodiscard]] bool is_in_hollow(std::int32_t o, const Vec2<Real>& r) const {
    const auto* arc = std::get_if<Arc<Real>>(&shape(o));
    if (!arc) return false;
    const Vec2<Real> from = r - arc->centre;
    return from.squaredNorm() < arc->radius * arc->radius &&
           arc->contains(cross<Real>(arc->first, from), cross<Real>(from, arc->last));
  }

  /// Returns the vector to r from the nearest point of obstacle o itself, not of an image; for a disk, from its centre. In front
  /// of a face exactly across it: rounding does not turn the velocity along it. In the hollow of an arc it points to the centre.
  [[nodiscard]] Vec2<Real> from_image(std::int32_t o, const Vec2<Real>& r) const {
    if (const auto* disk = std::get_if<Disk>(&shape(o))) return r - disk->centre;
    if (const auto* arc = std::get_if<Arc<Real>>(&shape(o))) return from_arc(*arc, r);
    const auto& segment = std::get<Segment<Real>>(shape(o));
    const Vec2<Real> from = r - segment.from;
    const Real x = segment.along.dot(from);
    if (!(x > 0)) return from;
    if (x > segment.length) return r - segment.to;
    return cross<Real>(segment.along, from) * Vec2<Real>(-segment.along.y(), segment.along.x());
  }

 private:
  /// A segment or an arc that an end touches, and the image of it that does.
  struct Joint {
    std::int32_t shape;
    Image image;
  };

  [[nodiscard]] static Vec2<Real> from_arc(const Arc<Real>& arc, const Vec2<Real>& r) {
    using std::sqrt;
    const Vec2<Real> from = r - arc.centre;
    if (!arc.contains(cross<Real>(arc.first, from), cross<Real>(from, arc.last))) {
      const Vec2<Real> one = r - arc.from, other = r - arc.to;
      return one.squaredNorm() <= other.squaredNorm() ? one : other;
    }
    const Real distance = sqrt(from.squaredNorm());
    if (!(distance > 0)) return -arc.radius * arc.first;  // as far from every point of it
    return ((distance - arc.radius) / distance) * from;
  }

  /// Returns what `ask` answers of a path as a segment or an arc at a joint sees it.
  template <class Ask>
  [[nodiscard]] auto at_joint(const DiskPath<Real>& path, const Joint& joint, const Ask& ask) const {
    DiskPath<Real> seen = path;
    seen.r -= shift(joint.image);
    if (const auto* arc = std::get_if<Arc<Real>>(&shape(joint.shape))) return ask(PathAtArc<Real>(seen, *arc));
    return ask(PathAtSegment<Real>(seen, std::get<Segment<Real>>(shape(joint.shape))));
  }

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

  static void take(Meeting& first, Real time, std::int32_t obstacle) {
    if (time < first.time || (time == first.time && obstacle < first.obstacle)) first = {time, obstacle};
  }

  template <class Ended>
  void meet_ends(Meeting& first, const DiskPath<Real>& path, const Ended& shape, std::int32_t o, Real until) const {
    meet_end(first, path, shape.from, joints_[2 * static_cast<std::size_t>(o)], until);
    meet_end(first, path, shape.to, joints_[2 * static_cast<std::size_t>(o) + 1], until);
  }

  /// Meetings with an end, at which the given segments and arcs are joined. A disk whose centre is abreast of one of them has its
  /// face in front of it, not the end, although within the root of the rounding from the seam it touches both. So that segment
  /// was met, if the disk approaches it; if not, nothing was, and the search goes on from where it is no longer abreast. Thus a
  /// joint of collinear segments leaves no trace, and a disk that slides along one does not trip over its end.
  void meet_end(Meeting& first, const DiskPath<Real>& path, const Vec2<Real>& end, const std::vector<Joint>& joints,
                Real until) const {
    Real start = 0;
    DiskPath<Real> rest = path;
    for (std::size_t tries = 0; tries < 2 + 2 * joints.size(); ++tries) {
      const Real t = point_contact_time({rest.r - end, rest.v, rest.g, rest.radius, rest.expansion}, until - start);
      if (!(t < infinity<Real>)) return;
      const Joint* passed = nullptr;
      for (const Joint& joint : joints) {
        if (!at_joint(rest, joint, [t](const auto& seen) { return seen.is_abreast(t); })) continue;
        if (at_joint(rest, joint, [&](const auto& seen) { return seen.approaches(t, rest.expansion); }))
          return take(first, start + t, joint.shape);
        if (!passed) passed = &joint;
      }
      if (!passed) return take(first, start + t, joints.front().shape);

      const DiskPath<Real> from_here = rest.after(t);
      const Real exit = t + at_joint(from_here, *passed, [](const auto& seen) { return seen.exit(); });
      if (!(start + exit <= until)) return;
      rest = rest.after(exit);
      start += exit;
    }
  }

  void find_joints(const RectangleBins& bins) {
    joints_.resize(2 * shapes_.size());
    for (std::size_t o = 0; o < shapes_.size(); ++o) {
      const auto* arc = std::get_if<Arc<Real>>(&shapes_[o]);
      if (const auto* segment = std::get_if<Segment<Real>>(&shapes_[o])) {
        join(bins, o, 0, segment->from);
        join(bins, o, 1, segment->to);
      } else if (arc && !arc->is_closed) {
        join(bins, o, 0, arc->from);
        join(bins, o, 1, arc->to);
      }
    }
  }

  /// Finds what touches an end of obstacle o.
  void join(const RectangleBins& bins, std::size_t o, std::size_t end, const Vec2<Real>& place) {
    const Real close = std::max<Real>(Real(1e-12), 16 * epsilon<Real>) * (length_[0] + length_[1]);
    std::vector<Joint>& joints = joints_[2 * o + end];
    joints.push_back({static_cast<std::int32_t>(o), {}});  // the first one is its own
    const Vec2<Real> rest = Vec2<Real>::Zero();
    bins.follow(
        search_path<Real>({place, rest, rest, close, Real(0)}, Real(0)),
        [&](std::int32_t other, const Image& image) {
          const bool itself = other == static_cast<std::int32_t>(o) && image == Image{};
          if (itself || std::holds_alternative<Disk>(shape(other))) return;
          if (from_image(other, place - shift(image)).squaredNorm() <= close * close) joints.push_back({other, image});
        },
        [](double) { return true; });
    std::sort(joints.begin() + 1, joints.end(),
              [](const Joint& a, const Joint& b) { return std::tie(a.shape, a.image) < std::tie(b.shape, b.image); });
  }

  Vec2<Real> length_;  ///< of the box
  std::vector<Shape> shapes_;
  std::vector<std::vector<Joint>> joints_;  ///< of each obstacle's two ends: itself, then the others
};

/// Which of the obstacles a path meets first, and where from it a disk then moves on.
template <class Real>
class Obstacles {
 public:
  using Meeting = ObstacleMeeting<Real>;

  Obstacles(const Box& box, const std::vector<Obstacle>& obstacles)
      : domain_(box), bins_(box, bounds_of(obstacles)), shapes_(domain_, bins_, obstacles) {}

  [[nodiscard]] bool empty() const { return shapes_.count() == 0; }
  [[nodiscard]] std::int32_t count() const { return shapes_.count(); }
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

  /// Returns the overlap of a disk at r with the obstacle that it overlaps deepest. Only the first
  /// `count` obstacles are looked at.
  [[nodiscard]] ObstacleOverlap<Real> deepest_overlap(const Vec2<Real>& r, Real radius, std::int32_t count) const {
    ObstacleOverlap<Real> deepest;
    const Vec2<Real> rest = Vec2<Real>::Zero();
    bins_.follow(
        search_path<Real>({r, rest, rest, radius, Real(0)}, Real(0)),
        [&](std::int32_t o, const RectangleBins::Image& image) {
          if (o < count) shapes_.overlap(deepest, r, radius, o, image);
        },
        [](double) { return true; });
    return deepest;
  }

  /// A disk at r meets an obstacle: changes its velocity. `g` is its acceleration.
  Bounce<Real> bounce(std::int32_t obstacle, const Vec2<Real>& r, Vec2<Real>& v, const Vec2<Real>& g, Real mass, Real radius,
                      Real expansion) const {
    const Nearest nearest = nearest_to(obstacle, r);
    Bounce<Real> bounce = bounce_off<Real>(nearest.vector, v, g, mass, radius, expansion);
    if (nearest.is_in_hollow)
      bounce.impulse -= mass * keep_off_hollow<Real>(nearest.vector, v, expansion, flattest_slope(obstacle, nearest.vector));
    return bounce;
  }

  /// Returns the vector to r from the nearest point of that obstacle's nearest image, for a disk obstacle from its centre: the
  /// line of centres at contact.
  [[nodiscard]] Vec2<Real> from_nearest_point(std::int32_t obstacle, const Vec2<Real>& r) const {
    return nearest_to(obstacle, r).vector;
  }

 private:
  /// Returns the slope at which a flight along the hollow side of an arc rises by 8 epsilon of the coordinates: 2^-24 for a point
  /// in a circle round the origin. `from` is the vector from the arc to the centre of the disk.
  [[nodiscard]] Real flattest_slope(std::int32_t obstacle, const Vec2<Real>& from) const {
    using std::abs;
    using std::sqrt;
    const auto& arc = std::get<Arc<Real>>(shapes_.shape(obstacle));
    const Real reach = arc.radius - sqrt(from.squaredNorm());  // the radius of its path along the arc
    const Real rounding = 16 * epsilon<Real> * (abs(arc.centre.x()) + abs(arc.centre.y()) + arc.radius);
    return rounding < reach / 4 ? sqrt(rounding / reach) : Real(0.5);
  }

  struct Nearest {
    Vec2<Real> vector;
    bool is_in_hollow = false;  ///< whether it is from the hollow side of an arc
  };

  [[nodiscard]] Nearest nearest_to(std::int32_t obstacle, const Vec2<Real>& r) const {
    using std::floor;
    using std::sqrt;
    const auto* segment = std::get_if<Segment<Real>>(&shapes_.shape(obstacle));
    const auto* arc = std::get_if<Arc<Real>>(&shapes_.shape(obstacle));
    const Vec2<Real> middle = segment ? Vec2<Real>((segment->from + segment->to) / Real(2))
                              : arc   ? arc->centre
                                      : std::get<typename ObstacleShapes<Real>::Disk>(shapes_.shape(obstacle)).centre;
    Vec2<Real> image = Vec2<Real>::Zero();  // in box lengths: the one whose middle is nearest
    for (int a = 0; a < 2; ++a)
      if (domain_.periodic[a]) image[a] = floor((r[a] - middle[a]) / domain_.length[a] + Real(0.5));
    Vec2<Real> best = shapes_.from_image(obstacle, r - image.cwiseProduct(domain_.length));
    if (!segment && !arc) return {best};

    // Another image of a segment or an arc may be nearer than that, if not by more than its size and the distance found. Of
    // images that are equally near but for rounding, that which r is abreast of.
    Vec2<Real> seen_from = r - image.cwiseProduct(domain_.length);
    const Real range = sqrt(best.squaredNorm()) + (segment ? segment->length / 2 : arc->radius);
    Vec2<Real> steps = Vec2<Real>::Zero();
    for (int a = 0; a < 2; ++a)
      if (domain_.periodic[a]) steps[a] = floor(range / domain_.length[a] + Real(0.5));
    const auto effort = [&](const Vec2<Real>& shifted, const Vec2<Real>& apart) {
      const bool in_front = segment ? abreast(*segment, shifted) : abreast(*arc, shifted);
      return apart.squaredNorm() * (in_front ? 1 : 1 + 16 * epsilon<Real>);
    };
    Real least = effort(seen_from, best);
    for (Real y = -steps[1]; y <= steps[1]; y += 1)
      for (Real x = -steps[0]; x <= steps[0]; x += 1) {
        const Vec2<Real> shifted = r - (image + Vec2<Real>(x, y)).cwiseProduct(domain_.length);
        const Vec2<Real> apart = shapes_.from_image(obstacle, shifted);
        if (const Real found = effort(shifted, apart); found < least) best = apart, least = found, seen_from = shifted;
      }
    return {best, shapes_.is_in_hollow(obstacle, seen_from)};
  }

  [[nodiscard]] static bool abreast(const Arc<Real>& arc, const Vec2<Real>& r) {
    const Vec2<Real> from = r - arc.centre;
    return arc.contains(cross<Real>(arc.first, from), cross<Real>(from, arc.last));
  }
  [[nodiscard]] static bool abreast(const Segment<Real>& segment, const Vec2<Real>& r) {
    const Real x = segment.along.dot(r - segment.from);
    return x >= 0 && x <= segment.length;
  }

  SimulationBox<Real> domain_;
  RectangleBins bins_;
  ObstacleShapes<Real> shapes_;
};

}  // namespace carom
