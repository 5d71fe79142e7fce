#pragma once
// What is round the disks besides other disks where no effect acts: hard walls at rest, or none. The plain alternative to
// AnyWorld (world.hpp).

#include "core/running_totals.hpp"
#include "core/sides.hpp"
#include "core/vec2.hpp"

#include <carom/box.hpp>
#include <carom/effects.hpp>
#include <carom/state.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace carom {

/// A disk at its contact with a wall or an obstacle.
struct BoundaryContact {
  Vec2<double> r;  ///< position of the disk
  double mass;
  double radius;
  double expansion;  ///< of the radius, with which contacts are planned; length / time
  bool elastic;      ///< whether the contact loses no energy, whatever is hit (TC model)
};

struct PlainWorld {
  static constexpr bool plain = true;

  PlainWorld(const Box& /*box*/, const Effects& /*effects*/, const State& /*start*/, std::uint64_t /*seed*/) {}

  [[nodiscard]] static Vec2<double> g() { return Vec2<double>::Zero(); }
  [[nodiscard]] static double fallen(int /*axis*/, double /*t*/) { return 0.0; }
  [[nodiscard]] static bool falls() { return false; }
  [[nodiscard]] static bool sheared() { return false; }
  [[nodiscard]] static double scale(double /*t*/) { return 1.0; }
  [[nodiscard]] static double expansion() { return 0.0; }
  [[nodiscard]] static bool is_static() { return true; }

  /// The component of the velocity across the wall is reversed.
  static void meet(std::int32_t what, const BoundaryContact& contact, Vec2<double>& v, double /*now*/, RunningTotals& totals) {
    const Wall wall = static_cast<Wall>(what);
    double& across = v[axis_of(wall)];
    ++totals.wall;
    totals.wall_impulse[index_of(wall)].add(2.0 * contact.mass * std::abs(across));
    across = -across;
  }
  [[nodiscard]] static bool is_movable(std::int32_t /*what*/) { return false; }
  static void rebase(double /*now*/) {}
  [[nodiscard]] static std::size_t bytes() { return 0; }
};

}  // namespace carom
