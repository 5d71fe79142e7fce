#pragma once
// Lists of neighbours for disks of the size that they have, and how wide neighbourhoods are.

#include "engine/event_loop.hpp"

#include <cmath>

namespace carom {

/// Makes empty lists, for disks as large as they will be at the end of the epoch.
template <class Impact, class Layout, class World>
void LoopState<Impact, Layout, World>::make_lists() {
  sizes_.listed_scale = world_.scale(epoch_length_ < never ? epoch_length_ : 0.0);
  if (world_.expansion() > 0.0)
    sizes_.listed_scale *= 1.0 + 1.0 / 64.0;  // more makes lists longer, less has them made more often
  const double factor = sizes_.listed_scale * frame_.reach;
  sizes_.reach = sizes_.largest_contact * factor;
  std::vector<double> radius = sizes_.radius;
  for (double& one : radius) one *= factor * sizes_.contact_scale;
  lists_ = NeighbourLists(flight_.axis(0), flight_.axis(1), radius);
  sizes_.widest_neighbourhood = std::max(flight_.length(0), flight_.length(1));  // that neighbourhood holds the box
  for (int k = 0; k < 2; ++k)
    if (flight_.axis(k).periodic)
      sizes_.widest_neighbourhood = std::min(sizes_.widest_neighbourhood, (flight_.length(k) / 2.0 - sizes_.reach) / 6.0);
}

/// Makes new lists for disks that have grown, and new plans with them.
template <class Impact, class Layout, class World>
void EventLoop<Impact, Layout, World>::list_larger() {
  const double before = sizes_.suitable_half_width();
  make_lists();
  // Disks that have grown have less room, and need narrower neighbourhoods.
  rebuild(std::min(frame_.half_width * (sizes_.suitable_half_width() / before), sizes_.widest_neighbourhood));
  predict_all();
  tuning_.restart();
}

/// Whether disks will be larger at the end of the epoch than those that lists are for.
template <class Impact, class Layout, class World>
bool LoopState<Impact, Layout, World>::outgrow_lists() const {
  return world_.expansion() > 0.0 && !(epoch_length_ < never && world_.scale(epoch_length_) <= sizes_.listed_scale);
}

/// Chooses the half-width by what neighbourhoods have cost since the last choice.
template <class Impact, class Layout, class World>
void EventLoop<Impact, Layout, World>::tune_neighbourhoods(double elapsed) {
  const double half_width =
      tuning_.next(lists_.half_width(), sizes_.widest_neighbourhood, mean_speed_ * elapsed, sizes_.spacing, lists_.changes());
  if (half_width == lists_.half_width()) return;
  rebuild(half_width);
  predict_all();
}

/// Makes new neighbourhoods round all disks, and new lists. The plans must be made anew as well.
template <class Impact, class Layout, class World>
void LoopState<Impact, Layout, World>::rebuild(double half_width) {
  ++totals_.numerics.list_rebuilds;
  const std::vector<NeighbourhoodCentre> centres = new_centres();
  lists_.rebuild(half_width, centres);
  totals_.numerics.longest_neighbour_list = 0;
  for (std::int32_t i = 0; i < count(); ++i)
    totals_.numerics.longest_neighbour_list = std::max<std::uint64_t>(totals_.numerics.longest_neighbour_list, lists_.count(i));
  set_half_width(half_width);
  if constexpr (!World::plain)
    if (world_.sheared()) leave_room_for_shear(centres);
}

/// The centres of new neighbourhoods, as far ahead of disks as those of the neighbourhoods before.
template <class Impact, class Layout, class World>
std::vector<NeighbourhoodCentre> LoopState<Impact, Layout, World>::new_centres() const {
  std::vector<NeighbourhoodCentre> centres(lines_.size());
  for (std::int32_t i = 0; i < count(); ++i)
    centres[static_cast<std::size_t>(i)] = flight_.neighbourhood_centre(i, line(i), now_, lists_.half_width());
  return centres;
}

/// Adapts to neighbourhoods of this half-width what depends on it beside the lists.
template <class Impact, class Layout, class World>
void LoopState<Impact, Layout, World>::set_half_width(double half_width) {
  frame_.half_width = half_width;
  boundaries_.set_neighbourhoods(half_width, sizes_.largest_contact);
  // Nearest images are right as long as a pair that may meet is less than half a box apart, now and along its lines back
  // to the epoch. What the neighbourhoods leave of that belongs to the two lines.
  for (int k = 0; k < 2; ++k) {
    const double length = flight_.length(k);
    limits_.longest_line[k] = flight_.axis(k).periodic ? (length / 2.0 - sizes_.reach - 4.0 * half_width) / 2.0
                                                       : length / 2.0 + free_path * sizes_.spacing;
  }
}

}  // namespace carom
