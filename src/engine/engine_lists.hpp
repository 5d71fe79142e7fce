#pragma once
// Lists of neighbours for disks of the size that they have, and how wide neighbourhoods are.

#include "engine/engine.hpp"
#include "engine/engine_begin.hpp"

#include <cmath>

namespace carom {

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::make_lists() {
  listed_scale_ = world_.scale(epoch_length_ < never ? epoch_length_ : 0.0);
  if (world_.expansion() > 0.0) listed_scale_ *= 1.0 + list_margin;
  const double factor = listed_scale_ * frame_.well;
  reach_ = largest_contact_ * factor;
  std::vector<double> radius = radius_;
  for (double& one : radius) one *= factor;
  lists_ = NeighbourLists(flight_.axis(0), flight_.axis(1), radius);
  widest_ = std::max(flight_.length(0), flight_.length(1));  // that neighbourhood holds the box
  for (int k = 0; k < 2; ++k)
    if (flight_.axis(k).periodic) widest_ = std::min(widest_, (flight_.length(k) / 2.0 - reach_) / 6.0);
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::list_larger() {
  const double before = suitable_half_width();
  make_lists();
  // Disks that have grown have less room, and want narrower neighbourhoods.
  rebuild(std::min(frame_.half_width * (suitable_half_width() / before), widest_));
  predict_all();
  settling_ = true;
  travelled_ = 0.0;
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::tune_neighbourhoods(double elapsed) {
  travelled_ += mean_speed_ * elapsed;
  const std::uint64_t left = totals_.other - left_;
  if (settling_) {  // after all neighbourhoods were made at once, nobody leaves for a while
    if (travelled_ < 4.0 * lists_.half_width()) return;
    settling_ = false;
  } else {
    if (travelled_ < 4.0 * spacing_ || left + looks_ < 4000) return;
    const double work = HalfWidthSearch::work(left, lists_.changes() - changed_, looks_) / travelled_;
    const double half_width = std::min(tuner_.next(lists_.half_width(), work), widest_);
    settling_ = half_width != lists_.half_width();
    if (settling_) {
      rebuild(half_width);
      predict_all();
    }
  }
  travelled_ = 0.0;
  left_ = totals_.other;
  changed_ = lists_.changes();
  looks_ = 0;
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::rebuild(double half_width) {
  frame_.half_width = half_width;
  ++totals_.numerics.lists_made;
  std::vector<NeighbourhoodCentre> centres(lines_.size());
  for (std::int32_t i = 0; i < count(); ++i) centres[static_cast<std::size_t>(i)] = neighbourhood_around(i, now_);
  lists_.rebuild(half_width, centres);
  totals_.numerics.longest_list = 0;
  for (std::int32_t i = 0; i < count(); ++i)
    totals_.numerics.longest_list = std::max<std::uint64_t>(totals_.numerics.longest_list, lists_.count(i));

  // Nearest images are right as long as a pair that may meet is less than half a box apart, now and along its lines back
  // to the epoch. What the neighbourhoods leave of that belongs to the two lines.
  for (int k = 0; k < 2; ++k) {
    const double length = flight_.length(k);
    // A sixteenth of the neighbourhood is far more than any rounding of the time at which it is left.
    const double clear = world_.still() ? length / 2.0 - largest_contact_ - half_width * (1.0 + 1.0 / 16.0) : 0.0;
    clear_[k] =
        flight_.axis(k).periodic ? INT64_MAX : static_cast<std::int64_t>(std::max(clear, 0.0) / (flight_.axis(k).unit * 0x1p32));
    travel_[k] =
        flight_.axis(k).periodic ? (length / 2.0 - reach_ - 4.0 * half_width) / 2.0 : length / 2.0 + free_path * spacing_;
  }
  if constexpr (!World::plain)
    if (world_.sheared()) leave_room_to_slide(centres);
}

}  // namespace carom
