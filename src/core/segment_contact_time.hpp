#pragma once
// When does a disk on a parabola, or a straight line, reach a straight segment? The places of its centre at contact are a
// stadium: two faces, one to each side, and a circle round each end. A face is a height that falls to zero while the centre is
// abreast of the segment; an end is a disk of radius zero, but only for a centre that is abreast of none of the segments that
// begin there.

#include "core/ballistic_contact_time.hpp"
#include "core/fall_time.hpp"

#include <cmath>

namespace carom {

/// A segment from `from` along the unit vector `along`; `to` is its other end.
template <class Real>
struct Segment {
  Vec2<Real> from;
  Vec2<Real> to;
  Vec2<Real> along;
  Real length;

  Segment(const Vec2<Real>& start, const Vec2<Real>& end) : from(start), to(end), along(end - start) {
    using std::sqrt;
    length = sqrt(along.squaredNorm());
    if (length > 0) along /= length;
  }
};

/// A point r + v t + g t^2/2 with a disk of radius + expansion t round it.
template <class Real>
struct DiskPath {
  Vec2<Real> r;
  Vec2<Real> v;
  Vec2<Real> g;
  Real radius;
  Real expansion;

  [[nodiscard]] Vec2<Real> at(Real t) const { return r + t * (v + (t / 2) * g); }
  /// Returns the rest of this path from time t on.
  [[nodiscard]] DiskPath after(Real t) const { return {at(t), v + t * g, g, radius + expansion * t, expansion}; }
};

/// Returns the time for which a disk in contact with a fixed point at the origin needs no impulse to pass it: 0, unless its
/// overlap on the way would be less than what rounding makes of the distance, 32 epsilon of it. The overlap after time t is c t
/// - b t^2/2, where c is the speed of approach and b > 0 the acceleration away, centrifugal and of flight; c^2 / 2b at most,
/// and none from 2c / b on.
template <class Real>
[[nodiscard]] Real grazing_duration(const DiskPath<Real>& path) {
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

/// A coordinate of a path along one direction: x + v t + a t^2/2.
template <class Real>
struct Coordinate {
  Real x;
  Real v;
  Real a;

  [[nodiscard]] Coordinate reversed() const { return {-x, -v, -a}; }
  [[nodiscard]] Coordinate less(Real y) const { return {x - y, v, a}; }
  [[nodiscard]] Real at(Real t) const { return x + t * (v + (t / 2) * a); }
  [[nodiscard]] Real rate(Real t) const { return v + t * a; }
  /// When it falls through zero, which it does at most once.
  [[nodiscard]] Real falls() const { return x > 0 ? fall_time(x, v, a) : return_time(x, v, a); }
};

/// A disk's path as seen from a segment.
template <class Real>
struct PathAtSegment {
  Coordinate<Real> abreast;  ///< of the centre along the segment, from 0 to `length` where it is abreast
  Coordinate<Real> height;   ///< to the left of it
  Real length;
  Real rounding;  ///< of the coordinates, at the start of the path

  PathAtSegment(const DiskPath<Real>& path, const Segment<Real>& segment) : length(segment.length) {
    using std::sqrt;
    const Vec2<Real> r = path.r - segment.from;
    const auto seen = [&](auto&& part) { return Coordinate<Real>{part(r), part(path.v), part(path.g)}; };
    abreast = seen([&](const Vec2<Real>& a) { return segment.along.dot(a); });
    height = seen([&](const Vec2<Real>& a) { return cross<Real>(segment.along, a); });
    rounding = 8 * epsilon<Real> * (sqrt(path.r.squaredNorm()) + sqrt(segment.from.squaredNorm()) + length);
  }

  /// Returns whether the centre is abreast at time t, or is not by no more than rounding.
  [[nodiscard]] bool is_abreast(Real t) const {
    using std::abs;
    const Real x = abreast.at(t);
    const Real slack = rounding + 8 * epsilon<Real> * t * (abs(abreast.v) + t / 2 * abs(abreast.a));
    return length > 0 && x >= -slack && x <= length + slack;
  }
  /// Returns whether the gap to the face that the centre is in front of shrinks at time t.
  [[nodiscard]] bool approaches(Real t, Real expansion) const {
    return (height.at(t) < 0 ? -height.rate(t) : height.rate(t)) < expansion;
  }
  /// Returns the time at which a centre that is abreast at the start no longer is, by more than rounding.
  [[nodiscard]] Real exit() const {
    const Real first = fall_time(abreast.x + 2 * rounding, abreast.v, abreast.a);
    const Real last = fall_time(length + 2 * rounding - abreast.x, -abreast.v, -abreast.a);
    return first < last ? first : last;
  }

  /// First contact with the face to the left, or that to the right; infinity where there is none.
  ///
  /// The face is touched where the height has fallen to the radius and the centre is abreast. A centre that comes abreast later
  /// and is too low by then counts, too: in exact arithmetic it has met the end before, but an end that it grazes may have been
  /// missed by rounding. Without that a disk could slip under a face at its seam with the end.
  [[nodiscard]] Real face_contact_time(const DiskPath<Real>& path, bool to_the_left) const {
    const Coordinate<Real> above = to_the_left ? height : height.reversed();
    const Coordinate<Real> gap{above.x - path.radius, above.v - path.expansion, above.a};
    const bool behind = to_the_left ? height.x < 0 : height.x >= 0;
    const Real t = behind ? return_time(gap.x, gap.v, gap.a) : fall_time(gap.x, gap.v, gap.a);
    if (!(t < infinity<Real>) || is_abreast(t)) return t;

    Real first = infinity<Real>;
    for (const Coordinate<Real>& outside : {abreast.less(length), abreast.reversed()}) {
      const Real entry = outside.falls();
      if (entry >= t && entry < first && gap.rate(entry) < 0 && above.at(entry) >= 0) first = entry;
    }
    return first;
  }
};

/// First time t >= 0 at which the disk is in contact with a face of the segment and the gap shrinks, or is about to. Zero where
/// it touches or overlaps already.
///
/// Error: with H = |r| + |from| + length + |v| t + |g| t^2/2 + radius + expansion t, the distance from the segment at the time t
/// returned differs from the radius by at most 32 u H for disks that are apart; so does it where contact is missed or invented.
template <class Real>
[[nodiscard]] Real face_contact_time(const DiskPath<Real>& path, const Segment<Real>& segment) {
  if (!(segment.length > 0)) return infinity<Real>;
  const PathAtSegment<Real> seen(path, segment);
  const bool left = seen.height.x >= 0;
  const Real front = seen.face_contact_time(path, left);
  if (seen.height.a == 0) return front;
  const Real back = seen.face_contact_time(path, !left);  // round the end and back
  return back < front ? back : front;
}

}  // namespace carom
