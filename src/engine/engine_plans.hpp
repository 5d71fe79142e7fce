#pragma once
// Plans where there is more than hard walls, ties between partners, and the look ahead at what the next events will need.

#include "engine/engine.hpp"

#include <algorithm>

namespace carom {

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::plan_world(std::int32_t i) {
  if (world_.sheared()) return plan_sliding_edge(i);
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

/// Fetches what the events of the spans to come will need, in three stages: plans; lines and lists; what the lists name.
template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::look_ahead(std::int64_t span) const {
  if (!fetching_) return;
  queue_.calendar().prefetch_span(span + 7);
  for (const std::int32_t i : queue_.calendar().ids_of(span + 5)) prefetch_early(&plans_[i]);
  for (const std::int32_t i : queue_.calendar().ids_of(span + 4)) {
    const auto prefetch_disk = [this](std::int32_t k) {
      prefetch_early(&line(k));
      lists_.prefetch_list_early(k);
    };
    prefetch_disk(i);
    if (plans_[i].pair_time < plans_[i].edge_time) {
      prefetch_early(&plans_[plans_[i].partner]);
      prefetch_disk(plans_[i].partner);
    }
  }
  for (const std::int32_t i : queue_.calendar().ids_of(span + 2)) {
    if (queue_.calendar().span_of(plans_.time(i)) != span + 2) continue;
    const auto prefetch_neighbours = [this](std::int32_t k) {
      const std::int32_t* ids = lists_.ids(k);
      for (int n = 0; n < 8; ++n)
        prefetch_early(&line(ids[n]));  // so many there always are, and no end of a loop to be guessed wrong
      for (std::uint32_t n = 8, all = std::min(lists_.count(k), 16U); n < all; ++n) prefetch_early(&line(ids[n]));
    };
    if (plans_[i].pair_time < plans_[i].edge_time) {
      prefetch_neighbours(i), prefetch_neighbours(plans_[i].partner);
    } else {
      prefetch_early(&ids_[static_cast<std::size_t>(i)]);  // decides ties, which times in steps often are
      lists_.prefetch_cells(i, neighbourhood_around(i, plans_[i].edge_time));
    }
  }
}

}  // namespace carom
