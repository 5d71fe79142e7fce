#pragma once
// When does a disk on a parabola, or a straight line, reach a circular arc? The centre at contact is on one of two arcs, outside
// and inside, or on a circle round an end. Outside, the distance from the arc's centre falls to the sum of the radii; inside, it
// rises to their difference. Either counts only where the centre is abreast: in the sector of the arc.

#include "core/ballistic_contact_time.hpp"
#include "core/segment_contact_time.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace carom {

/// First time t >= 0 at which |r + v t| = sigma - expansion t while the distance rises relative to that: a disk in a hollow
/// circle reaches the rim. Zero where it touches or overlaps the rim and approaches it or moves along it; for one that overlaps
/// the rim and recedes, when it comes back to it, at the earliest when it turns round. Infinity where it rests and keeps its
/// size.
///
/// r: from the centre of the circle (length); sigma > 0: the radius of the circle less that of the disk; expansion >= 0.
/// Error: with u = epsilon/2, the distance at the time returned differs from sigma - expansion t by at most 16 u (|r| + sigma +
/// (|v| + expansion) t) for disks inside, however nearly they graze the rim: c is a difference of lengths, and the two terms of
/// the discriminant, (r v)^2 and -a c, are positive.
template <class Real>
[[nodiscard]] Real inner_contact_time(const Vec2<Real>& r, const Vec2<Real>& v, Real sigma, Real expansion) {
  using std::sqrt;
  const Real b = r.dot(v) + sigma * expansion;  // half the rate at which |.|^2 - (.)^2 changes
  const Real a = v.squaredNorm() - expansion * expansion;
  const Real distance = sqrt(r.squaredNorm());
  const Real c = (distance - sigma) * (distance + sigma);
  if (c >= 0 && (b > 0 || (b == 0 && a > 0))) return 0;
  Real d;
  if (c <= 0) {
    d = b * b - a * c;
  } else {
    const Vec2<Real> w = v + (expansion / sigma) * r;
    const Real s = cross<Real>(r, v);
    d = sigma * sigma * w.squaredNorm() - s * s;
  }
  const Real root = d > 0 ? sqrt(d) : Real(0);
  if (b > 0) return -c / (root + b);
  return a > 0 ? (root - b) / a : infinity<Real>;
}

/// First time t in [0, until] at which a disk that falls crosses the distance sigma + expansion t, inward (`sign` is 1) or
/// outward (-1), and `counts(t)` is true; infinity for never. Disks that touch or overlap by rounding, and recede but turn back
/// before they are apart, cross it when they turn back. Requires |g| > 0, and sigma > 0. As in ballistic_contact_time, the zeros
/// of the rate are bracketed by those of its slope, and the crossings by the zeros of the rate. Error: as there.
template <class Real, class Counts>
[[nodiscard]] Real ballistic_crossing(const BallisticApproach<Real>& approach, int sign, Real until, const Counts& counts) {
  using std::abs;
  using std::sqrt;
  const Real side = Real(sign);
  const auto of_gap = [side](const ValueAndSlope<Real>& at) { return ValueAndSlope<Real>{side * at.value, side * at.slope}; };
  const auto rate = [&](Real t) { return of_gap(approach.rate(t)); };
  const auto receding_rate = [&](Real t) {
    const ValueAndSlope<Real> at = rate(t);
    return ValueAndSlope<Real>{-at.value, -at.slope};
  };
  const auto gap = [&](Real t) { return of_gap(approach.gap(t)); };

  BallisticApproach<Real> widest = approach;
  widest.expansion = abs(approach.expansion);
  const Real vanishes = approach.expansion < 0 ? approach.sigma / -approach.expansion : infinity<Real>;
  const Real end = std::min<Real>(widest.horizon(), vanishes);

  const auto contact_between = [&](Real top, Real bottom) -> Real {
    const Real distance = sqrt(approach.r.squaredNorm());
    const bool touches = top == 0 ? side * (distance - approach.sigma) <= 0 : !(gap(top).value > 0);
    if (touches) return top;
    if (until < bottom && rate(until).value < 0 && gap(until).value > approach.rounding(until)) return infinity<Real>;
    return gap(bottom).value > 0 ? infinity<Real> : bracketed_root<Real>(gap, top, bottom);
  };

  // `falling`: the gap shrinks, and has done so since `top`.
  const ValueAndSlope<Real> start = rate(Real(0));
  const Real bend_of_rate = side * approach.g.dot(approach.v);
  bool falling = start.value < 0 || (start.value == 0 && (start.slope < 0 || (start.slope == 0 && bend_of_rate < 0)));
  Real top = 0, from = 0;
  const auto [first_bend, second_bend] = approach.bends();
  for (const Real& bend : {first_bend, second_bend, end}) {
    const Real to = std::min<Real>(bend, end);
    if (!(to > from)) continue;
    const bool falls_at_end = rate(to).value < 0;
    if (!falling && falls_at_end) {
      top = bracketed_root<Real>(receding_rate, to, from);
      if (top > until) return infinity<Real>;
    } else if (falling && !falls_at_end) {
      const Real t = contact_between(top, bracketed_root<Real>(rate, to, from));
      if (t < infinity<Real>) {  // else it passes, and may come back
        if (t > until) return infinity<Real>;
        if (counts(t)) return t;
      }
    }
    falling = falls_at_end;
    from = to;
    if (from > until && !falling) return infinity<Real>;
  }
  if (!falling) return infinity<Real>;
  const Real t = contact_between(top, end);
  return t <= until && counts(t) ? t : infinity<Real>;
}

/// An arc of a circle, counterclockwise from the direction `first` to the direction `last`, which are unit vectors; `from` and
/// `to` are its ends.
template <class Real>
struct Arc {
  Vec2<Real> centre;
  Real radius;
  Vec2<Real> first;
  Vec2<Real> last;
  Vec2<Real> from;
  Vec2<Real> to;
  bool is_wide;    ///< more than half a circle
  bool is_closed;  ///< a full circle, which has no ends

  /// `span` is the angle from `start` to `end` in degrees, above 0 and at most 360 but for rounding.
  Arc(const Vec2<Real>& middle, Real size, const Vec2<Real>& start, const Vec2<Real>& end, double span)
      : centre(middle), radius(size), first(start), last(end), is_wide(span > 180.0), is_closed(span >= 360.0) {
    using std::sqrt;
    first /= sqrt(first.squaredNorm());
    last /= sqrt(last.squaredNorm());
    from = centre + radius * first;
    to = centre + radius * last;
  }

  /// Returns whether a centre is in the sector, of which these are the distances from the first and to the last edge.
  [[nodiscard]] bool contains(Real behind_first, Real before_last) const {
    if (is_closed) return true;
    return is_wide ? behind_first >= 0 || before_last >= 0 : behind_first >= 0 && before_last >= 0;
  }
};

/// A path as seen from an arc.
template <class Real>
class PathAtArc {
 public:
  PathAtArc(const DiskPath<Real>& path, const Arc<Real>& arc) : path_(path), arc_(arc) {
    using std::sqrt;
    path_.r -= arc.centre;
    const auto seen = [&](auto&& part) { return Coordinate<Real>{part(path_.r), part(path_.v), part(path_.g)}; };
    edges_[0] = seen([&](const Vec2<Real>& a) { return cross<Real>(arc.first, a); });
    edges_[1] = seen([&](const Vec2<Real>& a) { return cross<Real>(a, arc.last); });
    rounding_ = 8 * epsilon<Real> * (sqrt(path.r.squaredNorm()) + sqrt(arc.centre.squaredNorm()) + arc.radius);
  }

  /// Returns whether the centre is abreast at time t, or is not by no more than rounding.
  [[nodiscard]] bool is_abreast(Real t) const {
    return arc_.contains(edges_[0].at(t) + slack(edges_[0], t), edges_[1].at(t) + slack(edges_[1], t));
  }
  /// Returns whether the gap to the side of the arc that the centre is on shrinks at time t, or is about to.
  [[nodiscard]] bool approaches(Real t, Real /*expansion*/) const {
    const bool inside = is_inside(t);
    const ValueAndSlope<Real> rate = approach(inside).rate(t);
    return inside ? rate.value > 0 || (rate.value == 0 && rate.slope > 0) : rate.value < 0;
  }
  /// Returns the time at which a centre that is abreast at the start no longer is, by more than rounding.
  [[nodiscard]] Real exit() const {
    Real first = infinity<Real>;
    if (arc_.is_closed) return first;
    for (std::size_t e = 0; e < 2; ++e)
      for (const Real& t : zeros(edges_[e].less(-2 * rounding_)))
        if (t < first && edges_[e].rate(t) < 0 && changes_sector(e, t)) first = t;
    return first;
  }

  /// Returns the first time t in [0, until] at which the disk touches the arc between its ends while the gap shrinks.
  [[nodiscard]] Real contact_time(Real until) const {
    Real first = infinity<Real>;
    const auto take = [&](Real t) {
      if (t <= until && t < first) first = t;
    };
    take(outside_time(until));
    if (arc_.radius > path_.radius) take(inside_time(until));
    if (arc_.is_closed) return first;
    // A centre that becomes abreast while the disk overlaps has met the end before in exact arithmetic, but an end that it
    // grazes may have been missed by rounding. It does not slip past the arc.
    for (std::size_t e = 0; e < 2; ++e)
      for (const Real& t : zeros(edges_[e]))
        if (t < first && edges_[e].rate(t) > 0 && changes_sector(e, t) && overlaps(t) && approaches(t, path_.expansion)) take(t);
    return first;
  }

  /// Returns whether the centre is nearer to that of the arc than the arc is.
  [[nodiscard]] bool is_inside(Real t) const { return path_.at(t).squaredNorm() < arc_.radius * arc_.radius; }

 private:
  [[nodiscard]] Real slack(const Coordinate<Real>& edge, Real t) const {
    using std::abs;
    return rounding_ + 8 * epsilon<Real> * t * (abs(edge.v) + t / 2 * abs(edge.a));
  }
  [[nodiscard]] bool overlaps(Real t) const {
    using std::abs;
    using std::sqrt;
    return abs(sqrt(path_.at(t).squaredNorm()) - arc_.radius) < path_.radius + path_.expansion * t;
  }
  /// Returns whether the sign of the distance from edge e alone decides, at time t, whether the centre is abreast.
  [[nodiscard]] bool changes_sector(std::size_t e, Real t) const {
    const bool other = edges_[1 - e].at(t) >= 0;
    return arc_.is_wide ? !other : other;
  }
  /// Returns the times > 0 at which a coordinate is zero; infinity for one that there is not.
  [[nodiscard]] static std::array<Real, 2> zeros(const Coordinate<Real>& c) {
    using std::sqrt;
    std::array<Real, 2> times{infinity<Real>, infinity<Real>};
    const auto put = [&](std::size_t k, Real t) {
      if (t > 0 && t < infinity<Real>) times[k] = t;
    };
    if (c.a == 0) {
      if (c.v != 0) put(0, -c.x / c.v);
      return times;
    }
    const Real d = c.v * c.v - 2 * c.a * c.x;
    if (!(d > 0)) return times;
    const Real q = c.v > 0 ? -c.v - sqrt(d) : sqrt(d) - c.v;
    put(0, q / c.a);
    put(1, 2 * c.x / q);
    return times;
  }

  /// Distances from the centre of the arc against that at contact, which shrinks inside where the disk grows.
  [[nodiscard]] BallisticApproach<Real> approach(bool inside) const {
    return inside ? BallisticApproach<Real>{path_.r, path_.v, path_.g, arc_.radius - path_.radius, -path_.expansion}
                  : BallisticApproach<Real>{path_.r, path_.v, path_.g, arc_.radius + path_.radius, path_.expansion};
  }

  [[nodiscard]] Real outside_time(Real until) const {
    const BallisticApproach<Real> seen = approach(false);
    const auto counts = [&](Real t) {
      const DiskPath<Real> there = DiskPath<Real>{path_.r, path_.v, path_.g, seen.sigma, seen.expansion}.after(t);
      return !is_inside(t) && is_abreast(t) && grazing_duration(there) == 0;
    };
    if (path_.g.squaredNorm() > 0) return ballistic_crossing(seen, 1, until, counts);
    const Real t = carom::contact_time<Real>(seen.r, seen.v, seen.sigma, seen.expansion);
    return t <= until && counts(t) ? t : infinity<Real>;
  }
  [[nodiscard]] Real inside_time(Real until) const {
    const BallisticApproach<Real> seen = approach(true);
    const auto counts = [&](Real t) { return is_inside(t) && is_abreast(t); };
    if (path_.g.squaredNorm() > 0) return ballistic_crossing(seen, -1, until, counts);
    const Real t = inner_contact_time<Real>(seen.r, seen.v, seen.sigma, path_.expansion);
    return t <= until && counts(t) ? t : infinity<Real>;
  }

  DiskPath<Real> path_;  ///< seen from the centre of the arc
  const Arc<Real>& arc_;
  std::array<Coordinate<Real>, 2> edges_;  ///< to the left of the first edge of the sector, and to the right of the last
  Real rounding_;                          ///< of the coordinates, at the start of the path
};

}  // namespace carom
