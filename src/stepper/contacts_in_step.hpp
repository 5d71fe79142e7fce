#pragma once
// The part of fixed-step methods that find contacts within a step (backtrack.hpp): the order of events in a step, walls, and
// the close pairs in which they look. In each step:
//
//   1. move all disks along their flights (bodies.hpp) for a time dt, as if none met another;
//   2. find the pairs and walls that were met on the way, as Search says, each with its time t, -dt <= t <= 0, from the end of
//      the step;
//   3. take the earliest: its disks get their new velocities v' at the separation r + v t of that moment, and stand at the end of
//      the step where these bring them, r + (v - v') t; look anew for what they meet after t; repeat until nothing is left;
//   4. record the positions.
//
// Separations at contact follow from those at the end of the step, so a disk's position is rounded once per step and once per
// event. Events at one instant are taken in the order of the disks' ids, so results do not depend on how pairs are found. In step
// 0, which has no flight before it, pairs that overlap and approach collide where they are, as in guarded.hpp.
//
// Fixed shapes, obstacles and the rim of a circular box, are found anywhere within the step by all these methods: the first
// contact on the flight since the last event of the disk is that of the exact engines (effects/obstacles.hpp).
//
// No disk takes more than 100 events in a step; what is left then is taken at the beginning of the next. That many mean a dt in
// which disks cross the box. Inelastic disks that come to rest on a floor, where exact engines end, are turned once in each step
// as in guarded.hpp, and sink as there.

#include "core/fall_time.hpp"
#include "core/vec2.hpp"
#include "effects/impact.hpp"
#include "stepper/bodies.hpp"
#include "stepper/grid.hpp"
#include "stepper/reflect_at_wall.hpp"
#include "stepper/tally.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace carom {

/// A step that finds contacts within itself. Search::meets(bodies, i, j, sigma_squared, span) says cheaply, at the end of the
/// step, whether a listed pair may have met in it, within a time `span`; Search::entry(r, v, sigma_squared, begin) returns when
/// it did, from the end of the step, no earlier than `begin`, and a positive number where it did not. Pairs lists what is near.
template <class Rule, class Search, class Pairs = ClosePairs>
class ContactStep {
 public:
  ContactStep(const Bodies& bodies, double dt)
      : dt_(dt),
        farthest_(Search::farthest(bodies)),
        pairs_(bodies, dt / parts(bodies, dt), Search::least_margin),
        disks_(bodies.count()) {}

  [[nodiscard]] static double work(double disks) { return Pairs::work(disks); }

  void advance(Bodies& bodies, Tally& tally) { advance(bodies, dt_, tally); }

  void check(Bodies& bodies, Tally& tally) {
    const Instant end = tally.time;
    find(bodies);
    while (!meetings_.empty()) {
      const Meeting next = meetings_.front();
      std::pop_heap(meetings_.begin(), meetings_.end(), later);
      meetings_.pop_back();
      if (!holds(next)) continue;
      tally.time = end.plus(next.time);
      if (next.j >= 0)
        meet_disk(bodies, next, tally);
      else if (next.j <= first_obstacle)
        meet_shape(bodies, next, tally);
      else
        meet_wall(bodies, next, tally);
    }
    strays_.clear();
    for (const std::uint32_t i : turned_) {
      disks_[i].since = never;
      disks_[i].events = 0;
    }
    turned_.clear();
    tally.time = end;
  }

  /// Moves disks from the last step to a time before the next one, by a step that is shorter.
  void move_on(Bodies& bodies, double time) const {
    ContactStep step = *this;
    Tally unseen;
    step.advance(bodies, time, unseen);
    step.check(bodies, unseen);
  }

  [[nodiscard]] std::size_t bytes() const {
    return pairs_.bytes() + disks_.capacity() * sizeof(Disk) + meetings_.capacity() * sizeof(Meeting) +
           (strays_.capacity() + turned_.capacity()) * sizeof(std::uint32_t);
  }

  /// Between steps there are no meetings, and times since events are not asked for.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(pairs_);
  }

 private:
  static constexpr double never = -infinity<double>;
  static constexpr std::uint32_t most_events = 100;  ///< of a disk in a step

  struct Disk {
    double since = never;      ///< its last event in this part of a step, from the end of it
    std::uint32_t events = 0;  ///< in it
    std::uint32_t turns = 0;   ///< events so far
  };
  struct Meeting {
    double time;  ///< from the end of the step, <= 0
    std::uint32_t i;
    std::int32_t j;                  ///< > i; or -1 - (2 axis + above) for a wall, first_obstacle - k for fixed shape k
    std::uint32_t turns_i, turns_j;  ///< of the disks when it was found: after a further event of one of them it is void
  };
  static bool later(const Meeting& a, const Meeting& b) {
    if (a.time != b.time) return a.time > b.time;
    return a.i != b.i ? a.i > b.i : a.j > b.j;
  }

  [[nodiscard]] bool holds(const Meeting& m) const {
    return holds(disks_[m.i], m.turns_i) && (m.j < 0 || holds(disks_[static_cast<std::size_t>(m.j)], m.turns_j));
  }
  [[nodiscard]] static bool holds(const Disk& disk, std::uint32_t turns) {
    return disk.turns == turns && disk.events < most_events;
  }

  /// Returns into how many parts a flight is cut, so that no disk goes farther in one than the search can follow.
  [[nodiscard]] double parts(const Bodies& bodies, double time) const {
    if (farthest_ == infinity<double>) return 1.0;
    return std::max(1.0, std::ceil(fastest_within(bodies, time) * time / farthest_));
  }

  void advance(Bodies& bodies, double time, Tally& tally) {
    const Instant end = tally.time;
    double left = time;
    for (double cut = parts(bodies, left); cut > 1.0; cut = parts(bodies, left)) {
      const double part = left / cut;
      left -= part;
      tally.time = end.plus(-left);
      fly(bodies, part);
      check(bodies, tally);
    }
    tally.time = end;
    fly(bodies, left);
  }

  void fly(Bodies& bodies, double time) {
    span_ = time;
    if (Search::along_flights) pairs_.about_to_move(bodies, time, fastest_within(bodies, time));
    bodies.fly(time);
    if (!Search::along_flights) pairs_.moved(bodies, time);
  }

  /// Returns a bound of all speeds in a flight for `time`.
  [[nodiscard]] static double fastest_within(const Bodies& bodies, double time) {
    return bodies.fastest() + (bodies.falling.present() ? bodies.falling.g.norm() * time : 0.0);
  }

  void find(const Bodies& bodies) {
    bounded_ = bodies.bounded();
    pairs_.for_pairs([&](std::uint32_t i, std::uint32_t j, double sigma_squared) {
      if (Search::meets(bodies, i, j, sigma_squared, span_)) add_if_met(bodies, i, j, sigma_squared);
    });
    if (!bounded_) return;
    for (std::uint32_t i = 0; i < bodies.count(); ++i) look_at_boundary(bodies, i);
  }

  void look_at_boundary(const Bodies& bodies, std::uint32_t i) {
    look_at_walls(bodies, i);
    if (bodies.shapes != nullptr) look_at_shapes(bodies, i);
  }

  /// Looks for the first fixed shape that disk i came to since its last event.
  void look_at_shapes(const Bodies& bodies, std::uint32_t i) {
    const double begin = std::max(-span_, disks_[i].since);
    const Vec2<double> g = bodies.falling.g;
    const DiskPath<double> path{place_at(bodies, i, begin), bodies.v[i] + begin * g, g, bodies.radius[i], 0.0};
    const ObstacleMeeting<double> first = bodies.shapes->next(path, -begin);
    if (first.obstacle >= 0 && begin + first.time <= 0.0)
      add({begin + first.time, i, first_obstacle - first.obstacle, disks_[i].turns, 0});
  }

  /// Returns where disk i is on its flight at a time from the end of the step.
  [[nodiscard]] static Vec2<double> place_at(const Bodies& bodies, std::uint32_t i, double time) {
    return bodies.r[i] + bodies.mean_velocity(bodies.v[i], time) * time;
  }

  void add(const Meeting& meeting) {
    meetings_.push_back(meeting);
    std::push_heap(meetings_.begin(), meetings_.end(), later);
  }

  void look_closely(const Bodies& bodies, std::uint32_t i, std::uint32_t j, double sigma_squared) {
    if (Search::meets(bodies, i, j, sigma_squared, span_)) add_if_met(bodies, i, j, sigma_squared);
  }

  [[gnu::noinline]] void add_if_met(const Bodies& bodies, std::uint32_t i, std::uint32_t j, double sigma_squared) {
    if (i > j) std::swap(i, j);
    const double begin = std::max({-span_, disks_[i].since, disks_[j].since});
    const double time =
        Search::entry(bodies.separation(bodies.r[i], bodies.r[j]), bodies.v[i] - bodies.v[j], sigma_squared, begin);
    if (time <= 0.0) add({time, i, static_cast<std::int32_t>(j), disks_[i].turns, disks_[j].turns});
  }

  void look_at_walls(const Bodies& bodies, std::uint32_t i) {
    for (int axis = 0; axis < 2; ++axis) {
      const double across = bodies.v[i][axis];
      if (!bodies.walled[axis]) continue;
      if (bodies.falling.g[axis] != 0.0) {
        for (const bool above : {false, true}) look_at_parabola(bodies, i, axis, above);
        continue;
      }
      if (across == 0.0) continue;
      const bool above = across > 0.0;
      const double gap = room(bodies, i, axis, above);
      if (!(gap < 0.0)) continue;
      const double time = std::max({gap / std::abs(across), -span_, disks_[i].since});
      add({time, i, -1 - (2 * axis + (above ? 1 : 0)), disks_[i].turns, 0});
    }
  }

  /// Returns the distance of disk i from a wall; negative beyond it.
  [[nodiscard]] static double room(const Bodies& bodies, std::uint32_t i, int axis, bool above) {
    return above ? bodies.domain.upper[axis] - bodies.radius[i] - bodies.r[i][axis]
                 : bodies.r[i][axis] - (bodies.domain.lower[axis] + bodies.radius[i]);
  }

  /// Looks for the first time since its last event at which disk i came to a wall on its parabola.
  void look_at_parabola(const Bodies& bodies, std::uint32_t i, int axis, bool above) {
    const double sign = above ? 1.0 : -1.0, begin = std::max(-span_, disks_[i].since);
    const double outward = sign * bodies.v[i][axis], acceleration = sign * bodies.falling.g[axis];
    const double gap = room(bodies, i, axis, above) - begin * (outward + acceleration * (begin / 2));
    const double rising = -(outward + acceleration * begin);
    const bool is_beyond = gap < 0.0 && rising >= 0.0;  // and comes back only if it gets out of the wall before
    const double time = begin + (is_beyond ? return_time(gap, rising, -acceleration) : fall_time(gap, rising, -acceleration));
    if (time <= 0.0) add({time, i, -1 - (2 * axis + (above ? 1 : 0)), disks_[i].turns, 0});
  }

  void meet_disk(Bodies& bodies, const Meeting& m, Tally& tally) {
    const auto i = m.i, j = static_cast<std::uint32_t>(m.j);
    bodies.accelerate(i, m.time);
    bodies.accelerate(j, m.time);
    const Vec2<double> v_i = bodies.v[i], v_j = bodies.v[j];
    const Vec2<double> r = bodies.separation(bodies.r[i], bodies.r[j]) + (v_i - v_j) * m.time;
    if (r.dot(v_i - v_j) < 0) {
      const auto impact = collide<Rule, double>(r, bodies.mass[i], bodies.v[i], bodies.mass[j], bodies.v[j], bodies.impact);
      tally.pair(i, j, impact.virial, impact.lost, bodies.v[i], bodies.v[j]);
      bodies.move(i, v_i - bodies.v[i], m.time);
      bodies.move(j, v_j - bodies.v[j], m.time);
    }
    bodies.accelerate(i, -m.time);
    bodies.accelerate(j, -m.time);
    turned(m.time, i);
    turned(m.time, j);
    look_around(bodies, i, j);
    look_around(bodies, j, i);
  }

  void meet_wall(Bodies& bodies, const Meeting& m, Tally& tally) {
    const int wall = -1 - m.j, axis = wall / 2;
    bodies.accelerate(m.i, m.time);
    const Vec2<double> before = bodies.v[m.i];
    reflect_at_wall(bodies, m.i, axis, wall % 2 == 1, tally);
    bodies.move(m.i, before - bodies.v[m.i], m.time);
    bodies.accelerate(m.i, -m.time);
    turned(m.time, m.i);
    look_around(bodies, m.i, m.i);
  }

  void meet_shape(Bodies& bodies, const Meeting& m, Tally& tally) {
    const std::int32_t shape = first_obstacle - m.j;
    const Vec2<double> place = place_at(bodies, m.i, m.time);
    bodies.accelerate(m.i, m.time);
    const Vec2<double> before = bodies.v[m.i];
    const Vec2<double> impulse =
        bodies.shapes->bounce(shape, place, bodies.v[m.i], bodies.falling.g, bodies.mass[m.i], bodies.radius[m.i]);
    tally.shape(m.i, shape, impulse, bodies.shapes->on_rim(shape, impulse, place), bodies.v[m.i]);
    bodies.move(m.i, before - bodies.v[m.i], m.time);
    bodies.accelerate(m.i, -m.time);
    turned(m.time, m.i);
    look_around(bodies, m.i, m.i);
  }

  void turned(double time, std::uint32_t i) {
    disks_[i].since = time;
    ++disks_[i].events;
    ++disks_[i].turns;
    turned_.push_back(i);
  }

  /// Looks for what disk i meets after its last event, which was with `partner`.
  void look_around(const Bodies& bodies, std::uint32_t i, std::uint32_t partner) {
    if (bounded_) look_at_boundary(bodies, i);
    if (pairs_.strayed(bodies, i)) {
      strays_.push_back(i);
      look_at_all(bodies, i, partner);
      return;
    }
    pairs_.for_near(i, [&](std::uint32_t j, double sigma_squared) {
      if (j != partner) look_closely(bodies, i, j, sigma_squared);
    });
    for (const std::uint32_t j : strays_) {
      if (j != partner) look_at_any(bodies, i, j);
    }
  }

  void look_at_all(const Bodies& bodies, std::uint32_t i, std::uint32_t partner) {
    for (std::uint32_t j = 0; j < bodies.count(); ++j) {
      if (j != partner) look_at_any(bodies, i, j);
    }
  }

  void look_at_any(const Bodies& bodies, std::uint32_t i, std::uint32_t j) {
    const double sigma = bodies.radius[i] + bodies.radius[j];
    if (j != i) look_closely(bodies, i, j, sigma * sigma);
  }

  double dt_;
  double farthest_;  ///< that a disk may go in a part of a step
  Pairs pairs_;
  std::vector<Disk> disks_;
  double span_ = 0.0;  ///< how long the flight took that is looked at
  bool bounded_ = false;
  std::vector<Meeting> meetings_;      ///< a heap, the earliest first
  std::vector<std::uint32_t> strays_;  ///< disks out of reach of the list in this step
  std::vector<std::uint32_t> turned_;  ///< disks that had events in this step
};

}  // namespace carom
