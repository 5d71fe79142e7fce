#pragma once
// Invariants of the fast engine: no overlap; each disk inside its neighbourhood; lists symmetric and complete; no collision
// overlooked; the queue consistent with the plans.

#include "core/sliding_separation.hpp"
#include "engine/engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace carom {

template <class Impact, class Layout, class World>
std::vector<std::string> Engine<Impact, Layout, World>::check_invariants(double tolerated_overlap) const {
  std::vector<std::string> faults;
  const double slack = 1e-9 * lists_.half_width();
  for (std::int32_t i = 0; i < count(); ++i) {
    const Line& a = line(i);
    if (!std::isfinite(a.v[0]) || !std::isfinite(a.v[1]))
      faults.push_back(fmt::format("disk {}: its velocity is not finite", id(i)));
    if (plans_.time(i) < now_ * (1.0 - 1e-12)) faults.push_back(fmt::format("disk {}: its next event lies in the past", id(i)));
    if (plans_.time(i) < epoch_length_ && !queue_.holds(plans_, i))
      faults.push_back(fmt::format("disk {}: its event is not in the queue", id(i)));
    const NeighbourhoodCentre centre = lists_.centre(i);
    if constexpr (!World::plain)
      if (world_.sheared() &&
          (flight_.height(i) != centre.y || std::abs(flight_.steps_up(i, line(i), now_)) > 0x1p63 * (1.0 + 1e-12)))
        faults.push_back(fmt::format("disk {}: outside the box of its neighbourhood", id(i)));
    double rounding = 0.0;
    if constexpr (!World::plain)  // obstacles, the rim of a circle and walls that have moved far are met at places that are
                                  // rounded
      rounding = 16.0 * epsilon<double> * flight_.place(a, now_).cwiseAbs().maxCoeff();
    for (int k = 0; k < 2; ++k) {
      const double off = flight_.offset(k, a, k == 0 ? centre.x : centre.y, now_);
      if (!(std::abs(off) <= lists_.half_width() + slack))
        faults.push_back(
            fmt::format("disk {}: outside its neighbourhood along axis {} by {}", id(i), k, std::abs(off) - lists_.half_width()));
      const double out = beyond_walls(i, k);
      if (out > tolerated_overlap * layout_.radius(a) * world_.scale(now_) + 1e-12 * flight_.length(k) + rounding)
        faults.push_back(fmt::format("disk {}: {} beyond a wall across axis {}", id(i), out, k));
    }
    if constexpr (!World::plain) {
      const auto [obstacle, depth, contact] = overlap_with_obstacles(i);
      // Obstacles are joined where their ends are within 1e-12 of the box.
      if (depth > tolerated_overlap * contact + 1e-12 * (contact + flight_.length(0) + flight_.length(1)) + rounding)
        faults.push_back(fmt::format("disk {}: overlaps obstacles.{} by {}", id(i), obstacle, depth));
    }
    for (std::uint32_t n = 0; n < lists_.count(i); ++n) check_pair(i, lists_.ids(i)[n], tolerated_overlap, faults);
  }
  if (count() > 2000) return faults;  // the rest compares all pairs
  for (std::int32_t i = 0; i < count(); ++i) {
    const std::int32_t* list = lists_.ids(i);
    for (std::int32_t j = 0; j < count(); ++j) {
      const bool listed = std::find(list, list + lists_.count(i), j) != list + lists_.count(i);
      if (listed != (i != j && lists_.near(i, j)))
        faults.push_back(
            fmt::format("disks {} and {}: {}", id(i), id(j), listed ? "listed though not near" : "near but not listed"));
      if (!listed && i < j) check_pair(i, j, tolerated_overlap, faults);
    }
  }
  return faults;
}

/// The distance by which disk i reaches beyond the walls across an axis; negative where it does not.
template <class Impact, class Layout, class World>
double Engine<Impact, Layout, World>::beyond_walls(std::int32_t i, int axis) const {
  if (flight_.axis(axis).periodic) return -never;
  const Line& a = line(i);
  if constexpr (!World::plain)
    if (world_.in_circle()) return world_.beyond_circle(flight_.place(a, now_), layout_.radius(a) * world_.scale(now_));
  double out = -never;
  for (const int sign : {-1, 1}) {
    double left = flight_.room(a, axis, sign, layout_.radius(a) * world_.scale(now_), now_);
    if constexpr (!World::plain) left += world_.walls.displacement(wall_of(axis, sign > 0), now_);
    out = std::max(out, -left);
  }
  return out;
}

/// The overlap of disk i with the obstacle that it overlaps deepest.
template <class Impact, class Layout, class World>
ObstacleOverlap<double> Engine<Impact, Layout, World>::overlap_with_obstacles(std::int32_t i) const {
  if constexpr (World::plain)
    return {};
  else
    return world_.overlap_with_obstacles(flight_.place(line(i), now_), layout_.radius(line(i)) * world_.scale(now_));
}

template <class Impact, class Layout, class World>
double Engine<Impact, Layout, World>::deepest_overlap() const {
  double deepest = 0.0;
  const auto consider = [&deepest](double depth) {
    if (depth <= touches_a_wall) deepest = std::max(deepest, depth);
  };
  for (std::int32_t i = 0; i < count(); ++i) {
    for (int axis = 0; axis < 2; ++axis) consider(beyond_walls(i, axis) / (layout_.radius(line(i)) * world_.scale(now_)));
    const auto at_obstacle = overlap_with_obstacles(i);
    consider(at_obstacle.depth / at_obstacle.contact);
  }
  for (std::int32_t i = 0; i < count(); ++i)
    for (std::uint32_t n = 0; n < lists_.count(i); ++n) {
      const std::int32_t j = lists_.ids(i)[n];
      const double sigma = contact_distance(i, j);
      deepest = std::max(deepest, (sigma - approach(frame_, line(i), line(j), flight_.boxes_above(i, j), now_).r.norm()) / sigma);
    }
  return deepest;
}

/// Checks that two disks do not overlap, and do not meet before one of them has an event planned.
template <class Impact, class Layout, class World>
void Engine<Impact, Layout, World>::check_pair(std::int32_t i, std::int32_t j, double tolerated_overlap,
                                               std::vector<std::string>& faults) const {
  const double sigma = contact_distance(i, j);
  const auto [r, v] = approach(frame_, line(i), line(j), flight_.boxes_above(i, j), now_);
  const double overlap = sigma - r.norm();
  // Separations are known to 4 u times the way since the epoch, u half an epsilon: docs/numerics.md.
  const double rounding = 4.0 * epsilon<double> * (limits_.longest_line[0] + limits_.longest_line[1]);
  if (overlap > (tolerated_overlap + 1e-12) * sigma + rounding)
    faults.push_back(fmt::format("disks {} and {} overlap by {}", id(i), id(j), overlap));
  const double meeting = predicted_against(i, j).pair_time;
  const double planned = std::min({plans_.time(i), plans_.time(j), epoch_length_});
  if (!(meeting < planned)) return;
  if (world_.expansion() > 0.0 || frame_.pair_steps != nullptr) return;  // how deep they would be is another question there
  // Times of close pairs are uncertain; how deep they would be in each other by then is not.
  const double nearest = std::clamp(-r.dot(v) / v.squaredNorm(), 0.0, planned - now_);
  const double depth = sigma - (r + nearest * v).norm();
  if (depth > 1e-12 * (sigma + limits_.longest_line[0] + limits_.longest_line[1]))
    faults.push_back(
        fmt::format("disks {} and {} would be {} deep in each other before either has an event planned", id(i), id(j), depth));
}

template <class Impact, class Layout, class World>
double Engine<Impact, Layout, World>::contact_distance(std::int32_t i, std::int32_t j) const {
  return layout_.contact_distance(line(i), line(j)) * world_.scale(now_);
}

}  // namespace carom
