#pragma once
// Epochs: the loop counts time from the beginning of one, and lines are drawn from there. How long one lasts, and all that is
// made anew when the next begins.

#include "engine/epoch.hpp"
#include "engine/event_loop.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace carom {

template <class Impact, class Layout, class World>
void EventLoop<Impact, Layout, World>::begin_epoch(double now) {
  if (leave_to_whole()) return;
  rebase(now);
  if constexpr (!Impact::plain)
    if (common_motion_.present())
      impact_.set_momentum_correction(
          common_motion_.momentum_correction(lines_, [this](const Line& a) { return layout_.momentum(a); }));
  if constexpr (!World::plain) reset_falling_frame(), widen_coordinates();
  if (now > 0.0) tune_neighbourhoods(now);
  choose_epoch_length();
  if constexpr (!World::plain) follow_shear();
  if (outgrow_lists())
    list_larger();
  else if (world_.falls())
    predict_all();  // the frame starts from rest again, and disks leave their neighbourhoods at other times
  pacing_.judge(now, queue_.pushed(), lines_.size());
  start_queue();
}

template <class Impact, class Layout, class World>
void EventLoop<Impact, Layout, World>::begin_epoch_early(std::int32_t i, const Vec2<double>& va, std::int32_t j,
                                                         const Vec2<double>& vb) {
  if (leave_to_whole()) return;
  if (!va.allFinite() || !vb.allFinite()) return fail_between(i, j);
  const Vec2<double> fallen = world_.g() * now_;
  rebase(now_);
  ++totals_.numerics.early_epochs;
  for (int k = 0; k < 2; ++k) line(i).v[k] = va[k] + fallen[k], line(j).v[k] = vb[k] + fallen[k];
  if (world_.expansion() > 0.0 || world_.falls()) return replan();
  if constexpr (!World::plain) widen_coordinates();
  choose_epoch_length();
  if constexpr (!World::plain) follow_shear();
  for (const std::int32_t k : {i, j}) set_plan(k, predicted(k, surroundings(k)));
  start_queue();
}

template <class Impact, class Layout, class World>
void LoopState<Impact, Layout, World>::fail_between(std::int32_t i, std::int32_t j) {
  // Its record is that of no event.
  i == j ? recorder_.withdraw_hit() : recorder_.withdraw_collision();
  stall_.fail(i == j ? fmt::format("disk {}: its velocity would not be finite after what it has met", id(i))
                     : fmt::format("disks {} and {}: their velocities would not be finite after their collision", id(i), id(j)));
}

template <class Impact, class Layout, class World>
void EventLoop<Impact, Layout, World>::replan() {
  if constexpr (!World::plain) reset_falling_frame(), widen_coordinates();
  choose_epoch_length();
  if (outgrow_lists()) list_larger();
  if constexpr (!World::plain) follow_shear();
  predict_all();
  start_queue();
}

template <class Impact, class Layout, class World>
void LoopState<Impact, Layout, World>::rebase(double now) {
  for (std::int32_t i = 0; i < count(); ++i) flight_.rebase(i, line(i), now);
  plans_.rebase(now);
  stamp_ = 1;
  impact_.rebase(now);
  rebase_clock(now);
}

/// Lets the clock, and all that belongs to no disk, count from `now`.
template <class Impact, class Layout, class World>
void LoopState<Impact, Layout, World>::rebase_clock(double now) {
  last_collision_.rebase();
  stall_.begin_epoch();
  ++totals_.numerics.epochs;
  if constexpr (!World::plain) flight_.fall(now);
  world_.rebase(now);
  frame_.scale = world_.scale(0.0);
  recorder_.begin_epoch(epoch_ = epoch_.plus(now));
  now_ = 0.0;
}

/// Makes all velocities and spins `factor` times what they are, from the epoch on. The plans must be made anew.
template <class Impact, class Layout, class World>
void LoopState<Impact, Layout, World>::multiply_velocities(double factor) {
  for (Line& a : lines_)
    for (int k = 0; k < 2; ++k) a.v[k] *= factor;
  if constexpr (!Impact::plain)
    for (std::int32_t i = 0; i < count() && impact_.spinning(); ++i) impact_.spin(i) *= factor;
}

template <class Impact, class Layout, class World>
void LoopState<Impact, Layout, World>::choose_epoch_length() {
  SpeedSummary speeds;
  for (const Line& a : lines_) speeds.add(a.v);
  choose_epoch_length(speeds);
}

/// Chooses the length of the epoch that begins with these speeds of all disks.
template <class Impact, class Layout, class World>
void LoopState<Impact, Layout, World>::choose_epoch_length(const SpeedSummary& speeds) {
  stall_.check_speeds(is_too_slow<double>(std::max(speeds.fastest[0], speeds.fastest[1]), sizes_.mean_diameter));
  const double sum = speeds.sum.value();
  if (!(sum < never)) stall_.fail("a velocity is not finite");
  mean_speed_ = sum / static_cast<double>(std::max(count(), 1));
  // Rounding x + v t moves a disk by 2^-53 of the way since the epoch: some spacings for most, never more than the room
  // that coordinates have, were the fastest to become somewhat faster.
  double longest = 4.0 * sizes_.spacing / mean_speed_;
  for (int k = 0; k < 2; ++k) longest = std::min(longest, limits_.longest_line[k] / (1.2 * speeds.fastest[k]));
  if constexpr (!World::plain) longest = std::min(longest, longest_epoch_of_world());
  epoch_length_ = longest < 0x1p1000 ? std::ldexp(1.0, std::ilogb(longest)) : never;
  frame_.edge_step = epoch_length_ < never ? 0x1p-20 * epoch_length_ : 0.0;
  limits_.set_epoch_length(epoch_length_);
  stall_.set_epoch_length(epoch_length_);
}

/// The longest epoch that the effects allow.
template <class Impact, class Layout, class World>
double LoopState<Impact, Layout, World>::longest_epoch_of_world() const {
  double longest = never;
  const double pull = std::max(world_.g().cwiseAbs().maxCoeff(), world_.walls.strongest());
  if (pull > 0.0) longest = std::sqrt(8.0 * sizes_.spacing / pull);
  // Along a periodic axis the frame falls by an eighth of the box, at most: coordinates have no more room.
  for (int k = 0; k < 2; ++k)
    if (const double fall = std::abs(world_.g()[k]); fall > 0.0 && flight_.axis(k).periodic)
      longest = std::min(longest, std::sqrt(flight_.length(k) / (4.0 * fall)));
  if (world_.walls.fastest(0.0) > 0.0) longest = std::min(longest, 4.0 * sizes_.spacing / world_.walls.fastest(0.0));
  if (world_.expansion() > 0.0) longest = std::min(longest, world_.scale(0.0) / (64.0 * world_.expansion()));
  if (world_.sheared()) longest = std::min(longest, limits_.shear_displacement / std::abs(world_.lees_edwards.speed()));
  return longest;
}

/// The frame of the lines falls on from epoch to epoch, with the neighbourhoods in it. Before it leaves the box behind it is
/// put back to the box. Then all disks must be predicted anew.
template <class Impact, class Layout, class World>
void LoopState<Impact, Layout, World>::reset_falling_frame() {
  if (!flight_.has_fallen(4.0 * sizes_.spacing)) return;
  flight_.reset_fall(lines_);
  rebuild(frame_.half_width);
}

template <class Impact, class Layout, class World>
double LoopState<Impact, Layout, World>::layer_of_lines(int axis, double t) const {
  double out = 0.0;
  if constexpr (!World::plain)
    out = std::max(world_.walls.displacement(wall_of(axis, false), t), world_.walls.displacement(wall_of(axis, true), t));
  return 4.0 * (flight_.length(axis) / 2.0 + out + free_path * sizes_.spacing);
}

template <class Impact, class Layout, class World>
bool LoopState<Impact, Layout, World>::may_widen_coordinates(double t) const {
  if constexpr (!World::plain)
    for (int k = 0; k < 2; ++k)
      if (!flight_.axis(k).periodic && !(layer_of_lines(k, t) * (1.0 + 0x1p-20) <= layer_of_coordinates(k))) return true;
  return false;
}

/// A line has the length of the box and some spacings of room on either side. When walls have used up half of that, coordinates
/// are made coarser: by a power of two, so that nothing but their last digits changes.
template <class Impact, class Layout, class World>
void EventLoop<Impact, Layout, World>::widen_coordinates() {
  bool wider = false;
  for (int k = 0; k < 2; ++k) {
    if (flight_.axis(k).periodic || this->layer_of_lines(k, 0.0) <= this->layer_of_coordinates(k)) continue;
    flight_.coarsen(k, lines_);
    frame_.unit[k] = flight_.axis(k).unit;
    frame_.steps[k] = flight_.axis(k).steps;
    wider = true;
  }
  if (!wider) return;
  list_larger();
  widen_coordinates();
}

/// Predicts all disks.
template <class Impact, class Layout, class World>
void EventLoop<Impact, Layout, World>::predict_all() {
  for (std::int32_t i = 0; i < count(); ++i) set_plan(i, predicted(i, surroundings(i)));
}

template <class Impact, class Layout, class World>
void EventLoop<Impact, Layout, World>::start_queue() {
  if (pacing_.span() == 0.0) {
    std::vector<double> times(lines_.size());
    for (std::int32_t i = 0; i < count(); ++i) times[static_cast<std::size_t>(i)] = plans_.time(i);
    pacing_.choose_span(std::move(times), epoch_length_);
  }
  queue_.start(pacing_.span(), lines_.size(), epoch_length_, prefetcher_.looks_ahead(), pacing_.busy());
  for (std::int32_t i = 0; i < count(); ++i) schedule(i);
  pacing_.begin(now_, queue_.pushed());
}

}  // namespace carom
