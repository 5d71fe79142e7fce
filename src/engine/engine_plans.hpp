#pragma once
// Plans where there is more than hard walls, ties between partners, and the look ahead at what the next events will need.

#include "engine/engine.hpp"

#include <algorithm>

namespace carom {

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::plan_world(std::int32_t i) {
  if (world_.sheared()) return plan_sheared_edge(i);
  const Line& a = line(i);
  Plan& mine = plans_[i];
  const double radius = layout_.radius(a) * world_.scale(now_), expansion = layout_.radius(a) * world_.expansion();
  for (int axis = 0; axis < 2; ++axis) {
    if (flight_.axis(axis).periodic) continue;
    const double v = a.v[axis] + world_.g()[axis] * now_, g = world_.g()[axis];
    for (const int sign : {-1, 1}) {
      const Wall wall = wall_of(axis, sign > 0);
      if (world_.walls.recedes(wall, sign * v, sign * g, expansion, now_)) continue;
      mine.consider_edge(
          now_ + world_.walls.contact(wall, flight_.room(a, axis, sign, radius, now_), sign * v, sign * g, expansion, now_),
          wall);
    }
  }
  if (!world_.obstacles.empty()) {
    // Disks may fall far while they stay in their neighbourhoods, but where they fall all is planned anew with every epoch.
    const double until = world_.falls() ? std::min(mine.edge_time, epoch_length_) : mine.edge_time;
    const auto meeting =
        world_.obstacles.next(flight_.place(a, now_), flight_.velocity(a, now_), world_.g(), radius, expansion, until - now_);
    if (meeting.obstacle >= 0) mine.consider_edge(now_ + meeting.time, first_obstacle - meeting.obstacle);
  }
  resolve_wall_pair_tie(i);
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::plan_edges_anew() {
  for (std::int32_t i = 0; i < count(); ++i) {
    const double before = plans_.time(i);
    const std::int32_t other_before = plans_.other(i);
    plan_edge(i, plans_[i].edge == neighbourhood_edge ? plans_[i].edge_time : predicted(i, surroundings(i)).edge_time);
    if (plans_.time(i) != before || plans_.other(i) != other_before) schedule(i);
  }
}

template <class Impact, class Layout, class World>
std::int32_t Engine<Impact, Layout, World>::lowest_of_tied(std::int32_t i, const Prediction& ahead) const {
  std::int32_t lowest = ahead.partner;
  const auto consider = [&](std::int32_t j) {
    if (id(j) < id(lowest) && predicted_against(i, j).pair_time == ahead.pair_time) lowest = j;
  };
  for (std::uint32_t k = 0; k < lists_.count(i); ++k) consider(lists_.ids(i)[k]);
  return lowest;
}

template <class Impact, class Layout, class World>
Prediction Engine<Impact, Layout, World>::predicted_against(std::int32_t i, std::int32_t j) const {
  const std::int32_t alone[8] = {j, i, i, i, i, i, i, i};
  return predicted(i, {{lists_.centre(i).x, lists_.centre(i).y}, alone, 1});
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::prefetch_calendar(std::int64_t span) const {
  if (prefetcher_.looks_ahead())
    prefetcher_.calendar(data(), span, [this](std::int32_t i, double when) { return neighbourhood_around(i, when); });
}

}  // namespace carom
