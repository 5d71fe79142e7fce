#pragma once
// What is round the disks besides other disks, with every effect: how they fall, the sides of the box, obstacles, images that
// slide; and how they grow. PlainWorld (plain_world.hpp) is the answer where there are hard walls at rest or none.

#include "core/running_totals.hpp"
#include "core/sides.hpp"
#include "effects/drag.hpp"
#include "effects/gravity.hpp"
#include "effects/obstacles.hpp"
#include "effects/plain_world.hpp"
#include "effects/rebound.hpp"
#include "effects/shear.hpp"
#include "effects/walls.hpp"

#include <carom/effects.hpp>
#include <carom/state.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace carom {

struct AnyWorld {
  static constexpr bool plain = false;

  AnyWorld(const Box& box, const Effects& effects, const State& start, std::uint64_t seed)
      : falling(effects.gravity),
        walls(box, effects.walls, seed),
        obstacles(box, fixed_shapes(effects)),
        lees_edwards(box, effects.shear, start.shear_displacement),
        drag_(effects.drag_rate()),
        scale_(start.scale),
        growth_(effects.growth_rate()),
        circle_(effects.circle),
        rim_(effects.circle ? static_cast<std::int32_t>(effects.obstacles.size()) : -1) {
    walls.start_from(start.walls);
  }

  [[nodiscard]] const Vec2<double>& g() const { return falling.g; }
  /// Returns the distance that the frame in which lines are straight has fallen at time t. At the zero of the clock it stands
  /// still.
  [[nodiscard]] double fallen(int axis, double t) const { return (falling.g[axis] * t) * (t / 2); }
  [[nodiscard]] bool falls() const { return falling.present(); }
  /// Returns whether images above slide past those below.
  [[nodiscard]] bool sheared() const { return lees_edwards.present(); }
  /// Returns the scale of all radii at time t.
  [[nodiscard]] double scale(double t) const { return scale_ + growth_ * t; }
  [[nodiscard]] double expansion() const { return growth_; }
  /// Returns whether disks fly straight and keep their size, between walls that stay where the box has them.
  [[nodiscard]] bool is_static() const {
    return !falling.present() && growth_ == 0.0 && !walls.any_moves() && !walls.any_moved();
  }

  /// What a contact took from a disk: see Walls::Hit.
  struct Loss {
    double smallness = infinity<double>;
    double rest = 0.0;
  };

  /// A disk meets a wall or an obstacle: changes its velocity and keeps count.
  Loss meet(std::int32_t what, const BoundaryContact& contact, Vec2<double>& v, double now, RunningTotals& totals) {
    const double expansion = growth_ * contact.radius / scale(now), drag_factor = drag_.at(now);
    if (what <= first_obstacle) {
      ++totals.obstacle;
      const auto bounce =
          obstacles.bounce(first_obstacle - what, contact.r, v, falling.g, contact.mass, contact.radius, expansion);
      if (first_obstacle - what == rim_)
        totals.circle_impulse.add(drag_factor * outward(bounce.impulse, contact.r));
      else
        for (int k = 0; k < 2; ++k) totals.obstacle_impulse[static_cast<std::size_t>(k)].add(drag_factor * bounce.impulse[k]);
      if (bounce.energy != 0.0) totals.growth_energy.add(bounce.energy);
      return {};
    }
    const Wall wall = static_cast<Wall>(what);
    ++totals.wall;
    const auto hit = walls.meet(wall, v, falling.g, contact.mass, contact.radius, expansion, contact.elastic, now);
    walls.let_recede(wall, v, contact.expansion, now);
    totals.wall_impulse[index_of(wall)].add(drag_factor * hit.impulse);
    if (hit.shear != 0.0) totals.wall_shear[index_of(wall)].add(drag_factor * hit.shear);
    totals.wall_energy[index_of(wall)].add(drag_factor * drag_factor * hit.energy);
    if (hit.work != 0.0) totals.wall_work[index_of(wall)].add(drag_factor * drag_factor * hit.work);
    return {hit.smallness, hit.rest};
  }
  /// Whether a contact changes the motion of this wall or obstacle: it is a piston.
  [[nodiscard]] bool is_movable(std::int32_t what) const {
    return what > first_obstacle && walls.is_piston(static_cast<Wall>(what));
  }
  void rebase(double now) {
    walls.rebase(now);
    lees_edwards.rebase(now);
    drag_.rebase(now);
    scale_ += growth_ * now;
  }
  /// Returns the distance by which a disk at r reaches beyond the rim of a circular box; negative where it does not. Requires
  /// one.
  [[nodiscard]] double beyond_circle(const Vec2<double>& r, double radius) const {
    return ((r - circle_->centre).norm() + radius) - circle_->radius;
  }
  /// Returns the overlap of a disk at r with the obstacle that it overlaps deepest; the rim of a circular box is left out.
  [[nodiscard]] ObstacleOverlap<double> overlap_with_obstacles(const Vec2<double>& r, double radius) const {
    return obstacles.deepest_overlap(r, radius, rim_ < 0 ? obstacles.count() : rim_);
  }
  [[nodiscard]] bool in_circle() const { return circle_.has_value(); }
  [[nodiscard]] std::size_t bytes() const { return obstacles.bytes(); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(walls, lees_edwards, drag_, scale_, growth_);
  }

  Falling<double> falling;
  Walls<double> walls;
  Obstacles<double> obstacles;
  LeesEdwards<double> lees_edwards;

 private:
  DragFactor<double> drag_;
  /// Returns the component of a vector away from the centre of the circular box, at r.
  [[nodiscard]] double outward(const Vec2<double>& vector, const Vec2<double>& r) const {
    return vector.dot((r - circle_->centre).normalized());
  }

  double scale_;
  double growth_;
  std::optional<Circle> circle_;
  std::int32_t rim_;  ///< the circle's index among the fixed shapes; -1 without one
};

}  // namespace carom
