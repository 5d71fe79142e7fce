#pragma once
// Event-driven molecular dynamics of hard disks as Alder & Wainwright (J. Chem. Phys. 31, 459 (1959)) wrote it down, in
// the plainest form that is O(log N) per event: every disk plans its own next event, a heap knows the earliest of all
// plans, a cell grid tells who may meet whom. Read from run_until() downwards.
//
// Between two collisions a disk's record (r, v, t) stays as the last collision left it. The time at which a pair meets
// is a function of the two records alone, so it does not matter when, how often or from which side it is predicted:
// cells, stale plans, sampling and stopping leave no trace in the bits, and an all-pairs search without any of these
// finds the same trajectory to the last bit (tests/engine/textbook_twin_test.cpp).

#include "core/contact_time.hpp"
#include "core/domain.hpp"
#include "core/instant.hpp"
#include "effects/hard_wall.hpp"
#include "effects/impact.hpp"
#include "engine/epoch.hpp"
#include "neighbours/cell_grid.hpp"
#include "queue/event_queue.hpp"

#include <carom/state.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace carom {

template <class Real, class Rule>
class TextbookEngine {
 public:
  /// Requires disks inside the box, radii and masses > 0, everything finite. Real may round what it is given.
  TextbookEngine(const Box& box, const Disks& disks, const State& start);

  // ---------------------------------------------------------------------------------------------------- the loop

  /// Processes every event with time <= target, then stands at target (at the last event where target is forever and none
  /// is to come) and returns true. Returns false, and stands at the last event, where totals().pair reaches `pair_limit`,
  /// after `event_limit` events of any kind, and when jammed().
  bool run_until(const Instant& target, std::uint64_t pair_limit, std::uint64_t event_limit) {
    for (; totals_.pair < pair_limit && event_limit > 0 && !jammed(); --event_limit) {
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

  /// Nothing will ever happen again.
  [[nodiscard]] bool idle() const { return queue_.empty() || queue_.next().time == infinity<Real>; }

  /// Time has stopped: millions of events at one instant, as of disks that touch on all sides and still are to move.
  [[nodiscard]] bool jammed() const { return at_one_instant_ > 10'000'000 + 100 * records_.size(); }

 private:
  /// The next event of all.
  void step() {
    const QueuedEvent<Real> event = queue_.next();
    at_one_instant_ = event.time > now_ ? 0 : at_one_instant_ + 1;
    now_ = std::max(now_, event.time);
    if (event.higher == cell_crossing) {
      cross_cell(event.disk);
    } else if (event.higher < 0) {
      reflect(event.disk, static_cast<Wall>(event.higher));
    } else if (is_stale(event.disk)) {
      ++totals_.stale;
      predict(event.disk);
    } else {
      collide(event.disk, plan(event.disk).partner, plan(event.disk).shift);
    }
  }

  // -------------------------------------------------------------------------------------------------- the events

  /// Two disks meet: bring both to the place of contact, exchange momentum by the rule, predict anew.
  void collide(std::int32_t i, std::int32_t j, Winding shift) {
    shift -= bring_to_now(i) - bring_to_now(j);
    if (j < i) {
      std::swap(i, j);
      shift = -shift;
    }
    Record& a = record(i);
    Record& b = record(j);
    const ImpactResult<Real> impact = carom::collide<Rule, Real>(separation(a, b, now_, shift), a.mass, a.v, b.mass, b.v);
    ++totals_.pair;
    totals_.virial += static_cast<double>(impact.virial);
    if (recording_) log_event(i, j, a.v, b.v);
    if (outruns_epoch(a.v, now_, box_size_) || outruns_epoch(b.v, now_, box_size_)) {
      begin_epoch(now_);
      return;
    }
    predict(i);
    predict(j);
  }

  /// A disk meets a wall: its velocity across the wall is reversed.
  void reflect(std::int32_t i, Wall wall) {
    bring_to_now(i);
    Record& a = record(i);
    Real& across = a.v[axis_of(wall)];
    ++totals_.wall;
    using std::abs;
    totals_.wall_impulse[static_cast<std::size_t>(-1 - wall)] += 2 * static_cast<double>(a.mass * abs(across));
    across = -across;
    if (recording_) log_event(i, wall, a.v, Vec2<Real>(0, 0));
    predict(i);
  }

  /// A disk enters the next cell and may meet those who come into reach. Its record stays as it is.
  void cross_cell(std::int32_t i) {
    Plan& mine = plan(i);
    const CellCrossing<Real> crossing = mine.crossing;
    ++totals_.other;
    grid_.cross(i, crossing);
    grid_.for_neighbours_ahead(i, crossing, [&](std::int32_t j, const Winding& shift) { consider(i, j, shift); });
    mine.crossing = grid_.next_crossing(i, record(i).r, record(i).v, record(i).t);
    queue_.update(next_of(i));
  }

  // -------------------------------------------------------------------------------------------------- prediction

  void predict(std::int32_t i) {
    make_plan(i);
    queue_.update(next_of(i));
  }

  /// Disk i against every neighbour, its walls and the edges of its cell.
  void make_plan(std::int32_t i) {
    const Record& a = record(i);
    Plan& mine = plan(i);
    mine.pair_time = infinity<Real>;
    mine.partner = nobody;
    grid_.for_neighbours(i, [&](std::int32_t j, const Winding& shift) { consider(i, j, shift); });
    mine.wall = next_wall_contact(domain_, a.r, a.v, a.radius, a.t);
    mine.crossing = grid_.next_crossing(i, a.r, a.v, a.t);
  }

  /// Keeps the collision with disk j if it comes before the one planned so far.
  void consider(std::int32_t i, std::int32_t j, const Winding& shift) {
    Plan& mine = plan(i);
    const Real time = pair_time(record(i), record(j), shift);
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
    const QueuedEvent<Real> wall{mine.wall.time, i, mine.wall.wall, i};
    const QueuedEvent<Real> crossing{mine.crossing.time, i, cell_crossing, i};
    if (wall.before(next)) next = wall;
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
    now_ = 0;
    epoch_length_ = suitable_epoch_length();
    grid_.clear();
    for (std::int32_t i = 0; i < count(); ++i) grid_.insert(i, record(i).r);
    std::vector<QueuedEvent<Real>> events;
    events.reserve(records_.size());
    for (std::int32_t i = 0; i < count(); ++i) {
      make_plan(i);
      events.push_back(next_of(i));
    }
    queue_.assign(events);
  }

  /// epoch_length() for the disks as they move now.
  [[nodiscard]] Real suitable_epoch_length() const;

  // ----------------------------------------------------------------------------------------------- disks in flight

  /// A disk as its last collision left it. One cache line in double precision.
  struct alignas(64) Record {
    Vec2<Real> r;  ///< position at time t
    Vec2<Real> v;
    Real t = 0;  ///< since the epoch
    Real radius = 0;
    Real mass = 0;
    std::uint32_t collisions = 0;  ///< so far; tells whether a plan with this disk still holds
  };

  struct Plan {
    Real pair_time = infinity<Real>;
    std::int32_t partner = nobody;
    std::uint32_t partner_collisions = 0;
    Winding shift = Winding::Zero();  ///< box lengths between this disk and that image of the partner
    WallContact<Real> wall;
    CellCrossing<Real> crossing;
  };

  static constexpr std::int32_t nobody = -1;
  static constexpr std::int32_t cell_crossing = -100;  ///< in the place of a partner; below every wall: crossed before it is hit

  [[nodiscard]] static Vec2<Real> position(const Record& a, Real t) { return a.r + a.v * (t - a.t); }

  [[nodiscard]] Vec2<Real> separation(const Record& a, const Record& b, Real t, const Winding& shift) const {
    Vec2<Real> r = position(a, t) - position(b, t);
    if (shift[0] != 0) r[0] -= Real(shift[0]) * domain_.length[0];
    if (shift[1] != 0) r[1] -= Real(shift[1]) * domain_.length[1];
    return r;
  }

  /// When the two records meet; the same whichever is called a, and whenever it is asked.
  [[nodiscard]] Real pair_time(const Record& a, const Record& b, const Winding& shift) const {
    const Real t = std::max(a.t, b.t);
    return t + contact_time<Real>(separation(a, b, t, shift), a.v - b.v, a.radius + b.radius);
  }

  /// Rewrites the record of disk i at the present moment, inside the box. Plans that know the old record become stale.
  Winding bring_to_now(std::int32_t i) {
    Record& a = record(i);
    a.r = position(a, now_);
    a.t = now_;
    ++a.collisions;
    const Winding winding = domain_.wrap(a.r);
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

  Domain<Real> domain_;
  CellGrid<Real> grid_;
  EventQueue<Real> queue_;
  std::vector<Record> records_;
  std::vector<Plan> plans_;
  Images images_;  ///< whole box lengths between recorded and unwrapped positions

  Instant epoch_;  ///< the loop's zero of time
  Real now_ = 0;   ///< since the epoch
  Real epoch_length_ = 0;
  double box_size_;                   ///< root of the area
  std::uint64_t at_one_instant_ = 0;  ///< events since time last advanced
  Totals totals_;
  bool recording_ = false;
  std::vector<Event> log_;

 public:
  // ------------------------------------------------------------------------------------- for those who look on

  [[nodiscard]] Instant now() const { return instant(now_); }
  [[nodiscard]] const Totals& totals() const { return totals_; }
  [[nodiscard]] std::size_t disk_count() const { return records_.size(); }

  /// The state at now(), computed on the side: nothing in the engine changes.
  [[nodiscard]] State state() const;

  /// Makes now the zero of time and forgets the totals.
  void reset_clock() {
    begin_epoch(now_);
    epoch_ = Instant{};
    totals_ = Totals{};
  }

  void record_events(bool on) { recording_ = on; }
  [[nodiscard]] std::vector<Event> take_events() { return std::exchange(log_, {}); }

  /// One sentence for every way in which the plan differs from what an exhaustive search finds.
  [[nodiscard]] std::vector<std::string> check_invariants() const;
};

}  // namespace carom

#include "engine/textbook_state.hpp"
