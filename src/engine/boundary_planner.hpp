#pragma once
// The next contact of a disk with what bounds its flight besides other disks: walls, obstacles, or the edges of a sheared box,
// past which images slide. The earliest of these takes the place of leaving the neighbourhood in the plan of the disk.

#include "core/sides.hpp"
#include "engine/flight_frame.hpp"
#include "engine/plans.hpp"
#include "neighbours/neighbour_search.hpp"

#include <carom/box.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

namespace carom {

template <class Line, class World>
class BoundaryPlanner {
 public:
  /// `flight` says where disks are and `world` what is round them; both must outlive the planner.
  BoundaryPlanner(const Box& box, const FlightFrame<Line, World>& flight, const World& world)
      : flight_(flight), world_(world), walled_(!box.periodic(0) || !box.periodic(1)) {
    if constexpr (!World::plain) everywhere_ = !world.obstacles.empty();
    has_sides_ = !box.is_circle;
    bounded_ = walled_ || everywhere_ || world.sheared();
  }

  /// The planner of another one, for the disks of another frame.
  BoundaryPlanner(const BoundaryPlanner& other, const FlightFrame<Line, World>& flight, const World& world)
      : flight_(flight),
        world_(world),
        walled_(other.walled_),
        bounded_(other.bounded_),
        everywhere_(other.everywhere_),
        has_sides_(other.has_sides_),
        clear_{other.clear_[0], other.clear_[1]} {}

  /// Adapts to neighbourhoods of this half-width, of disks whose largest contact distance at scale 1 is given.
  void set_neighbourhoods(double half_width, double largest_contact) {
    // A sixteenth of the neighbourhood is far more than any rounding of the time at which it is left.
    const double reach = half_width * (1.0 + 1.0 / 16.0);
    for (int k = 0; k < 2; ++k) {
      const double half_length = flight_.length(k) / 2.0;
      if (k == 1 && world_.sheared())
        set_clear(k, half_length - reach);
      else if (flight_.axis(k).periodic)
        clear_[k] = std::numeric_limits<std::int64_t>::max();
      else
        set_clear(k, world_.is_static() ? half_length - largest_contact - reach : 0.0);
    }
  }

  /// Whether a disk may meet anything here before it leaves the neighbourhood round that centre.
  [[nodiscard]] bool within_reach(NeighbourhoodCentre centre) const {
    return bounded_ && (everywhere_ || !clear_of_edges(centre));
  }

  /// Plans the earliest contact of disk i with a wall, an obstacle or a sheared edge where that comes no later than leaving its
  /// neighbourhood. `radius` is that at scale 1; all times count from the epoch, which ends at `epoch_length`.
  void plan(std::int32_t i, const Line& a, double radius, double now, double epoch_length, Plans& plans) const {
    if constexpr (World::plain) {
      plan_hard_walls(a, radius, now, plans[i]);
      plans.resolve_wall_pair_tie(i);
    } else if (world_.sheared()) {
      plan_sheared_edge(i, a, now, plans[i]);
    } else {
      plan_walls_and_obstacles(a, radius, now, epoch_length, plans[i]);
      plans.resolve_wall_pair_tie(i);
    }
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(clear_);
  }

 private:
  void set_clear(int axis, double from_middle) {
    clear_[axis] = static_cast<std::int64_t>(std::max(from_middle, 0.0) / (flight_.axis(axis).unit * 0x1p32));
  }
  [[nodiscard]] bool clear_of_edges(NeighbourhoodCentre centre) const {
    return std::abs(std::int64_t{centre.x}) < clear_[0] && std::abs(std::int64_t{centre.y}) < clear_[1];
  }

  /// Walls that stand still, and disks that fly straight.
  void plan_hard_walls(const Line& a, double radius, double now, Plan& mine) const {
    for (int axis = 0; axis < 2; ++axis) {
      const double v = a.v[axis];
      if (flight_.axis(axis).periodic || v == 0.0) continue;
      const bool up = v > 0.0;
      const double gap = flight_.room(a, axis, up ? 1 : -1, radius, now);
      const double time = gap > 0.0 ? now + gap / std::abs(v) : now;
      mine.consider_edge(time, wall_of(axis, up));
    }
  }

  /// Walls that may move and obstacles, along parabolas where disks fall. Not inlined: there would be a copy of it in every
  /// event.
  [[gnu::noinline]] void plan_walls_and_obstacles(const Line& a, double radius_at_scale_1, double now, double epoch_length,
                                                  Plan& mine) const {
    const double radius = radius_at_scale_1 * world_.scale(now), expansion = radius_at_scale_1 * world_.expansion();
    for (int axis = 0; axis < 2; ++axis) {
      if (flight_.axis(axis).periodic || !has_sides_) continue;
      const double v = a.v[axis] + world_.g()[axis] * now, g = world_.g()[axis];
      for (const int sign : {-1, 1}) {
        const Wall wall = wall_of(axis, sign > 0);
        if (world_.walls.recedes(wall, sign * v, sign * g, expansion, now)) continue;
        const double room = flight_.room(a, axis, sign, radius, now);
        mine.consider_edge(now + world_.walls.contact(wall, room, sign * v, sign * g, expansion, now, mine.edge_time - now),
                           wall);
      }
    }
    if (!everywhere_) return;
    // Disks may fall far while they stay in their neighbourhoods, but where they fall all is planned anew with every epoch.
    const double until = world_.falls() ? std::min(mine.edge_time, epoch_length) : mine.edge_time;
    const auto meeting =
        world_.obstacles.next(flight_.place(a, now), flight_.velocity(a, now), world_.g(), radius, expansion, until - now);
    if (meeting.obstacle >= 0) mine.consider_edge(now + meeting.time, first_obstacle - meeting.obstacle);
  }

  [[gnu::noinline]] void plan_sheared_edge(std::int32_t i, const Line& a, double now, Plan& mine) const {
    const double v = a.v[1];
    if (v == 0.0) return;
    const double sign = v > 0.0 ? 1.0 : -1.0;
    const double gap =
        flight_.axis(1).unit * 0x1p32 * (0x1p31 - sign * flight_.height(i)) - sign * flight_.offset(1, a, flight_.height(i), now);
    const double time = gap > 0.0 ? now + gap / std::abs(v) : now;
    if (time <= mine.edge_time) mine.edge_time = time, mine.edge = wall_of(1, v > 0.0);
  }

  const FlightFrame<Line, World>& flight_;
  const World& world_;
  bool walled_;
  bool bounded_;             ///< by walls, obstacles or images that slide
  bool everywhere_ = false;  ///< obstacles may be anywhere
  bool has_sides_ = true;    ///< the box is no circle
  /// Neighbourhoods with centres nearer to the middle than this, in steps of 2^32, are out of reach of walls and sheared edges.
  std::int64_t clear_[2] = {};
};

}  // namespace carom
