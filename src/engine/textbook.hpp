#pragma once
// Event-driven molecular dynamics of hard disks as Alder & Wainwright (J. Chem. Phys. 31, 459 (1959)) wrote it down, in
// the plainest form that is O(log N) per event: every disk has a plan of its next event, a heap has the earliest of
// all plans, a cell grid limits the pairs that may meet. Read from run_until() downwards.
//
// Between two collisions a disk's record (r, v, t) stays as the last collision left it. The time at which a pair meets
// is a function of the two records alone, so it does not matter when, how often or from which side it is predicted:
// cells, stale plans, sampling and stopping leave no trace in the bits, and an all-pairs search without any of these
// finds the same trajectory to the last bit (tests/engine/textbook_twin_test.cpp).
//
// What a scene may add to straight flight between hard walls lives in effects/, one file each, and is answered for by two
// members: world_ (engine/textbook_world.hpp) answers how disks fly and what else there is round them, impact_ what contact does.
// At its neutral value each effect leaves the bits as they are. textbook_impl.hpp has the functions that are only declared here.

#include "core/instant.hpp"
#include "effects/any_impact.hpp"
#include "effects/non_additivity.hpp"
#include "engine/common_motion.hpp"
#include "engine/contact_count.hpp"
#include "engine/continuation.hpp"
#include "engine/epoch.hpp"
#include "engine/stall_detector.hpp"
#include "engine/textbook_world.hpp"
#include "neighbours/cell_grid.hpp"
#include "queue/event_queue.hpp"

#include <carom/state.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace carom {

template <class Real>
class TextbookEngine {
 public:
  /// Requires disks inside the box, radii and masses > 0, everything finite. Real may round what it is given. `seed`: of the
  /// random numbers that effects draw.
  TextbookEngine(const Box& box, const Disks& disks, const State& start, const Effects& effects = {}, std::uint64_t seed = 1);

  // ---------------------------------------------------------------------------------------------------- the loop

  /// Processes every event with time <= target, then stands at target (at the last event where target is forever and none
  /// is to come) and returns true. Returns false, and stands at the last event, where totals().pair reaches `pair_limit`,
  /// after `event_limit` events of any kind, and when stall().is_stalled().
  bool run_until(const Instant& target, std::uint64_t pair_limit, std::uint64_t event_limit) {
    for (; totals_.pair < pair_limit && event_limit > 0 && !stall_.is_stalled(); --event_limit) {
      const Real end = target.since<Real>(epoch_);
      const Real next = queue_.empty() ? infinity<Real> : queue_.next().time;
      if (epoch_length_ <= std::min(next, end) && epoch_length_ < infinity<Real>) {
        begin_epoch(epoch_length_);
      } else if (next <= end && next < infinity<Real>) {
        step();
      } else {
        if (target < forever) now_ = std::max(now_, end);
        return true;
      }
    }
    return false;
  }

  /// Nothing will ever happen again. (A moving boundary may hit what is at rest, however late.)
  [[nodiscard]] bool idle() const { return queue_.empty() || (queue_.next().time == infinity<Real> && !world_.edges.sheared()); }

  /// Whether the engine can go no further, and why.
  [[nodiscard]] const StallDetector& stall() const { return stall_; }

 private:
  using Record = DiskRecord<Real>;
  struct Plan;

  /// The time at which disk i and the image of disk j `shift` box lengths away meet, at their hard cores or the edge of their
  /// well; infinity for never. It is the same whichever is called i, and whenever it is asked.
  [[nodiscard]] Real pair_time(std::int32_t i, std::int32_t j, const Winding& shift) const {
    const Record &a = record(i), &b = record(j);
    const Real t = std::max(a.t, b.t);
    const Vec2<Real> r = separation(a, b, t, shift);
    Vec2<Real> v = velocity(a, t) - velocity(b, t);
    world_.edges.take_image_velocity(shift, v);
    return t + world_.time_to_contact(impact_, i, j, r, v, contact_distance(i, j), t);
  }
  [[nodiscard]] Vec2<Real> separation(const Record& a, const Record& b, Real t, const Winding& shift) const {
    Vec2<Real> r = position(a, t) - position(b, t);
    world_.edges.take_image(shift, t, r);
    return r;
  }

  /// The next event of all.
  void step() {
    const QueuedEvent<Real> event = queue_.next();
    stall_.count_event(event.time > now_);
    now_ = std::max(now_, event.time);
    if (event.higher == cell_crossing) {
      cross_cell(event.disk);
    } else if (event.higher < 0) {
      hit(event.disk, event.higher);
    } else if (is_stale(event.disk)) {
      ++totals_.stale;
      predict(event.disk);
    } else {
      collide(event.disk, plan(event.disk).partner, plan(event.disk).shift);
    }
  }

  // -------------------------------------------------------------------------------------------------- the events

  /// Two disks meet: bring both to the place of contact, let them exchange momentum, predict anew.
  void collide(std::int32_t i, std::int32_t j, Winding shift) {
    shift -= bring_to_now(i) - bring_to_now(j);
    if (j < i) {
      std::swap(i, j);
      shift = -shift;
    }
    Record& a = record(i);
    Record& b = record(j);
    const Vec2<Real> r = separation(a, b, now_, shift), before_a = a.v, before_b = b.v;
    const Real image_before = world_.edges.enter_image(shift, b.v), contact = contact_distance(i, j);
    const Real sigma = contact_distance_at(i, j, now_), expansion = contact * world_.expansion;
    count_contact<Real>(r, a.v - b.v, sigma, expansion, totals_.numerics);
    last_collision_.count(now_, totals_.numerics);
    stall_.record_loss(impact_.meet(r, sigma, expansion, {i, a.mass, radius_at(a, now_), a.v},
                                    {j, b.mass, radius_at(b, now_), b.v}, now_, totals_),
                       {i, j});
    world_.edges.leave_image(shift, b.mass, image_before, b.v, totals_);
    if (!a.v.allFinite() || !b.v.allFinite()) {
      a.v = before_a, b.v = before_b;
      return stall_.fail(fmt::format("disks {} and {}: their velocities would not be finite after their collision", i, j));
    }
    if (recording_) log_event(i, j, a.v, b.v);
    if (outruns_epoch(a.v, now_, box_size_) || outruns_epoch(b.v, now_, box_size_)) return begin_epoch_early();
    predict(i);
    predict(j);
  }

  /// A disk meets a wall or an obstacle.
  void hit(std::int32_t i, std::int32_t what) {
    bring_to_now(i);
    if (world_.is_open(what)) return cross_edge(i, static_cast<Wall>(what));
    Record& a = record(i);
    const Vec2<Real> before = a.v;
    stall_.record_loss(world_.meet(what, a, impact_.is_elastic(i, now_), impact_.drag_factor(now_), now_, totals_), {i});
    if (!a.v.allFinite()) return fail_after_hit(i, before);
    impact_.record_collision_time(i, now_);
    if (recording_) log_event(i, what, a.v, Vec2<Real>(0, 0));
    if (outruns_epoch(a.v, now_, box_size_)) return begin_epoch_early();
    if (world_.is_movable(what)) plan_boundaries_anew();
    predict(i);
  }

  /// A disk leaves the box past an open edge, and comes back on the other side as its own image there.
  void cross_edge(std::int32_t i, Wall edge) {
    Record& a = record(i);
    ++totals_.other;
    images_.col(i) += world_.edges.cross(is_upper(edge), a.mass, a.r, a.v, now_, totals_);
    grid_.move(i, a.r);
    predict(i);
  }

  /// The velocity of a disk would not be finite: it keeps the one that it had, and the run ends.
  void fail_after_hit(std::int32_t i, const Vec2<Real>& before) {
    record(i).v = before;
    stall_.fail(fmt::format("disk {}: its velocity would not be finite after what it has met", i));
  }

  /// A disk enters the next cell and may meet the disks that come into reach. Its record stays as it is.
  void cross_cell(std::int32_t i) {
    Plan& mine = plan(i);
    const CellCrossing<Real> crossing = mine.crossing;
    ++totals_.other;
    grid_.cross(i, crossing);
    grid_.for_neighbours_ahead(i, crossing, [&](std::int32_t j, const Winding& shift) { consider(i, j, shift); });
    plan_surroundings(i);
    queue_.update(next_of(i));
  }

  // -------------------------------------------------------------------------------------------------- prediction

  void predict(std::int32_t i) {
    make_plan(i);
    queue_.update(next_of(i));
  }

  /// Disk i against every neighbour, the edges of its cell and what bounds its flight.
  [[gnu::flatten]] void make_plan(std::int32_t i) {
    Plan& mine = plan(i);
    mine.pair_time = infinity<Real>;
    mine.partner = no_partner;
    grid_.for_neighbours(i, [&](std::int32_t j, const Winding& shift) { consider(i, j, shift); });
    plan_surroundings(i);
  }

  /// Plans when disk i leaves its cell, and which wall or obstacle it hits before that.
  [[gnu::noinline]] void plan_surroundings(std::int32_t i) {
    Plan& mine = plan(i);
    mine.crossing = world_.next_crossing(grid_, i, record(i), now_);
    mine.boundary = world_.next_boundary(record(i), mine.crossing.time, epoch_length_);
  }

  /// A boundary has changed its motion: all plans with it are void.
  void plan_boundaries_anew() {
    for (std::int32_t i = 0; i < count(); ++i) {
      plan_surroundings(i);
      queue_.update(next_of(i));
    }
  }

  /// Keeps the collision with disk j if it comes before the one planned so far.
  void consider(std::int32_t i, std::int32_t j, const Winding& shift) {
    Plan& mine = plan(i);
    const Real time = pair_time(i, j, shift);
    if (time < mine.pair_time || (time == mine.pair_time && wins_tie(i, j, shift))) {
      mine.pair_time = time;
      mine.partner = j;
      mine.partner_collisions = record(j).collisions;
      mine.shift = shift;
    }
  }

  /// Ties: the lower partner, and of one partner's images that which the lower disk of the two sees first from the left.
  [[nodiscard]] bool wins_tie(std::int32_t i, std::int32_t j, const Winding& shift) const {
    const Plan& planned = plan(i);
    if (j != planned.partner) return j < planned.partner;
    const Winding difference = (i < j ? 1 : -1) * (shift - planned.shift);
    return difference[0] != 0 ? difference[0] < 0 : difference[1] < 0;
  }

  /// The earliest of a disk's three plans. Disks with nothing ahead of them wait for ever.
  [[nodiscard]] QueuedEvent<Real> next_of(std::int32_t i) const {
    const Plan& mine = plan(i);
    QueuedEvent<Real> next{mine.pair_time, std::min(i, mine.partner), std::max(i, mine.partner), i};
    const QueuedEvent<Real> boundary{mine.boundary.time, i, mine.boundary.what, i};
    const QueuedEvent<Real> crossing{mine.crossing.time, i, cell_crossing, i};
    if (boundary.before(next)) next = boundary;
    if (crossing.before(next)) next = crossing;
    return next;
  }

  /// The partner has collided since this was planned.
  [[nodiscard]] bool is_stale(std::int32_t i) const { return record(plan(i).partner).collisions != plan(i).partner_collisions; }

  // ------------------------------------------------------------------------------------------------------- time

  /// A new zero for the loop's clock at time `now`: every disk is brought there and everything is predicted as at the
  /// start. Short times keep their digits, and what remains is nothing but positions and velocities. It happens whenever
  /// the clock passes epoch_length_, and when a disk outruns it, so it depends on the trajectory alone.
  void begin_epoch(Real now) {
    now_ = now;
    for (std::int32_t i = 0; i < count(); ++i) {
      bring_to_now(i);
      record(i).t = 0;
    }
    epoch_ = instant(now_);
    world_.rebase(now_);
    impact_.rebase(now_);
    now_ = 0;
    const double speed = rms_speed(records_, [](const Record& a) -> const Vec2<Real>& { return a.v; });
    stall_.check_speeds(is_too_slow<Real>(speed, 2.0 * largest_radius_));
    if (!std::isfinite(speed)) stall_.fail("a velocity is not finite");
    if (common_motion_.present())
      impact_.set_momentum_correction(common_motion_.momentum_correction(records_, [](const Record& a) { return momentum(a); }));
    epoch_length_ = suitable_epoch_length();
    rebuild_grid();
    last_collision_.rebase();
    ++totals_.numerics.epochs;
    ++totals_.numerics.list_rebuilds;
    grid_.clear();
    for (std::int32_t i = 0; i < count(); ++i) grid_.insert(i, record(i).r);
    for (std::int32_t i = 0; i < count(); ++i) make_plan(i);
    fill_queue();
  }

  /// With the next event of every disk, as planned.
  void fill_queue() {
    std::vector<QueuedEvent<Real>> events;
    events.reserve(records_.size());
    for (std::int32_t i = 0; i < count(); ++i) events.push_back(next_of(i));
    queue_.assign(events);
  }

  /// A disk has outrun the epoch.
  void begin_epoch_early() {
    ++totals_.numerics.early_epochs;
    begin_epoch(now_);
  }

  /// epoch_length() for the disks as they move now.
  [[nodiscard]] Real suitable_epoch_length() const;
  /// Cells for the box as it is and for disks as large as they will become in this epoch.
  void rebuild_grid();
  void find_steps();
  void leave_bonds(Continuation& continuation) const;
  void take_over_bonds(const Continuation& continuation);

  // ----------------------------------------------------------------------------------------------- disks in flight

  struct Plan {
    Real pair_time = infinity<Real>;
    std::int32_t partner = no_partner;
    std::uint32_t partner_collisions = 0;
    Winding shift = Winding::Zero();  ///< box lengths between this disk and that image of the partner
    BoundaryPlan<Real> boundary;
    CellCrossing<Real> crossing;

    template <class Archive>
    void serialize(Archive& archive) {
      archive(pair_time, partner, partner_collisions, shift, boundary, crossing);
    }
  };

  static constexpr std::int32_t no_partner = -1;
  static constexpr std::int32_t most_compared = 2000;  ///< disks of which all pairs are compared in checks
  static constexpr std::int32_t cell_crossing = -100;  ///< in the place of a partner; below every wall: crossed before it is hit

  [[nodiscard]] static Vec2<Real> momentum(const Record& a) { return a.mass * a.v; }
  [[nodiscard]] Vec2<Real> position(const Record& a, Real t) const { return world_.position(a, t); }
  [[nodiscard]] Vec2<Real> velocity(const Record& a, Real t) const { return world_.velocity(a, t); }
  [[nodiscard]] Real radius_at(const Record& a, Real t) const { return world_.radius(a, t); }

  /// The contact distance of disks i and j at scale 1.
  [[nodiscard]] Real contact_distance(std::int32_t i, std::int32_t j) const {
    return (record(i).radius + record(j).radius) * scales_.of_disks(i, j);
  }

  [[nodiscard]] Real contact_distance_at(std::int32_t i, std::int32_t j, Real t) const {
    return (radius_at(record(i), t) + radius_at(record(j), t)) * scales_.of_disks(i, j);
  }
  /// No contact distance is larger, at scale 1.
  [[nodiscard]] Real largest_contact() const { return 2 * Real(largest_radius_) * scales_.largest(); }
  [[nodiscard]] Winding nearest_image(std::int32_t i, std::int32_t j) const;
  /// The distance by which disk i reaches beyond the walls across an axis; negative where it does not.
  [[nodiscard]] Real beyond_walls(std::int32_t i, int axis) const;
  [[nodiscard]] Real overlap_with(std::int32_t i, std::int32_t j, const Winding& image) const;
  /// Rewrites the record of disk i at the present moment, inside the box. Plans made with the old record become stale.
  Winding bring_to_now(std::int32_t i) {
    Record& a = record(i);
    const Vec2<Real> r = position(a, now_);
    a.v = velocity(a, now_);
    a.r = r;
    a.t = now_;
    ++a.collisions;
    const Winding winding = world_.edges.domain().wrap(a.r);
    grid_.refold(i, winding);
    images_.col(i) += winding;
    return winding;
  }

  void log_event(std::int32_t disk, std::int32_t partner, const Vec2<Real>& v, const Vec2<Real>& partner_v) {
    const Instant when = instant(now_);
    log_.push_back({when.high, when.low, disk, partner, v.template cast<double>(), partner_v.template cast<double>()});
  }

  [[nodiscard]] Instant instant(Real t) const {
    const double high = static_cast<double>(t);
    return epoch_.plus(high).plus(static_cast<double>(t - Real(high)));
  }

  [[nodiscard]] std::int32_t count() const { return static_cast<std::int32_t>(records_.size()); }
  [[nodiscard]] Record& record(std::int32_t i) { return records_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] const Record& record(std::int32_t i) const { return records_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] Plan& plan(std::int32_t i) { return plans_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] const Plan& plan(std::int32_t i) const { return plans_[static_cast<std::size_t>(i)]; }

  Box box_;
  TextbookWorld<Real> world_;
  AnyImpact<Real> impact_;

  CellGrid<Real> grid_;
  EventQueue<Real> queue_;
  std::vector<Record> records_;
  std::vector<Plan> plans_;
  Images images_;  ///< whole box lengths between recorded and unwrapped positions

  Instant epoch_;  ///< the loop's zero of time
  Real now_ = 0;   ///< since the epoch
  Real epoch_length_ = 0;
  double box_size_;  ///< root of the area
  ContactScales<Real> scales_;
  double largest_radius_;
  StallDetector stall_;
  CommonMotion<Real> common_motion_;
  RunningTotals totals_;
  LastInstant last_collision_;
  bool recording_ = false;
  std::vector<Event> log_;

 public:
  // ------------------------------------------------------------------------------------------ seen from outside

  [[nodiscard]] Instant now() const { return instant(now_); }
  [[nodiscard]] Totals totals() const { return totals_.rounded(); }
  [[nodiscard]] const Counts& counts() const { return totals_; }
  [[nodiscard]] std::size_t disk_count() const { return records_.size(); }
  /// Memory held, without the log.
  [[nodiscard]] std::size_t bytes() const;

  /// The state at now(), computed on the side: nothing in the engine changes. Memory that the state has is used again.
  void state(State& state) const;
  [[nodiscard]] State state() const {
    State state;
    this->state(state);
    return state;
  }

  /// Puts the clock back to an earlier time, since which nothing has happened.
  void set_back(const Instant& time) { now_ = time.since<Real>(epoch_); }

  /// Makes now the zero of time and forgets the totals.
  void reset_clock();

  /// Gives disk i a new velocity, which in a flow is relative to it, and, where disks spin, a new spin. Returns the energy that
  /// it gained.
  double set_velocity(std::int32_t i, const Eigen::Vector2d& v, double spin);
  /// Returns the velocity of disk i at now().
  [[nodiscard]] Eigen::Vector2d velocity(std::int32_t i) const { return velocity(record(i), now_).template cast<double>(); }

  /// The kinetic energy of disk i, with its spin. Requires that its record is of now.
  [[nodiscard]] double kinetic_energy(std::int32_t i) const;

  /// Multiplies all velocities and spins by `factor`.
  void scale_velocities(double factor);

  /// A program's own collision rule: see Simulation::set_collision_rule().
  static constexpr bool takes_rules = true;
  void set_collision_rule(CollisionFunction rule) { impact_.set_rule(std::move(rule), nullptr); }

  /// Writes down what an engine needs that takes the place of this one.
  void leave(Continuation& continuation) const;
  /// Takes the place of another engine. Requires an engine that has just been made.
  void take_over(const Continuation& continuation);

  void record_events(bool on) { recording_ = on; }
  /// Puts the events recorded since the last call in the place of what `events` held.
  void take_events(std::vector<Event>& events) {
    events.clear();
    std::swap(events, log_);
  }

  /// One sentence for every way in which the plan differs from what an exhaustive search finds, and for every pair that overlaps
  /// by more of its contact distance than is tolerated.
  [[nodiscard]] std::vector<std::string> check_invariants(double tolerated_overlap = 0.0) const;
  /// Returns the deepest overlap of any pair or of any disk with an obstacle, over the contact distance, and of any disk with a
  /// wall, over its radius; 0 where none overlaps, and for more than most_compared disks.
  [[nodiscard]] double deepest_overlap() const;

  /// All that decides how the run goes on, for core/archive.hpp. Requires all events to have been taken.
  template <class Archive>
  void serialize(Archive& archive);
};

}  // namespace carom
