#pragma once
// The engine in a box whose images above slide past those below (effects/shear.hpp).
//
// Coordinates wrap, so a line does not tell in which of the boxes, one above the other, its disk is, and with which of their
// velocities. The centre of the disk's neighbourhood does: it is in the box of the disk, and a disk that comes to an edge gets a
// neighbourhood on the other side. For a pair, the centres tell how many boxes above the one the other is met, hence by how much
// that image is displaced and how fast it slides. Disks far from the edges know nothing of all this. In every epoch images slide
// on from where they have come to, and neighbourhoods near an edge are neighbours of all that will slide past them in it.

#include "engine/engine.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace carom {

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::note_heights(const State& start) {
  heights_.resize(lines_.size());
  for (std::int32_t i = 0; i < count(); ++i) {
    Line& a = line(i);
    const bool rounded_up = a.x[1] == INT64_MIN && start.positions(1, static_cast<Eigen::Index>(id(i))) > axes_[1].lower;
    if (rounded_up) a.x[1] = INT64_MAX, images_.step(i, 1, -1);
    height(i) = static_cast<std::int32_t>(a.x[1] >> 32);
  }
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::note_slide() {
  const double length = axes_[0].upper - axes_[0].lower, displacement = world_.sliding.displacement(0.0);
  frame_.sliding.displacement = axes_[0].steps_of(displacement < length / 2.0 ? displacement : displacement - length);
  frame_.sliding.speed = world_.sliding.speed();
  frame_.sliding.heights = heights_.data();
  lists_.slide(frame_.sliding.displacement, epoch_length_ < never ? world_.sliding.speed() * epoch_length_ : 0.0);
  frame_.sliding.inner = lists_.inner();
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::slide_images() {
  if (!world_.sliding.present()) return;
  note_slide();
  for (std::int32_t i = 0; i < count(); ++i)
    if (std::abs(std::int64_t{height(i)}) >= lists_.inner()) plan_ahead(i, predicted(i, surroundings(i)));
}

/// Of the half box within which nearest images are right, lines and the slide of images share what neighbourhoods leave.
template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::leave_room_to_slide(const std::vector<NeighbourhoodCentre>& centres) {
  for (std::int32_t i = 0; i < count(); ++i) height(i) = centres[static_cast<std::size_t>(i)].y;
  way_ = travel_[0];
  travel_[0] /= 2.0;
  const double clear = (axes_[1].upper - axes_[1].lower) / 2.0 - frame_.half_width * (1.0 + 1.0 / 16.0);
  clear_[1] = static_cast<std::int64_t>(std::max(clear, 0.0) / (axes_[1].unit * 0x1p32));
  frame_.sliding.inner = lists_.inner();
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::plan_sliding_edge(std::int32_t i) {
  const Line& a = line(i);
  Plan& mine = plans_[i];
  const double v = a.v[1];
  if (v == 0.0) return;
  const double sign = v > 0.0 ? 1.0 : -1.0;
  const double gap = axes_[1].unit * 0x1p32 * (0x1p31 - sign * height(i)) - sign * offset(1, a, height(i));
  const double time = gap > 0.0 ? now_ + gap / std::abs(v) : now_;
  if (time <= mine.edge_time) mine.edge_time = time, mine.edge = wall_of(1, v > 0.0);
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::meet_across_edge(std::int32_t i, Vec2<double>& va, std::int32_t j, Vec2<double>& vb,
                                                     std::int32_t above) {
  const Line &a = line(i), &b = line(j);
  const double image_speed = above * frame_.sliding.speed;
  vb[0] += image_speed;
  const double before = vb[0];
  exchange(approach(frame_, a, b, above, now_).r, i, va, j, vb);
  totals_.shear_energy.add(layout_.mass(b) * (before - vb[0]) * image_speed);
  vb[0] -= image_speed;
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::cross_sliding_edge(std::int32_t i, std::int32_t up) {
  // The image one box lower has its line where this one has it at the epoch, but for the displacement. Its coordinate y wraps.
  Line& a = line(i);
  const double before = a.v[0];
  const std::int64_t displacement = frame_.sliding.displacement;
  if (up > 0 ? __builtin_sub_overflow(a.x[0], displacement, &a.x[0]) : __builtin_add_overflow(a.x[0], displacement, &a.x[0]))
    images_.step(i, 0, (displacement < 0) == (up > 0) ? 1 : -1);
  // Coordinates are displaced by the nearest number of steps, disks to the left by what is left without whole box lengths.
  images_.set(i, 0, images_.of(i, 0) + up * (world_.sliding.whole_lengths(now_) - (displacement < 0 ? 1 : 0)));
  a.v[0] -= up * world_.sliding.speed();
  totals_.shear_energy.add(layout_.mass(a) * (a.v[0] * a.v[0] - before * before) / 2.0);
  height(i) = up > 0 ? INT32_MIN : INT32_MAX;
  leave_neighbourhood(i);
  if (const Vec2<double> v(a.v[0], a.v[1]); outruns_epoch(v)) begin_epoch_between(i, v, i, v);
}

template <class Impact, class Layout, class World>
double Engine<Impact, Layout, World>::steps_up(std::int32_t i, double when) const {
  const Line& a = line(i);
  const auto centre = static_cast<std::int64_t>(static_cast<std::uint64_t>(height(i)) << 32);
  return static_cast<double>(centre) + (static_cast<double>(wrapped_difference(a.x[1], centre)) + a.v[1] * when * axes_[1].steps);
}

template <class Impact, class Layout, class World>
std::int32_t Engine<Impact, Layout, World>::neighbourhood_height(std::int32_t i, double when, double ahead) const {
  const double steps = steps_up(i, when) + line(i).v[1] * ahead * axes_[1].steps;
  return static_cast<std::int32_t>(std::clamp(std::rint(steps * 0x1p-32), -0x1p31, 0x1p31 - 1.0));
}

template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::keep_in_box(std::int32_t i, std::int64_t& y, std::int64_t& image) const {
  const auto centre = static_cast<std::int64_t>(static_cast<std::uint64_t>(height(i)) << 32);
  const std::int64_t off = wrapped_difference(y, centre);
  if (std::int64_t inside; !__builtin_add_overflow(centre, off, &inside)) return;
  y = off > 0 ? INT64_MAX : INT64_MIN;
  image -= off > 0 ? 1 : -1;
}

}  // namespace carom
