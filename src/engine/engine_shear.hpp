#pragma once
// The engine in a box whose images above slide past those below (effects/shear.hpp).
//
// Coordinates wrap, so a line does not determine in which of the boxes, one above the other, its disk is, and with which of their
// velocities. The centre of the disk's neighbourhood does: it is in the box of the disk, and a disk that comes to an edge gets a
// neighbourhood on the other side. For a pair, the centres determine how many boxes above the one the other is met, hence by how
// much that image is displaced and how fast it slides. Disks far from the edges are not concerned. In every epoch images slide on
// from where they have come to, and neighbourhoods near an edge are neighbours of all that will slide past them in it.

#include "core/sliding_separation.hpp"
#include "engine/event_loop.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace carom {

template <class Impact, class Layout, class World>
void LoopState<Impact, Layout, World>::update_shear() {
  const double length = flight_.length(0), displacement = world_.lees_edwards.displacement(0.0);
  frame_.sliding.displacement = flight_.axis(0).steps_of(displacement < length / 2.0 ? displacement : displacement - length);
  frame_.sliding.speed = world_.lees_edwards.speed();
  frame_.sliding.heights = flight_.heights();
  lists_.slide(frame_.sliding.displacement, epoch_length_ < never ? world_.lees_edwards.speed() * epoch_length_ : 0.0);
  frame_.sliding.inner = lists_.inner();
}

template <class Impact, class Layout, class World>
void EventLoop<Impact, Layout, World>::follow_shear() {
  if (!world_.sheared()) return;
  update_shear();
  for (std::int32_t i = 0; i < count(); ++i)
    if (std::abs(std::int64_t{flight_.height(i)}) >= lists_.inner()) set_plan(i, predicted(i, surroundings(i)));
}

/// Divides what neighbourhoods leave of the half box, within which nearest images are right, between lines and the slide of
/// images.
template <class Impact, class Layout, class World>
void LoopState<Impact, Layout, World>::leave_room_for_shear(const std::vector<NeighbourhoodCentre>& centres) {
  for (std::int32_t i = 0; i < count(); ++i) flight_.height(i) = centres[static_cast<std::size_t>(i)].y;
  limits_.shear_displacement = limits_.longest_line[0];
  limits_.longest_line[0] /= 2.0;
  frame_.sliding.inner = lists_.inner();
}

template <class Impact, class Layout, class World>
void EventLoop<Impact, Layout, World>::meet_across_sheared_edge(std::int32_t i, Vec2<double>& va, std::int32_t j,
                                                                Vec2<double>& vb, std::int32_t above) {
  const Line &a = line(i), &b = line(j);
  const double image_speed = above * frame_.sliding.speed;
  vb[0] += image_speed;
  const double before = vb[0];
  exchange(approach(frame_, a, b, above, now_).r, i, va, j, vb);
  totals_.shear_energy.add(layout_.mass(b) * (before - vb[0]) * image_speed);
  vb[0] -= image_speed;
}

template <class Impact, class Layout, class World>
void EventLoop<Impact, Layout, World>::cross_sheared_edge(std::int32_t i, std::int32_t up) {
  Line& a = line(i);
  const double before = a.v[0];
  flight_.cross_sheared_edge(i, a, up, frame_.sliding.displacement, world_.lees_edwards.whole_lengths(now_));
  a.v[0] -= up * world_.lees_edwards.speed();
  totals_.shear_energy.add(layout_.mass(a) * (a.v[0] * a.v[0] - before * before) / 2.0);
  leave_neighbourhood(i);
  if (const Vec2<double> v(a.v[0], a.v[1]); limits_.exceeded_by(v)) begin_epoch_early(i, v, i, v);
}

}  // namespace carom
