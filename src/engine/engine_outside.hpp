#pragma once
// The state of an engine between events, its archive, and changes from outside.

#include "effects/redraws.hpp"
#include "engine/engine.hpp"

#include <cmath>
#include <numeric>

namespace carom {

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::state(State& state) const {
  store_velocities(state);
  state.positions.resize(2, count());
  state.images.resize(2, count());
  state.remainders.resize(2, count());
  for (std::int32_t i = 0; i < count(); ++i) {
    const Line& a = line(i);
    const auto column = static_cast<Eigen::Index>(id(i));
    for (int k = 0; k < 2; ++k) {
      const auto [position, remainder, image] = flight_.coordinate_in_box(i, a, k, now_);
      state.positions(k, column) = position;
      state.remainders(k, column) = remainder;
      state.images(k, column) = image;
    }
  }
  state.shear_displacement = 0.0;
  if constexpr (!World::plain)
    if (world_.sheared()) state.shear_displacement = world_.lees_edwards.reduced(now_);
  state.bonds = 0;
  state.pairs_in_steps.clear();
  state.spins.resize(impact_.spinning() ? count() : 0);
  if constexpr (!Impact::plain) {
    state.pairs_in_steps = impact_.potential().pairs();
    state.bonds = std::accumulate(state.pairs_in_steps.begin(), state.pairs_in_steps.end(), std::uint64_t{0});
    for (std::int32_t i = 0; i < count() && impact_.spinning(); ++i) state.spins[id(i)] = impact_.spin(i);
  }
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::store_velocities(State& state) const {
  state.time = now().high;
  state.velocities.resize(2, count());
  for (std::int32_t i = 0; i < count(); ++i) {
    const Vec2<double> v = flight_.velocity(line(i), now_);
    state.velocities.col(id(i)) << v[0], v[1];
  }
  state.scale = world_.scale(now_);
  state.walls.clear();
  if constexpr (!World::plain) state.walls = world_.walls.states(now_);
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::reset_clock() {
  begin_epoch(now_);
  recorder_.begin_epoch(epoch_ = Instant{});
  const std::uint64_t longest_neighbour_list = totals_.numerics.longest_neighbour_list;  // of now, not of the time before
  totals_ = RunningTotals{};
  totals_.numerics.longest_neighbour_list = longest_neighbour_list;
}

template <class Impact, class Layout, class World>
std::int32_t Engine<Impact, Layout, World>::slot_of(std::int32_t disk) {
  if (slot_of_id_.empty()) {
    slot_of_id_.resize(lines_.size());
    for (std::int32_t i = 0; i < count(); ++i) slot_of_id_[static_cast<std::size_t>(id(i))] = i;
  }
  return slot_of_id_[static_cast<std::size_t>(disk)];
}

template <class Impact, class Layout, class World>
Eigen::Vector2d Engine<Impact, Layout, World>::velocity(std::int32_t disk) {
  const Vec2<double> v = flight_.velocity(line(slot_of(disk)), now_);
  return {v[0], v[1]};
}

template <class Impact, class Layout, class World>
double Engine<Impact, Layout, World>::set_velocity(std::int32_t disk, const Eigen::Vector2d& v, double spin) {
  return this->give_velocity(slot_of(disk), v, spin);
}

template <class Impact, class Layout, class World>
double EventLoop<Impact, Layout, World>::give_velocity(std::int32_t i, const Vec2<double>& v, double spin) {
  const double mass = layout_.mass(line(i));
  Vec2<double> to = v;  // NOLINT(performance-unnecessary-copy-initialization): in some worlds it changes
  if constexpr (!World::plain)
    if (world_.sheared()) to[0] += world_.lees_edwards.flow(flight_.height_in_box(i, line(i), now_));
  double gained = mass * (to.squaredNorm() - flight_.velocity(line(i), now_).squaredNorm()) / 2.0;
  if constexpr (!Impact::plain)
    if (impact_.spinning()) {
      const double radius = layout_.radius(line(i)) * world_.scale(now_);
      gained += mass * radius * radius * (spin * spin - impact_.spin(i) * impact_.spin(i)) / 4.0;
      impact_.spin(i) = spin;
    }
  change_velocity(i, to);
  return gained;
}

template <class Impact, class Layout, class World>
double EventLoop<Impact, Layout, World>::redraw(std::int32_t i, const Redraws& redraws, const Redraw& redraw) {
  const Line& a = line(i);
  const double mass = layout_.mass(a);
  double spin = 0.0;
  if constexpr (!Impact::plain)
    if (impact_.spinning()) spin = redraws.spin(redraw, impact_.spin(i), mass, layout_.radius(a), epoch_.plus(now_));
  return give_velocity(i, redraws.velocity(redraw, flight_.velocity(a, now_), mass), spin);
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::scale_velocities(double factor) {
  rebase(now_);
  this->multiply_velocities(factor);
  replan();
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::leave(Continuation& continuation) const {
  continuation.now = now();
  continuation.totals = totals_;
  if constexpr (!World::plain) {
    continuation.wall_draws = world_.walls.draws();
    continuation.oscillations = world_.walls.oscillation_clocks(now_);
  } else {
    continuation.oscillations = {};  // no wall has vibrated: one that is to do so again begins anew
  }
  continuation.bonds.clear();
  if constexpr (!Impact::plain) {
    const auto& potential = impact_.potential();
    for (std::int32_t i = 0; i < count() && potential.present(); ++i)
      for (const PairStep& pair : potential.of(i))
        if (id(i) < id(pair.disk)) continuation.bonds.push_back({id(i), id(pair.disk), potential.middle(pair.step)});
    continuation.sort_bonds();
  }
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::take_over(const Continuation& continuation) {
  recorder_.begin_epoch(epoch_ = continuation.now);
  totals_.go_on_from(continuation.totals);
  if constexpr (!World::plain) {
    world_.walls.go_on_drawing(continuation.wall_draws);
    if (world_.walls.go_on_oscillating(continuation.oscillations)) predict_all(), start_queue();
  }
  if constexpr (!Impact::plain) {
    auto& potential = impact_.potential();
    bool changed = false;
    for (std::int32_t i = 0; i < count() && potential.present(); ++i)
      for (std::uint32_t n = 0; n < lists_.count(i); ++n) {
        const std::int32_t j = lists_.ids(i)[n];
        const Line &a = line(i), &b = line(j);
        if (i > j) continue;
        const std::int32_t step =
            potential.step_at(flight_.separation(a, b, now_), layout_.contact_distance(a, b), continuation.middle(id(i), id(j)));
        if (step == potential.step_of(i, j)) continue;
        potential.move(i, j, step);
        changed = true;
      }
    if (changed) predict_all(), start_queue();
  }
}

/// Archives a frame without its pointers, which are those of the engine that reads.
template <class Archive>
void serialize(Archive& archive, PredictionFrame& frame) {
  archive(frame.unit, frame.steps, frame.sigma, frame.half_width, frame.edge_step, frame.scale, frame.expansion, frame.reach);
  archive(frame.sliding.displacement, frame.sliding.speed, frame.sliding.inner);
}

/// The archive of an engine, for checkpoints (core/archive.hpp), holds all that decides how it goes on. What the scene says by
/// itself is not part of it: an engine is made for the scene first, with any start, and then read into.
template <class Impact, class Layout, class World>
template <class Archive>
void LoopState<Impact, Layout, World>::serialize(Archive& archive) {
  archive(flight_, frame_, impact_, world_);
  archive(lines_, plans_, ids_, sizes_, lists_, queue_);
  archive(epoch_, now_, epoch_length_, stamp_, stall_, common_motion_, last_collision_, totals_);
  archive(mean_speed_, limits_, boundaries_, tuning_, pacing_);
  if constexpr (Archive::is_loading::value) {
    recorder_.begin_epoch(epoch_);
    point_at_potential();
    frame_.sliding.heights = flight_.heights();
  }
}

}  // namespace carom
