#pragma once
// Plans after a piston has moved, ties between partners, and the look ahead at what the next events will need.

#include "engine/event_loop.hpp"

#include <algorithm>

namespace carom {

template <class Impact, class Layout, class World>
void EventLoop<Impact, Layout, World>::plan_edges_anew() {
  for (std::int32_t i = 0; i < count(); ++i) {
    const double before = plans_.time(i);
    const std::int32_t other_before = plans_.other(i);
    plan_edge(i, plans_[i].edge == neighbourhood_edge ? plans_[i].edge_time : predicted(i, surroundings(i)).edge_time);
    if (plans_.time(i) != before || plans_.other(i) != other_before) schedule(i);
  }
}

template <class Impact, class Layout, class World>
std::int32_t LoopState<Impact, Layout, World>::lowest_of_tied(std::int32_t i, const Prediction& ahead) const {
  std::int32_t lowest = ahead.partner;
  const auto consider = [&](std::int32_t j) {
    if (id(j) < id(lowest) && predicted_against(i, j).pair_time == ahead.pair_time) lowest = j;
  };
  for (std::uint32_t k = 0; k < lists_.count(i); ++k) consider(lists_.ids(i)[k]);
  return lowest;
}

template <class Impact, class Layout, class World>
Prediction LoopState<Impact, Layout, World>::predicted_against(std::int32_t i, std::int32_t j) const {
  const std::int32_t alone[8] = {j, i, i, i, i, i, i, i};
  return predicted(i, {{lists_.centre(i).x, lists_.centre(i).y}, alone, 1});
}

template <class Impact, class Layout, class World>
void LoopState<Impact, Layout, World>::prefetch_calendar(std::int64_t span) const {
  if (prefetcher_.looks_ahead())
    prefetcher_.calendar(data(), span, [this](std::int32_t i, double when) {
      return flight_.neighbourhood_centre(i, line(i), when, lists_.half_width());
    });
}

}  // namespace carom
