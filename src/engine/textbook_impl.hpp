#pragma once
// The whole textbook engine, what a file includes that makes one: its beginning, its state seen from outside and the check of its
// plan are here, the loop is in textbook.hpp.

#include "engine/textbook.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace carom {

template <class Real>
TextbookEngine<Real>::TextbookEngine(const Box& box, const Disks& disks, const State& start, const Effects& effects,
                                     std::uint64_t seed)
    : box_(box),
      edges_(box, effects, start.shear_displacement),
      falling_(effects.gravity),
      walls_(box, effects.walls, seed),
      obstacles_(box, effects.obstacles),
      impact_(effects, disks.count()),
      scale_(Real(start.scale)),
      growth_(effects.growth ? Real(effects.growth->rate) : Real(0)),
      grid_(edges_.domain(), Real(1), 0),
      records_(disks.count()),
      plans_(disks.count()),
      images_(Images::Zero(2, static_cast<Eigen::Index>(disks.count()))),
      box_size_(box.lengths()[0] * std::sqrt(box.lengths()[1] / box.lengths()[0])),
      largest_radius_(disks.count() == 0 ? 0.5 : *std::max_element(disks.radius.begin(), disks.radius.end())),
      stall_(effects, disks.count()),
      common_motion_(box, effects) {
  for (std::int32_t i = 0; i < count(); ++i) {
    record(i).r = start.positions.col(i).template cast<Real>();
    record(i).v = start.velocities.col(i).template cast<Real>();
    record(i).radius = Real(disks.radius[static_cast<std::size_t>(i)]);
    record(i).mass = Real(disks.mass[static_cast<std::size_t>(i)]);
    if (start.images.cols() > i) images_.col(i) = start.images.col(i);
    if (impact_.spinning() && start.spins.size() > i) impact_.spin(i) = Real(start.spins[i]);
  }
  walls_.start_from(start.walls);
  suit_grid();
  grid_.clear();
  for (std::int32_t i = 0; i < count(); ++i) grid_.insert(i, record(i).r);
  find_wells();
  if (common_motion_.present()) common_motion_.begin(records_, [](const Record& a) { return momentum(a); });
  begin_epoch(Real(0));
}

/// Who begins inside whose well.
template <class Real>
void TextbookEngine<Real>::find_wells() {
  SquareWells<Real>& wells = impact_.wells();
  if (!wells.present()) return;
  for (std::int32_t i = 0; i < count(); ++i)
    grid_.for_neighbours(i, [&](std::int32_t j, const Winding& shift) {
      const Record &a = record(i), &b = record(j);
      if (i < j && wells.begins_inside(separation(a, b, 0, shift), a.radius + b.radius)) wells.enter(i, j);
    });
}

template <class Real>
void TextbookEngine<Real>::leave_bonds(Continuation& continuation) const {
  continuation.bonds.clear();
  for (std::int32_t i = 0; i < count() && impact_.wells().present(); ++i)
    for (const std::int32_t j : impact_.wells().of(i))
      if (i < j) continuation.bonds.emplace_back(i, j);
  std::sort(continuation.bonds.begin(), continuation.bonds.end());
}

template <class Real>
void TextbookEngine<Real>::take_over_bonds(const Continuation& continuation) {
  SquareWells<Real>& wells = impact_.wells();
  if (!wells.present()) return;
  bool changed = false;
  for (std::int32_t i = 0; i < count(); ++i)
    grid_.for_neighbours(i, [&](std::int32_t j, const Winding& shift) {
      const Record &a = record(i), &b = record(j);
      if (i > j || !wells.is_edge(separation(a, b, 0, shift), a.radius + b.radius)) return;
      const bool bound = continuation.bound(i, j);
      if (bound == wells.inside(i, j)) return;
      bound ? wells.enter(i, j) : wells.leave(i, j);
      changed = true;
    });
  if (!changed) return;
  for (std::int32_t i = 0; i < count(); ++i) make_plan(i);
  fill_queue();
}

template <class Real>
void TextbookEngine<Real>::suit_grid() {
  if (edges_.sheared()) {
    if (grid_.disks() != records_.size()) grid_ = CellGrid<Real>(edges_.domain(), 2 * Real(largest_radius_), records_.size());
    const auto [from, to] = edges_.slide(epoch_length_ < infinity<Real> ? epoch_length_ : 0);
    grid_.slide(from, to);
    return;
  }
  const bool same = growth_ == 0 && !walls_.any_moves() && grid_.disks() == records_.size();
  if (same) return;
  Box now = box_;
  for (const Wall wall : {wall_left, wall_right, wall_bottom, wall_top}) {
    if (now.periodic(axis_of(wall))) continue;
    const double displacement = static_cast<double>(walls_.displacement(wall, 0));
    (is_upper(wall) ? now.upper : now.lower)[axis_of(wall)] += is_upper(wall) ? displacement : -displacement;
  }
  for (int axis = 0; axis < 2; ++axis)  // walls may have closed in upon each other: a grid needs some width
    now.upper[axis] = std::max(now.upper[axis], now.lower[axis] + largest_radius_);
  const Real scale = growth_ > 0 && epoch_length_ < infinity<Real> ? scale_ + growth_ * epoch_length_ : scale_;
  grid_ = CellGrid<Real>(Domain<Real>(now), 2 * Real(largest_radius_) * scale * impact_.wells().reach(), records_.size());
}

template <class Real>
void TextbookEngine<Real>::state(State& state) const {
  state.time = now().high;
  state.positions.resize(2, count());
  state.velocities.resize(2, count());
  state.images.resize(2, count());
  constexpr bool wide = std::numeric_limits<Real>::digits > std::numeric_limits<double>::digits;
  state.remainders.resize(2, wide ? count() : 0);
  for (std::int32_t i = 0; i < count(); ++i) {
    Vec2<Real> r = position(record(i), now_);
    state.images.col(i) = images_.col(i) + edges_.domain().wrap(r);
    state.positions.col(i) = r.template cast<double>();
    for (int a = 0; a < 2; ++a) {  // rounding to double may reach the upper edge, which is the next box's lower one
      if (!edges_.domain().periodic[a] || state.positions(a, i) < static_cast<double>(edges_.domain().upper[a])) continue;
      state.positions(a, i) = static_cast<double>(edges_.domain().lower[a]);
      ++state.images(a, i);
      r[a] -= edges_.domain().length[a];
    }
    if (wide) state.remainders.col(i) = (r - state.positions.col(i).template cast<Real>()).template cast<double>();
    state.velocities.col(i) = velocity(record(i), now_).template cast<double>();
  }
  state.spins.resize(impact_.spinning() ? count() : 0);
  for (std::int32_t i = 0; i < state.spins.size(); ++i) state.spins[i] = static_cast<double>(impact_.spin(i));
  state.scale = static_cast<double>(scale_ + growth_ * now_);
  state.walls = walls_.states(now_);
  state.bonds = impact_.wells().pairs();
  state.shear_displacement = edges_.sheared() ? edges_.displacement(now_) : 0.0;
}

template <class Real>
Real TextbookEngine<Real>::suitable_epoch_length() const {
  const double spacing = box_size_ / std::sqrt(std::max(count(), 1));
  const double speed = std::max(rms_speed(records_, [](const Record& a) -> const Vec2<Real>& { return a.v; }),
                                static_cast<double>(walls_.fastest(0)));
  const double pull = std::max(static_cast<double>(falling_.g.cwiseAbs().maxCoeff()), static_cast<double>(walls_.strongest()));
  const double length = shortened_epoch(epoch_length(spacing, speed), spacing, pull);
  if (edges_.sheared()) return edges_.time_to_slide(2 * Real(largest_radius_), Real(length));  // by one contact distance
  return growth_ > 0 ? std::min<Real>(Real(length), scale_ / (64 * growth_)) : Real(length);
}

template <class Real>
template <class Archive>
void TextbookEngine<Real>::serialize(Archive& archive) {
  archive(walls_, edges_, impact_, scale_, growth_, grid_, records_, plans_, images_, epoch_, now_, epoch_length_, stall_,
          common_motion_, totals_, last_collision_);
  if constexpr (Archive::is_loading::value) fill_queue();
}

/// Of j, seen from i.
template <class Real>
Winding TextbookEngine<Real>::nearest_image(std::int32_t i, std::int32_t j) const {
  return edges_.nearest_image(position(record(i), now_) - position(record(j), now_), now_);
}

/// Length; negative where there is a gap.
template <class Real>
Real TextbookEngine<Real>::overlap_with(std::int32_t i, std::int32_t j, const Winding& image) const {
  using std::sqrt;
  return radius_at(record(i), now_) + radius_at(record(j), now_) -
         sqrt(separation(record(i), record(j), now_, image).squaredNorm());
}

template <class Real>
Real TextbookEngine<Real>::beyond_walls(std::int32_t i, int axis) const {
  if (!edges_.walled(axis)) return -infinity<Real>;
  const Record& a = record(i);
  const Real r = position(a, now_)[axis], radius = radius_at(a, now_);
  return std::max<Real>(edges_.domain().lower[axis] + radius - r - walls_.displacement(wall_of(axis, false), now_),
                        r - edges_.domain().upper[axis] + radius - walls_.displacement(wall_of(axis, true), now_));
}

template <class Real>
double TextbookEngine<Real>::deepest_overlap() const {
  Real deepest = 0;
  for (std::int32_t i = 0; i < count() && count() <= 2000; ++i)
    for (int axis = 0; axis < 2; ++axis) {
      const Real depth = beyond_walls(i, axis) / radius_at(record(i), now_);
      if (depth <= touches_a_wall) deepest = std::max<Real>(deepest, depth);
    }
  for (std::int32_t i = 0; i < count() && count() <= 2000; ++i)
    for (std::int32_t j = i + 1; j < count(); ++j)
      deepest = std::max<Real>(
          deepest, overlap_with(i, j, nearest_image(i, j)) / (radius_at(record(i), now_) + radius_at(record(j), now_)));
  return static_cast<double>(deepest);
}

template <class Real>
std::vector<std::string> TextbookEngine<Real>::check_invariants(double tolerated_overlap) const {
  std::vector<std::string> faults;
  const Real tolerance = Real(1e-12) + 1000 * epsilon<Real>;
  // Positions are rounded at their size, which far from the origin is not that of the box; where disks grow, by half an epsilon
  // more at every epoch, which each rescaling of velocities begins: a disk that is too slow to move by that stays where it is and
  // grows.
  const Real epochs = growth_ > 0 ? Real(static_cast<double>(totals_.numerics.epochs)) : Real(0);
  const Real rounding = (16 + epochs / 2) * epsilon<Real> *
                        std::max(edges_.domain().lower.cwiseAbs().maxCoeff(), edges_.domain().upper.cwiseAbs().maxCoeff());
  for (std::int32_t i = 0; i < count(); ++i) {
    const Record& a = record(i);
    const Vec2<Real> r = position(a, now_);
    if (!r.allFinite() || !a.v.allFinite()) faults.push_back(fmt::format("disk {}: position or velocity is not finite", i));
    if (next_of(i).time < now_ * (1 - tolerance)) faults.push_back(fmt::format("disk {}: its next event lies in the past", i));
    const Vec2<Real> from = grid_.cell_lower(i);
    for (int axis = 0; axis < 2; ++axis) {
      const Real slack = grid_.width()[axis] / 256;
      const Real beyond = std::max<Real>(from[axis] - r[axis], r[axis] - from[axis] - grid_.width()[axis]);
      if (beyond > slack && edges_.domain().periodic[axis])
        faults.push_back(fmt::format("disk {}: outside its cell along axis {}", i, axis));
      const Real out = beyond_walls(i, axis);
      if (out > Real(tolerated_overlap) * radius_at(a, now_) + tolerance * edges_.domain().length[axis] + rounding)
        faults.push_back(fmt::format("disk {}: {} beyond a wall across axis {}", i, static_cast<double>(out), axis));
    }
  }
  if (count() > 2000) return faults;  // the rest compares all pairs

  for (std::int32_t i = 0; i < count(); ++i) {
    for (std::int32_t j = i + 1; j < count(); ++j) {
      const Winding nearest = nearest_image(i, j);
      const Real overlap = overlap_with(i, j, nearest), sigma = radius_at(record(i), now_) + radius_at(record(j), now_);
      if (overlap > (Real(tolerated_overlap) + tolerance) * sigma + rounding)
        faults.push_back(fmt::format("disks {} and {} overlap by {}", i, j, static_cast<double>(overlap)));
      const Real meeting = pair_time(i, j, nearest);
      // Cells are as wide as disks become in this epoch; whoever grows into another later is found when the next begins.
      if (meeting < std::min({next_of(i).time, next_of(j).time, epoch_length_}))
        faults.push_back(fmt::format("disks {} and {} meet before either has an event planned", i, j));
    }
  }
  return faults;
}

}  // namespace carom
