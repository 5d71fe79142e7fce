#pragma once
// The largest Lyapunov exponent of a scene: how fast two trajectories part that begin next to each other.

#include "core/vec2.hpp"
#include "effects/obstacles.hpp"
#include "studies/horizon/event_rates.hpp"
#include "studies/horizon/report.hpp"

#include <carom/box.hpp>
#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace carom {

/// A trajectory and one vector of its tangent space, moved from event to event. O(1) per event.
///
/// It is the divergence of a vanishingly small difference between two trajectories, carried along an event log.
///
/// Between events the difference (dr, dv) of a disk grows as dr += dv t. At an event the two trajectories collide at different
/// times. With M the map of the collision and tau the delay of the second trajectory, the difference of the two after both have
/// collided, taken back to one time, is
///
///     dr' = dM_r(dr + v tau) - v' tau,    dv' = dM_v(dr + v tau, dv + g tau) - g tau.
///
/// Gravity g is the same for both disks of a pair and leaves no trace there: it acts at walls and fixed shapes alone. These are
/// met as a fixed disk would be: at a distance from the centre of their curvature, which is outside or inside; faces of segments
/// as walls.
class TangentFlow {
 public:
  /// Begins at `start`. `dr` and `dv` are 2 x N: the difference at that time, of any length.
  /// The trajectory is that of the collision rule, hard walls, fixed shapes and gravity; other effects are not known.
  TangentFlow(const Box& box, const Disks& disks, const Effects& effects, const State& start, const Eigen::Matrix2Xd& dr,
              const Eigen::Matrix2Xd& dv);

  /// The next event of the trajectory. Requires all of them, in order.
  void follow(const Event& event);

  /// Brings every disk to one time, not before the last event. O(N).
  void advance(double time);

  /// Returns the difference of all disks; of one time only just after advance().
  [[nodiscard]] Eigen::Matrix2Xd dr() const;
  [[nodiscard]] Eigen::Matrix2Xd dv() const;

  /// Returns sqrt(|dr|^2 / length^2 + |dv|^2 / speed^2) of one disk, just after its last event.
  [[nodiscard]] double norm_of(std::int32_t i, double length, double speed) const;

  /// Returns sqrt(sum |dr|^2 / length^2 + sum |dv|^2 / speed^2), after advance().
  [[nodiscard]] double norm(double length, double speed) const;
  void scale(double factor);

  /// Puts another difference in the place of this one, just after advance(). Both are 2 x N.
  void set(const Eigen::Matrix2Xd& dr, const Eigen::Matrix2Xd& dv);

 private:
  struct Disk {
    Vec2<double> r;  ///< at time + remainder, not folded
    Vec2<double> v;
    Vec2<double> dr;
    Vec2<double> dv;
    double time = 0.0;
    double remainder = 0.0;  ///< as in Event: late times keep their digits
  };

  [[nodiscard]] Disk& disk(std::int32_t i) { return all_[static_cast<std::size_t>(i)]; }
  void bring(Disk& a, double time, double remainder) const;
  [[nodiscard]] Vec2<double> separation(const Disk& a, const Disk& b) const;
  void meet_shape(Disk& a, std::size_t shape, const Vec2<double>& velocity) const;
  /// Returns the vector to r from the centre of curvature of the surface that it is in contact with; across a face that is flat,
  /// and then `flat` is set.
  [[nodiscard]] Vec2<double> from_curvature(std::size_t shape, const Vec2<double>& r, bool& flat) const;

  Box box_;
  const Disks& disks_;
  CollisionRule rule_;
  Vec2<double> acceleration_;
  std::vector<Obstacle> shapes_;
  Obstacles<double> obstacles_;  ///< the same, to find the nearest point of one
  std::vector<Disk> all_;
};

struct LyapunovOptions {
  std::uint64_t collisions = 0;  ///< number of pair collisions; 0: half a million, or 100 per disk where that is more
  std::function<bool(double fraction)> proceed = {};  ///< several times a second; false ends it
};

/// Benettin's method (benettin1980) along one trajectory of the engine that runs the scene, from `start`: a tangent vector
/// (TangentFlow) is brought back to length 1 about once per collision of every disk, and the logarithms
/// of what it had grown by are averaged. The first fifth, in which it turns towards the direction that grows fastest, is left
/// out. The error is that of the mean over up to 32 blocks of 10 or more collisions per disk each; rates forget one
/// another in 1 or 2, so that blocks are independent to some tenths of the error itself.
///
/// Empty where `rates` has seen no collision, too few came, contacts dissipate energy, so that there is no steady rate, or the
/// caller said stop. Throws as make_simulation.
std::optional<Lyapunov> measure_lyapunov(const Scene& scene, const State& start, const EventRates& rates,
                                         const LyapunovOptions& options = {});

}  // namespace carom
