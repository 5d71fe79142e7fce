#pragma once
// The event loop of the fast engine (engine/engine.hpp). Read from run_until() downwards.
//
// Every disk has one plan (engine/plans.hpp): the earliest collision that its last prediction found, and when it leaves its
// neighbourhood or meets a wall. Of two partners the one predicted last has the collision in its plan; a plan whose partner has
// collided since is stale and made anew when its time comes.
//
// Disks are known by their slots, indices in the order of memory, which keeps neighbours in the box near each other; ids_ has
// their ids. loop_state.hpp has what the loop works on.
//
// engine_impl.hpp has the functions that are only declared here, which happen once per epoch or seldom: epochs, ties, sheared
// boxes. engine.hpp has what is asked of an engine between events.

#include "core/instant.hpp"
#include "core/sides.hpp"
#include "core/vec2.hpp"
#include "effects/plain_world.hpp"
#include "engine/contact_count.hpp"
#include "engine/loop_state.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace carom {

class Redraws;
struct Redraw;
template <class Impact, class Layout, class World>
class BoxDomain;
template <class Impact, class Layout, class World>
class Domains;

template <class Impact, class Layout, class World>
class EventLoop : public LoopState<Impact, Layout, World> {
  friend class BoxDomain<Impact, Layout, World>;  // parallel/: they take the disks from a whole engine and give them back
  friend class Domains<Impact, Layout, World>;

  using Parts = LoopState<Impact, Layout, World>;

 public:
  /// Requires an empty why_not(), disks inside the box, radii and masses > 0, everything finite. `seed` is that of the random
  /// numbers that effects draw.
  EventLoop(const Box& box, const Disks& disks, State start, const Effects& effects = {}, std::uint64_t seed = 1);
  /// The engine of a part of the box: see LoopState.
  EventLoop(const EventLoop& whole, std::size_t slots) : Parts(whole, slots) {}

  /// Processes every event with time <= target, then stands at target (at the last event where target is forever and none
  /// is to come) and returns true. Returns false, and stands at the last event, where totals().pair reaches `pair_limit`,
  /// after `event_limit` events of any kind, and when stall().is_stalled().
  bool run_until(const Instant& target, std::uint64_t pair_limit, std::uint64_t event_limit) {
    double end = target.since<double>(epoch_);
    for (; totals_.pair < pair_limit && event_limit > 0 && !stall_.is_stalled(); --event_limit) {
      const auto [time, disk] = queue_.next(plans_, [this](std::int64_t span) { prefetch_calendar(span); });
      if (time <= end && time < epoch_length_) [[likely]] {
        step(disk, time);
        if (now_ == 0.0) end = target.since<double>(epoch_);  // a new epoch may have begun
      } else if (epoch_length_ <= std::min(time, end) && epoch_length_ < never) {
        begin_epoch(epoch_length_);
        end = target.since<double>(epoch_);
      } else {
        if (target < forever) now_ = std::max(now_, end);
        return true;
      }
    }
    return false;
  }

 protected:
  using Parts::epoch_, Parts::now_, Parts::epoch_length_, Parts::stamp_, Parts::mean_speed_, Parts::limits_, Parts::sizes_;
  using Parts::last_collision_, Parts::count, Parts::line, Parts::id, Parts::data, Parts::surroundings, Parts::predicted;
  using Parts::layout_, Parts::impact_, Parts::world_, Parts::flight_, Parts::boundaries_, Parts::frame_, Parts::kernel_;
  using Parts::lines_, Parts::ids_, Parts::plans_, Parts::lists_, Parts::queue_, Parts::tuning_, Parts::pacing_;
  using Parts::make_lists, Parts::outgrow_lists, Parts::rebuild, Parts::set_half_width, Parts::update_shear;
  using Parts::never, Parts::last_stamp, Parts::part_, Parts::stopped_;
  using Parts::predicted_against, Parts::lowest_of_tied, Parts::prefetch_calendar, Parts::leave_to_whole, Parts::fail_between;
  using Parts::prefetcher_, Parts::stall_, Parts::common_motion_, Parts::recorder_, Parts::totals_, Parts::counted_;
  using Parts::rebase, Parts::rebase_clock, Parts::choose_epoch_length, Parts::reset_falling_frame;
  using typename Parts::Line;

  /// Processes the next event of all.
  [[gnu::flatten]] void step(std::int32_t i, double time) {
    if constexpr (World::plain)
      stall_.count_event(time > now_);
    else
      stall_.count_event(time, now_);
    now_ = std::max(now_, time);
    const Plan& mine = plans_[i];
    if (mine.edge_first()) {
      queue_.pop(plans_);
      prefetcher_.next(data());
      mine.edge == neighbourhood_edge ? leave_neighbourhood(i) : hit(i, mine.edge);
    } else if (plans_.is_stale(mine)) {
      queue_.pop(plans_);
      prefetcher_.next(data());
      ++counted_->stale;
      predict(i);
    } else {
      collide(i, mine.partner);
    }
  }

  // -------------------------------------------------------------------------------------------------- the events

  /// Processes the collision of two disks: exchanges momentum, draws new lines, predicts both disks anew.
  void collide(std::int32_t i, std::int32_t j) {
    const Line &a = line(i), &b = line(j);
    Vec2<double> va(a.v[0], a.v[1]), vb(b.v[0], b.v[1]);
    const Vec2<double> before_a = va, before_b = vb;
    if (const std::int32_t above = flight_.boxes_above(i, j); above == 0) [[likely]]
      exchange(flight_.separation(a, b, now_), i, va, j, vb);
    else
      meet_across_sheared_edge(i, va, j, vb, above);
    plans_[i].last_collided = plans_[j].last_collided = ++stamp_;
    if (recorder_.active()) recorder_.record(now_, i, j, before_a, before_b, va, vb);
    if (limits_.exceeded_by(va) || limits_.exceeded_by(vb)) [[unlikely]]
      return begin_epoch_early(i, va, j, vb);

    CollidedPair pair;
    pair.disk[0] = i, pair.disk[1] = j;
    pair.around[0] = surroundings(i), pair.around[1] = surroundings(j);
    tuning_.count_examined(pair.around[0].count, pair.around[1].count);
    queue_.pop(plans_, j);  // not earlier: all up to here goes on while the predictions before still wait for their results
    prefetcher_.next(data());
    kernel_.turn_and_predict(lines_.data(), frame_, pair, now_, va[0], va[1], vb[0], vb[1]);
    if (pair.wrapped != 0) [[unlikely]]
      flight_.count_images(pair);
    prefetcher_.partner_of_next(data());
    set_plan(i, pair.ahead[0]);
    set_plan(j, pair.ahead[1]);
    queue_.push(plans_, i, plans_.time(i), j, plans_.time(j));
    if (stamp_ == last_stamp) [[unlikely]]
      begin_epoch(now_);
  }

  /// Changes the velocities of disks i and j by their contact at separation r = r_i - r_j.
  void exchange(const Vec2<double>& r, std::int32_t i, Vec2<double>& va, std::int32_t j, Vec2<double>& vb) {
    const Line &a = line(i), &b = line(j);
    const double scale = world_.scale(now_), radius_a = layout_.radius(a), radius_b = layout_.radius(b);
    const double contact = layout_.contact_distance(a, b), sigma = contact * scale, expansion = contact * world_.expansion();
    count_contact<double>(r, va - vb, sigma, expansion, counted_->numerics);
    last_collision_.count(now_, counted_->numerics);
    const auto meet = [&] {
      return impact_.meet(r, sigma, expansion, {i, layout_.mass(a), radius_a * scale, va},
                          {j, layout_.mass(b), radius_b * scale, vb}, now_, *counted_);
    };
    if constexpr (Impact::plain)
      meet();
    else
      stall_.record_loss(meet(), {id(i), id(j)});
  }

  /// Processes the contact of a disk with what bounds its flight: a wall or an obstacle.
  void hit(std::int32_t i, std::int32_t what) {
    if constexpr (!World::plain)
      if (world_.sheared()) return cross_sheared_edge(i, is_upper(static_cast<Wall>(what)) ? 1 : -1);
    const Line& a = line(i);
    Vec2<double> v = flight_.velocity(a, now_);
    const BoundaryContact contact{flight_.place(a, now_), layout_.mass(a), layout_.radius(a) * world_.scale(now_),
                                  layout_.radius(a) * world_.expansion(), impact_.is_elastic(i, now_)};
    if constexpr (World::plain) {
      world_.meet(what, contact, v, now_, *counted_);
    } else {
      const auto loss = world_.meet(what, contact, v, now_, *counted_);
      stall_.record_loss(loss.smallness, {id(i)});
      stall_.record_rest(now_, loss.rest);
    }
    impact_.record_collision_time(i, now_);
    if (recorder_.logging()) recorder_.log_hit(now_, i, what, v);
    change_velocity(i, v);
    if (world_.is_movable(what)) plan_edges_anew();
  }

  /// Gives disk i the velocity v from now on.
  void change_velocity(std::int32_t i, const Vec2<double>& v) {
    plans_[i].last_collided = ++stamp_;
    const Vec2<double> along = flight_.line_velocity(v, now_);
    if (limits_.exceeded_by(along)) [[unlikely]]
      return begin_epoch_early(i, along, i, along);
    flight_.change_velocity(i, line(i), v, now_);
    predict(i);
    if (stamp_ == last_stamp) [[unlikely]]
      begin_epoch(now_);
  }

  /// Gives disk i the velocity v, in a sheared box relative to the flow, and where disks spin that spin, from now on. Returns the
  /// energy that it gained.
  double give_velocity(std::int32_t i, const Vec2<double>& v, double spin);
  /// Redraws the velocity of disk i, from now on. Returns the energy that it gained.
  double redraw(std::int32_t i, const Redraws& redraws, const Redraw& redraw);

  /// Gives a disk that leaves its neighbourhood a new one round where it is, and predicts it against the disks that come within
  /// reach. What it has planned with others stays as it is.
  void leave_neighbourhood(std::int32_t i) {
    ++counted_->other;
    tuning_.count_left();
    const NeighbourhoodCentre centre = flight_.neighbourhood_centre(i, line(i), now_, lists_.half_width());
    const auto fresh = lists_.begin_move(i, centre);
    if (world_.sheared()) flight_.height(i) = centre.y;
    const Prediction ahead =
        predicted(i, {{lists_.centre(i).x, lists_.centre(i).y}, fresh.data(), static_cast<std::uint32_t>(fresh.size())});
    lists_.end_move(i);  // after the prediction: lists that are not in the cache arrive meanwhile
    if (plans_.precedes_planned(i, ahead.pair_time, ahead.partner)) {
      set_plan(i, ahead);
    } else {
      plan_edge(i, ahead.edge_time);
    }
    schedule(i);
  }

  /// Processes the collision of disk i with the image of disk j that lies `above` boxes above it, past an edge where images
  /// slide.
  [[gnu::noinline]] void meet_across_sheared_edge(std::int32_t i, Vec2<double>& va, std::int32_t j, Vec2<double>& vb,
                                                  std::int32_t above);
  /// Lets a disk that leaves the box upwards (1) or downwards (-1) past images that slide come back as its own image.
  [[gnu::noinline]] void cross_sheared_edge(std::int32_t i, std::int32_t up);

  // -------------------------------------------------------------------------------------------------- prediction

  /// Predicts disk i against all its neighbours, what bounds its flight and the edges of its neighbourhood.
  void predict(std::int32_t i) {
    set_plan(i, predicted(i, surroundings(i)));
    schedule(i);
  }

  /// Takes a prediction as the plan of disk i. By reference: see Prediction.
  void set_plan(std::int32_t i, const Prediction& ahead) {
    Plan& mine = plans_[i];
    mine.pair_time = ahead.pair_time;
    mine.partner = ahead.tied == 0 ? ahead.partner : lowest_of_tied(i, ahead);
    mine.predicted_at = stamp_;
    plan_edge(i, ahead.edge_time);
  }

  void plan_edge(std::int32_t i, double leaving_time) {
    Plan& mine = plans_[i];
    mine.edge_time = leaving_time;
    mine.edge = neighbourhood_edge;
    if (boundaries_.within_reach(lists_.centre(i)))
      boundaries_.plan(i, line(i), layout_.radius(line(i)), now_, epoch_length_, plans_);
  }

  /// Plans contacts with what bounds flights anew for all disks, after a piston has changed its motion.
  void plan_edges_anew();

  void schedule(std::int32_t i) { queue_.push(plans_, i, plans_.time(i)); }

  // ------------------------------------------------------------------------------------------------ epochs and lists

  /// Makes time `now` the epoch: every line starts there, every plan counts from there. Short times keep their digits, and no
  /// line gets so long that coordinates wrap unseen.
  [[gnu::noinline]] void begin_epoch(double now);
  /// Begins an epoch in the middle of a collision after which a disk is too fast for its line to be drawn from the old one.
  /// Velocities are those of lines. i and j may be the same disk.
  [[gnu::noinline, gnu::cold]] void begin_epoch_early(std::int32_t i, const Vec2<double>& va, std::int32_t j,
                                                      const Vec2<double>& vb);
  /// Makes everything anew that an epoch needs after rebase().
  void replan();
  void widen_coordinates();
  void start_queue();
  void predict_all();
  void list_larger();
  void tune_neighbourhoods(double elapsed);
  void follow_shear();
};

}  // namespace carom
