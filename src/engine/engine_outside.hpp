#pragma once
// What the world outside sees of an engine, and what it does to it.

#include "engine/engine.hpp"

#include <cmath>

namespace carom {

template <class Impact, class Layout, class World>
State Engine<Impact, Layout, World>::state() const {
  State state;
  look_at_velocities(state);
  state.positions.resize(2, count());
  state.images.resize(2, count());
  state.remainders.resize(2, count());
  for (std::int32_t i = 0; i < count(); ++i) {
    const Line& a = line(i);
    const auto column = static_cast<Eigen::Index>(id(i));
    for (int k = 0; k < 2; ++k) {
      std::int64_t x;
      std::int64_t image = images_.of(i, k);
      const std::int64_t way = axes_[k].steps_of(a.v[k] * now_ + world_.fallen(k, now_));
      if (__builtin_add_overflow(coordinate(a, k), way, &x)) image += way < 0 ? -1 : 1;
      bool inside = false;
      if constexpr (!World::plain)
        if (k == 1 && world_.sliding.present()) keep_in_box(i, x, image), inside = true;
      double position = axes_[k].position(x);
      if (axes_[k].periodic && position < axes_[k].lower) position = axes_[k].lower;  // rounded an ulp below
      if (inside && position >= axes_[k].upper) position = std::nextafter(axes_[k].upper, axes_[k].lower);
      state.remainders(k, column) = axes_[k].remainder(x, position);
      if (axes_[k].periodic && position >= axes_[k].upper) position = axes_[k].lower, ++image;
      state.positions(k, column) = position;
      state.images(k, column) = image;
    }
  }
  if constexpr (!World::plain)
    if (world_.sliding.present()) state.shear_displacement = world_.sliding.reduced(now_);
  if constexpr (!Impact::plain) {
    state.bonds = impact_.wells().pairs();
    if (impact_.spinning()) state.spins.resize(count());
    for (std::int32_t i = 0; i < count() && impact_.spinning(); ++i) state.spins[id(i)] = impact_.spin(i);
  }
  return state;
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::look_at_velocities(State& state) const {
  state.time = now().high;
  state.velocities.resize(2, count());
  for (std::int32_t i = 0; i < count(); ++i) {
    const Vec2<double> v = velocity(line(i));
    state.velocities.col(id(i)) << v[0], v[1];
  }
  state.scale = world_.scale(now_);
  if constexpr (!World::plain) state.walls = world_.walls.states(now_);
}

template <class Impact, class Layout, class World>
std::size_t Engine<Impact, Layout, World>::bytes() const {
  return lines_.capacity() * sizeof(Line) + plans_.bytes() + ids_.capacity() * sizeof(std::int32_t) + images_.bytes() +
         lists_.bytes() + queue_.bytes() + impact_.bytes() + world_.bytes() + radius_.capacity() * sizeof(double) +
         rests_.capacity() * sizeof(rests_[0]) + (places_.capacity() + heights_.capacity()) * sizeof(std::int32_t);
}

template <class Impact, class Layout, class World>
double Engine<Impact, Layout, World>::set_velocity(std::int32_t disk, const Eigen::Vector2d& v, double spin) {
  if (places_.empty()) {
    places_.resize(lines_.size());
    for (std::int32_t i = 0; i < count(); ++i) places_[static_cast<std::size_t>(id(i))] = i;
  }
  const std::int32_t i = places_[static_cast<std::size_t>(disk)];
  const double mass = layout_.mass(line(i));
  Vec2<double> to = v;
  if constexpr (!World::plain)
    if (world_.sliding.present()) to[0] += world_.sliding.flow(middle_[1] + axes_[1].unit * steps_up(i, now_));
  double gained = mass * (to.squaredNorm() - velocity(line(i)).squaredNorm()) / 2.0;
  if constexpr (!Impact::plain)
    if (impact_.spinning()) {
      const double radius = layout_.radius(line(i)) * world_.scale(now_);
      gained += mass * radius * radius * (spin * spin - impact_.spin(i) * impact_.spin(i)) / 4.0;
      impact_.spin(i) = spin;
    }
  turn(i, to);
  return gained;
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::scale_velocities(double factor) {
  rebase(now_);
  for (Line& a : lines_)
    for (int k = 0; k < 2; ++k) a.v[k] *= factor;
  if constexpr (!Impact::plain)
    for (std::int32_t i = 0; i < count() && impact_.spinning(); ++i) impact_.spin(i) *= factor;
  go_on();
}

}  // namespace carom
