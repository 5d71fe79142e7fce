#pragma once
// What the textbook engine has round its disks, in any number type: how they fly and grow, the edges of the box, walls and
// obstacles. The fast engine has effects/world.hpp in its place.

#include "core/contact_time.hpp"
#include "core/running_totals.hpp"
#include "core/sides.hpp"
#include "effects/any_impact.hpp"
#include "effects/gravity.hpp"
#include "effects/obstacles.hpp"
#include "effects/rebound.hpp"
#include "effects/walls.hpp"
#include "engine/edges.hpp"
#include "neighbours/cell_grid.hpp"

#include <carom/box.hpp>
#include <carom/state.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace carom {

/// A disk as its last collision left it. One cache line in double precision.
template <class Real>
struct alignas(64) DiskRecord {
  Vec2<Real> r;  ///< position at time t
  Vec2<Real> v;
  Real t = 0;  ///< since the epoch
  Real radius = 0;
  Real mass = 0;
  std::uint32_t collisions = 0;  ///< so far; tells whether a plan with this disk still holds

  template <class Archive>
  void serialize(Archive& archive) {
    archive(r, v, t, radius, mass, collisions);
  }
};

/// The next wall or obstacle that a disk hits.
template <class Real>
struct BoundaryPlan {
  Real time = infinity<Real>;
  std::int32_t what = wall_left;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(time, what);
  }
};

template <class Real>
struct TextbookWorld {
  using Record = DiskRecord<Real>;

  TextbookWorld(const Box& box, const Effects& effects, const State& start, std::uint64_t seed)
      : edges(box, effects, start.shear_displacement),
        falling(effects.gravity),
        walls(box, effects.walls, seed),
        obstacles(box, fixed_shapes(effects)),
        scale_at_epoch(Real(start.scale)),
        expansion(effects.growth ? Real(effects.growth->rate) : Real(0)),
        circle(effects.circle),
        rim(effects.circle ? static_cast<std::int32_t>(effects.obstacles.size()) : -1) {
    walls.start_from(start.walls);
  }

  /// Position, velocity and radius of a disk at time t.
  [[nodiscard]] Vec2<Real> position(const Record& a, Real t) const { return falling.position(a.r, a.v, t - a.t); }
  [[nodiscard]] Vec2<Real> velocity(const Record& a, Real t) const { return falling.velocity(a.v, t - a.t); }
  [[nodiscard]] Real radius(const Record& a, Real t) const { return a.radius * scale(t); }
  /// The scale of all radii at time t.
  [[nodiscard]] Real scale(Real t) const { return scale_at_epoch + expansion * t; }

  /// The time from t on until disks i and j, at separation r with relative velocity v, meet at their hard cores or at an edge
  /// of the potential; infinity for never. `sigma` is their contact distance at scale 1.
  [[nodiscard]] Real time_to_contact(const AnyImpact<Real>& impact, std::int32_t i, std::int32_t j, const Vec2<Real>& r,
                                     const Vec2<Real>& v, Real sigma, Real t) const {
    if (const PairPotential<Real>& potential = impact.potential(); potential.present()) {
      const bool nearest = edges.domain().nearest(r);  // the potential reaches less than half the box
      return potential.next_time(nearest ? potential.step_of(i, j) : potential.outside(), r, v, sigma);
    }
    return contact_time<Real>(r, v, sigma * scale(t), sigma * expansion);
  }

  /// The time at which disk i leaves its cell, and the side that it crosses.
  [[nodiscard]] CellCrossing<Real> next_crossing(const CellGrid<Real>& grid, std::int32_t i, const Record& a, Real now) const {
    return falling.present() ? grid.next_crossing(i, position(a, now), velocity(a, now), falling.g, now)
                             : grid.next_crossing(i, a.r, a.v, falling.g, a.t);
  }

  /// The next wall or obstacle that a disk hits; obstacles only until it leaves its cell, or the epoch ends.
  [[nodiscard]] BoundaryPlan<Real> next_boundary(const Record& a, Real leaves_cell, Real epoch_length) const {
    BoundaryPlan<Real> first;
    for (int axis = 0; axis < 2; ++axis)
      if (!edges.domain().periodic[axis] && !circle)
        for (const bool upper : {false, true}) consider_wall(a, wall_of(axis, upper), first);
    if (obstacles.empty()) return first;
    Real until = std::min(leaves_cell, first.time);
    if (until < infinity<Real>) until = std::min(until, epoch_length);  // a piston may be far away, and all is planned anew then
    const auto meeting = obstacles.next(a.r, a.v, falling.g, radius(a, a.t), a.radius * expansion, until - a.t);
    if (a.t + meeting.time < first.time) first = {a.t + meeting.time, first_obstacle - meeting.obstacle};
    return first;
  }

  /// Whether disks leave the box here, past an edge where images slide.
  [[nodiscard]] bool is_open(std::int32_t what) const { return what > first_obstacle && edges.sheared(); }
  /// Whether a contact changes the motion of this wall or obstacle: it is a piston.
  [[nodiscard]] bool is_movable(std::int32_t what) const {
    return what > first_obstacle && walls.is_piston(static_cast<Wall>(what));
  }

  /// Changes the velocity of a disk whose record is of now by its contact with a wall or an obstacle, and keeps count. Impulses
  /// count `drag_factor` times, energies its square. Returns Walls::Hit::smallness.
  Real meet(std::int32_t what, Record& a, bool elastic, Real drag_factor, Real now, RunningTotals& totals) {
    if (what <= first_obstacle) {
      ++totals.obstacle;
      const auto bounce = obstacles.bounce(first_obstacle - what, a.r, a.v, falling.g, a.mass, a.radius, a.radius * expansion);
      if (first_obstacle - what == rim) {
        const Vec2<Real> outward = (a.r - circle->centre.template cast<Real>()).normalized();
        totals.circle_impulse.add(static_cast<double>(drag_factor * bounce.impulse.dot(outward)));
      } else {
        for (int k = 0; k < 2; ++k)
          totals.obstacle_impulse[static_cast<std::size_t>(k)].add(static_cast<double>(drag_factor * bounce.impulse[k]));
      }
      totals.growth_energy.add(static_cast<double>(bounce.energy));
      return infinity<Real>;
    }
    const Wall wall = static_cast<Wall>(what);
    ++totals.wall;
    const auto hit = walls.meet(wall, a.v, falling.g, a.mass, a.radius, a.radius * expansion, elastic, now);
    totals.wall_impulse[index_of(wall)].add(static_cast<double>(drag_factor * hit.impulse));
    if (hit.shear != 0) totals.wall_shear[index_of(wall)].add(static_cast<double>(drag_factor * hit.shear));
    totals.wall_energy[index_of(wall)].add(static_cast<double>(drag_factor * drag_factor * hit.energy));
    if (hit.work != 0) totals.wall_work[index_of(wall)].add(static_cast<double>(drag_factor * drag_factor * hit.work));
    return hit.smallness;
  }

  /// Moves the clock's zero to `now`.
  void rebase(Real now) {
    walls.rebase(now);
    edges.rebase(now);
    scale_at_epoch += expansion * now;
  }

  /// Returns the overlap of a disk at r with the obstacle that it overlaps deepest; the rim of a circular box is left out.
  [[nodiscard]] ObstacleOverlap<Real> overlap_with_obstacles(const Vec2<Real>& r, Real radius) const {
    return obstacles.deepest_overlap(r, radius, rim < 0 ? obstacles.count() : rim);
  }
  [[nodiscard]] std::size_t bytes() const { return obstacles.bytes(); }

  Edges<Real> edges;
  Falling<Real> falling;
  Walls<Real> walls;
  Obstacles<Real> obstacles;
  Real scale_at_epoch;  ///< of all radii, when the epoch began
  Real expansion;       ///< of the scale, per time
  std::optional<Circle> circle;
  std::int32_t rim;  ///< the circle's index among the fixed shapes; -1 without one

 private:
  /// Puts the meeting of a disk with a side of the box in the place of a later one. Like that of a pair, its time depends on the
  /// records of the two alone.
  void consider_wall(const Record& a, Wall wall, BoundaryPlan<Real>& first) const {
    const Real t = std::max(a.t, walls.since(wall));
    const int axis = axis_of(wall);
    const Real sign = is_upper(wall) ? 1 : -1;
    const Real outward = sign * velocity(a, t)[axis], g = sign * falling.g[axis], growth = a.radius * expansion;
    if (edges.sheared()) {  // no wall: the disk's centre leaves the box
      const Real leaves = t + edges.time_to_edge(is_upper(wall), position(a, t), outward);
      if (leaves < first.time) first = {leaves, wall};
      return;
    }
    if (walls.recedes(wall, outward, g, growth, t)) return;
    const Real x = position(a, t)[axis], reach = radius(a, t);
    const Real room = is_upper(wall) ? (edges.domain().upper[axis] - reach) - x : x - (edges.domain().lower[axis] + reach);
    const Real time = t + walls.contact(wall, room, outward, g, growth, t);
    if (time < first.time) first = {time, wall};
  }
};

}  // namespace carom
