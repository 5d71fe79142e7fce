#pragma once
// Plans where there is more than hard walls, ties between partners, and the look ahead at what the next events will need.

#include "engine/engine.hpp"

#include <algorithm>

namespace carom {

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::plan_world(std::int32_t i) {
  if (world_.sliding.present()) return plan_sliding_edge(i);
  const Line& a = line(i);
  Plan& mine = plan(i);
  const double radius = layout_.radius(a) * world_.scale(now_), growth = layout_.radius(a) * world_.growth();
  const auto consider = [&](double time, std::int32_t what) {
    if (time < mine.edge_time || (time == mine.edge_time && mine.edge == neighbourhood)) mine.edge_time = time, mine.edge = what;
  };
  for (int axis = 0; axis < 2; ++axis) {
    if (axes_[axis].periodic) continue;
    const double v = a.v[axis] + world_.g()[axis] * now_, g = world_.g()[axis];
    for (const int sign : {-1, 1}) {
      const Wall wall = wall_of(axis, sign > 0);
      if (world_.walls.recedes(wall, sign * v, sign * g, growth, now_)) continue;
      consider(now_ + world_.walls.contact(wall, room(a, axis, sign, radius), sign * v, sign * g, growth, now_), wall);
    }
  }
  if (!world_.obstacles.empty()) {
    // Disks may fall far while they stay in their neighbourhoods, but where they fall all is planned anew with every epoch.
    const double until = world_.falls() ? std::min(mine.edge_time, epoch_length_) : mine.edge_time;
    const auto meeting = world_.obstacles.next(place(a), velocity(a), world_.g(), radius, growth, until - now_);
    if (meeting.obstacle >= 0) consider(now_ + meeting.time, first_obstacle - meeting.obstacle);
  }
  yield_to_lower_partner(i);
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::plan_edges_anew() {
  for (std::int32_t i = 0; i < count(); ++i) {
    const double before = time(i);
    const std::int32_t other_before = other(i);
    plan_edge(i, plan(i).edge == neighbourhood ? plan(i).edge_time : predicted(i, surroundings(i)).edge_time);
    if (time(i) != before || other(i) != other_before) schedule(i);
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
  for (const std::int32_t i : queue_.calendar().ids_of(span + 5)) prefetch_early(&plan(i));
  for (const std::int32_t i : queue_.calendar().ids_of(span + 4)) {
    const auto prefetch_disk = [this](std::int32_t k) {
      prefetch_early(&line(k));
      lists_.prefetch_list_early(k);
    };
    prefetch_disk(i);
    if (plan(i).pair_time < plan(i).edge_time) {
      prefetch_early(&plan(plan(i).partner));
      prefetch_disk(plan(i).partner);
    }
  }
  for (const std::int32_t i : queue_.calendar().ids_of(span + 2)) {
    if (queue_.calendar().span_of(time(i)) != span + 2) continue;
    const auto prefetch_neighbours = [this](std::int32_t k) {
      const std::int32_t* ids = lists_.ids(k);
      for (int n = 0; n < 8; ++n)
        prefetch_early(&line(ids[n]));  // so many there always are, and no end of a loop to be guessed wrong
      for (std::uint32_t n = 8, all = std::min(lists_.count(k), 16U); n < all; ++n) prefetch_early(&line(ids[n]));
    };
    if (plan(i).pair_time < plan(i).edge_time) {
      prefetch_neighbours(i), prefetch_neighbours(plan(i).partner);
    } else {
      prefetch_early(&ids_[static_cast<std::size_t>(i)]);  // decides ties, which times in steps often are
      lists_.prefetch_cells(i, neighbourhood_around(i, plan(i).edge_time));
    }
  }
}

}  // namespace carom
