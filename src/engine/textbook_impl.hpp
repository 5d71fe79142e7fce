#pragma once
// The whole textbook engine, what a file includes that makes one: its beginning, its state seen from outside and the check of its
// plan are here, the loop is in textbook.hpp.

#include "engine/textbook.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace carom {

template <class Real>
TextbookEngine<Real>::TextbookEngine(const Box& box, const Disks& disks, const State& start, const Effects& effects,
                                     std::uint64_t seed)
    : box_(box),
      world_(box, effects, start, seed),
      impact_(effects, disks.count()),
      grid_(world_.edges.domain(), Real(1), 0),
      records_(disks.count()),
      plans_(disks.count()),
      images_(Images::Zero(2, static_cast<Eigen::Index>(disks.count()))),
      box_size_(box.lengths()[0] * std::sqrt(box.lengths()[1] / box.lengths()[0])),
      scales_(contact_scales<Real>(effects, disks)),
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
  rebuild_grid();
  grid_.clear();
  for (std::int32_t i = 0; i < count(); ++i) grid_.insert(i, record(i).r);
  find_steps();
  if (common_motion_.present()) common_motion_.begin(records_, [](const Record& a) { return momentum(a); });
  begin_epoch(Real(0));
}

/// Finds the pairs that begin within steps of the potential.
template <class Real>
void TextbookEngine<Real>::find_steps() {
  PairPotential<Real>& potential = impact_.potential();
  if (!potential.present()) return;
  for (std::int32_t i = 0; i < count(); ++i)
    grid_.for_neighbours(i, [&](std::int32_t j, const Winding& shift) {
      const Record &a = record(i), &b = record(j);
      if (i > j) return;
      const std::int32_t step = potential.step_at(separation(a, b, 0, shift), contact_distance(i, j));
      if (step != potential.outside()) potential.move(i, j, step);
    });
}

template <class Real>
void TextbookEngine<Real>::leave_bonds(Continuation& continuation) const {
  continuation.bonds.clear();
  const PairPotential<Real>& potential = impact_.potential();
  for (std::int32_t i = 0; i < count() && potential.present(); ++i)
    for (const PairStep& pair : potential.of(i))
      if (i < pair.disk) continuation.bonds.push_back({i, pair.disk, potential.middle(pair.step)});
  continuation.sort_bonds();
}

template <class Real>
void TextbookEngine<Real>::take_over_bonds(const Continuation& continuation) {
  PairPotential<Real>& potential = impact_.potential();
  if (!potential.present()) return;
  bool changed = false;
  for (std::int32_t i = 0; i < count(); ++i)
    grid_.for_neighbours(i, [&](std::int32_t j, const Winding& shift) {
      const Record &a = record(i), &b = record(j);
      if (i > j || !world_.edges.domain().nearest(separation(a, b, 0, shift))) return;
      const std::int32_t step = potential.step_at(separation(a, b, 0, shift), contact_distance(i, j), continuation.middle(i, j));
      if (step == potential.step_of(i, j)) return;
      potential.move(i, j, step);
      changed = true;
    });
  if (!changed) return;
  for (std::int32_t i = 0; i < count(); ++i) make_plan(i);
  fill_queue();
}

template <class Real>
void TextbookEngine<Real>::rebuild_grid() {
  if (world_.edges.sheared()) {
    if (grid_.disks() != records_.size()) grid_ = CellGrid<Real>(world_.edges.domain(), largest_contact(), records_.size());
    const auto [from, to] = world_.edges.slide(epoch_length_ < infinity<Real> ? epoch_length_ : 0);
    grid_.slide(from, to);
    return;
  }
  const bool same = world_.expansion == 0 && !world_.walls.any_moves() && grid_.disks() == records_.size();
  if (same) return;
  Box now = box_;
  for (const Wall wall : {wall_left, wall_right, wall_bottom, wall_top}) {
    if (now.periodic(axis_of(wall))) continue;
    const double displacement = static_cast<double>(world_.walls.displacement(wall, 0));
    (is_upper(wall) ? now.upper : now.lower)[axis_of(wall)] += is_upper(wall) ? displacement : -displacement;
  }
  for (int axis = 0; axis < 2; ++axis)  // walls may have closed in upon each other: a grid needs some width
    now.upper[axis] = std::max(now.upper[axis], now.lower[axis] + largest_radius_);
  const Real scale = world_.expansion > 0 && epoch_length_ < infinity<Real> ? world_.scale(epoch_length_) : world_.scale_at_epoch;
  grid_ = CellGrid<Real>(SimulationBox<Real>(now), largest_contact() * scale * impact_.potential().reach(), records_.size());
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
    state.images.col(i) = images_.col(i) + world_.edges.domain().wrap(r);
    state.positions.col(i) = r.template cast<double>();
    for (int a = 0; a < 2; ++a) {  // rounding to double may reach the upper edge, which is the next box's lower one
      if (!world_.edges.domain().periodic[a] || state.positions(a, i) < static_cast<double>(world_.edges.domain().upper[a]))
        continue;
      state.positions(a, i) = static_cast<double>(world_.edges.domain().lower[a]);
      ++state.images(a, i);
      r[a] -= world_.edges.domain().length[a];
    }
    if (wide) state.remainders.col(i) = (r - state.positions.col(i).template cast<Real>()).template cast<double>();
    state.velocities.col(i) = velocity(record(i), now_).template cast<double>();
  }
  state.spins.resize(impact_.spinning() ? count() : 0);
  for (std::int32_t i = 0; i < state.spins.size(); ++i) state.spins[i] = static_cast<double>(impact_.spin(i));
  state.scale = static_cast<double>(world_.scale(now_));
  state.walls = world_.walls.states(now_);
  state.pairs_in_steps = impact_.potential().pairs();
  state.bonds = std::accumulate(state.pairs_in_steps.begin(), state.pairs_in_steps.end(), std::uint64_t{0});
  state.shear_displacement = world_.edges.sheared() ? world_.edges.displacement(now_) : 0.0;
}

template <class Real>
std::size_t TextbookEngine<Real>::bytes() const {
  return records_.capacity() * sizeof(Record) + plans_.capacity() * sizeof(Plan) +
         static_cast<std::size_t>(images_.size()) * sizeof(std::int64_t) + grid_.bytes() + queue_.bytes() + impact_.bytes() +
         world_.bytes();
}

template <class Real>
void TextbookEngine<Real>::reset_clock() {
  begin_epoch(now_);
  epoch_ = Instant{};
  totals_ = RunningTotals{};
}

template <class Real>
double TextbookEngine<Real>::set_velocity(std::int32_t i, const Eigen::Vector2d& v, double spin) {
  bring_to_now(i);
  Record& a = record(i);
  const double before = kinetic_energy(i);
  const Vec2<Real> as_it_was = a.v;
  a.v = v.cast<Real>();
  a.v[0] += world_.edges.flow(a.r[1]);
  if (!a.v.allFinite()) fail_after_hit(i, as_it_was);
  if (impact_.spinning()) impact_.spin(i) = Real(spin);
  const double gained = kinetic_energy(i) - before;
  if (outruns_epoch(a.v, now_, box_size_))
    begin_epoch(now_);
  else
    predict(i);
  return gained;
}

template <class Real>
double TextbookEngine<Real>::kinetic_energy(std::int32_t i) const {
  const Record& a = record(i);
  const Real around = impact_.spinning() ? impact_.spin(i) * radius_at(a, now_) : Real(0);
  return static_cast<double>(a.mass * (a.v.squaredNorm() / 2 + around * around / 4));
}

template <class Real>
void TextbookEngine<Real>::scale_velocities(double factor) {
  for (std::int32_t i = 0; i < count(); ++i) {
    bring_to_now(i);
    record(i).v *= Real(factor);
    if (impact_.spinning()) impact_.spin(i) *= Real(factor);
  }
  begin_epoch(now_);
}

template <class Real>
void TextbookEngine<Real>::leave(Continuation& continuation) const {
  continuation.now = now();
  continuation.totals = totals_;
  continuation.wall_draws = world_.walls.draws();
  continuation.oscillations = world_.walls.oscillation_clocks(now_);
  leave_bonds(continuation);
}

template <class Real>
void TextbookEngine<Real>::take_over(const Continuation& continuation) {
  epoch_ = continuation.now;
  totals_.go_on_from(continuation.totals);
  world_.walls.go_on_drawing(continuation.wall_draws);
  if (world_.walls.go_on_oscillating(continuation.oscillations)) {
    for (std::int32_t i = 0; i < count(); ++i) make_plan(i);
    fill_queue();
  }
  take_over_bonds(continuation);
}

template <class Real>
Real TextbookEngine<Real>::suitable_epoch_length() const {
  const double spacing = box_size_ / std::sqrt(std::max(count(), 1));
  const double speed = std::max(rms_speed(records_, [](const Record& a) -> const Vec2<Real>& { return a.v; }),
                                static_cast<double>(world_.walls.fastest(0)));
  const double pull =
      std::max(static_cast<double>(world_.falling.g.cwiseAbs().maxCoeff()), static_cast<double>(world_.walls.strongest()));
  const double length = shortened_epoch(epoch_length(spacing, speed), spacing, pull);
  if (world_.edges.sheared())
    return world_.edges.time_to_slide(2 * Real(largest_radius_), Real(length));  // by one contact distance
  return world_.expansion > 0 ? std::min<Real>(Real(length), world_.scale_at_epoch / (64 * world_.expansion)) : Real(length);
}

template <class Real>
template <class Archive>
void TextbookEngine<Real>::serialize(Archive& archive) {
  archive(world_.walls, world_.edges, impact_, world_.scale_at_epoch, world_.expansion, grid_, records_, plans_, images_, epoch_,
          now_, epoch_length_, stall_, common_motion_, totals_, last_collision_);
  if constexpr (Archive::is_loading::value) fill_queue();
}

/// The shift of the image of disk j that is nearest to disk i.
template <class Real>
Winding TextbookEngine<Real>::nearest_image(std::int32_t i, std::int32_t j) const {
  return world_.edges.nearest_image(position(record(i), now_) - position(record(j), now_), now_);
}

/// The length by which disk i and an image of disk j overlap; negative where there is a gap.
template <class Real>
Real TextbookEngine<Real>::overlap_with(std::int32_t i, std::int32_t j, const Winding& image) const {
  using std::sqrt;
  return contact_distance_at(i, j, now_) - sqrt(separation(record(i), record(j), now_, image).squaredNorm());
}

template <class Real>
Real TextbookEngine<Real>::beyond_walls(std::int32_t i, int axis) const {
  if (!world_.edges.walled(axis)) return -infinity<Real>;
  const Record& a = record(i);
  if (world_.circle) {
    using std::sqrt;
    const Vec2<Real> from = position(a, now_) - world_.circle->centre.template cast<Real>();
    return sqrt(from.squaredNorm()) + radius_at(a, now_) - Real(world_.circle->radius);
  }
  const Real r = position(a, now_)[axis], radius = radius_at(a, now_);
  return std::max<Real>(world_.edges.domain().lower[axis] + radius - r - world_.walls.displacement(wall_of(axis, false), now_),
                        r - world_.edges.domain().upper[axis] + radius - world_.walls.displacement(wall_of(axis, true), now_));
}

template <class Real>
double TextbookEngine<Real>::deepest_overlap() const {
  Real deepest = 0;
  const auto consider = [&deepest](Real depth) {
    if (depth <= touches_a_wall) deepest = std::max<Real>(deepest, depth);
  };
  if (count() > most_compared) return 0.0;
  for (std::int32_t i = 0; i < count(); ++i) {
    const Real radius = radius_at(record(i), now_);
    for (int axis = 0; axis < 2; ++axis) consider(beyond_walls(i, axis) / radius);
    const auto at_obstacle = world_.overlap_with_obstacles(position(record(i), now_), radius);
    consider(at_obstacle.depth / at_obstacle.contact);
  }
  for (std::int32_t i = 0; i < count(); ++i)
    for (std::int32_t j = i + 1; j < count(); ++j)
      deepest = std::max<Real>(deepest, overlap_with(i, j, nearest_image(i, j)) / contact_distance_at(i, j, now_));
  return static_cast<double>(deepest);
}

template <class Real>
std::vector<std::string> TextbookEngine<Real>::check_invariants(double tolerated_overlap) const {
  std::vector<std::string> faults;
  const Real tolerance = Real(1e-12) + 1000 * epsilon<Real>;
  // Positions are rounded at their size, which far from the origin, or where walls have moved far, is not that of the box; where
  // disks grow, by half an epsilon more at every epoch, which each rescaling of velocities begins: a disk that is too slow to
  // move by that stays where it is and grows.
  const Real epochs = world_.expansion > 0 ? Real(static_cast<double>(totals_.numerics.epochs)) : Real(0);
  const SimulationBox<Real>& domain = world_.edges.domain();
  Real farthest = std::max(domain.lower.cwiseAbs().maxCoeff(), domain.upper.cwiseAbs().maxCoeff());
  for (std::int32_t i = 0; i < count(); ++i) farthest = std::max<Real>(farthest, position(record(i), now_).cwiseAbs().maxCoeff());
  const Real rounding = (16 + epochs / 2) * epsilon<Real> * farthest;
  for (std::int32_t i = 0; i < count(); ++i) {
    const Record& a = record(i);
    const Vec2<Real> r = position(a, now_);
    if (!r.allFinite() || !a.v.allFinite()) faults.push_back(fmt::format("disk {}: position or velocity is not finite", i));
    if (next_of(i).time < now_ * (1 - tolerance)) faults.push_back(fmt::format("disk {}: its next event lies in the past", i));
    const Vec2<Real> from = grid_.cell_lower(i);
    for (int axis = 0; axis < 2; ++axis) {
      const Real slack = grid_.width()[axis] / 256;
      const Real beyond = std::max<Real>(from[axis] - r[axis], r[axis] - from[axis] - grid_.width()[axis]);
      if (beyond > slack && world_.edges.domain().periodic[axis])
        faults.push_back(fmt::format("disk {}: outside its cell along axis {}", i, axis));
      const Real out = beyond_walls(i, axis);
      if (out > Real(tolerated_overlap) * radius_at(a, now_) + tolerance * world_.edges.domain().length[axis] + rounding)
        faults.push_back(fmt::format("disk {}: {} beyond a wall across axis {}", i, static_cast<double>(out), axis));
    }
    const auto [obstacle, depth, contact] = world_.overlap_with_obstacles(r, radius_at(a, now_));
    // Obstacles are joined where their ends are within 1e-12 of the box.
    const Real room = contact + world_.edges.domain().length.sum();
    if (depth > Real(tolerated_overlap) * contact + tolerance * room + rounding)
      faults.push_back(fmt::format("disk {}: overlaps obstacles.{} by {}", i, obstacle, static_cast<double>(depth)));
  }
  if (count() > most_compared) return faults;  // the rest compares all pairs

  for (std::int32_t i = 0; i < count(); ++i) {
    for (std::int32_t j = i + 1; j < count(); ++j) {
      const Winding nearest = nearest_image(i, j);
      const Real overlap = overlap_with(i, j, nearest), sigma = contact_distance_at(i, j, now_);
      if (overlap > (Real(tolerated_overlap) + tolerance) * sigma + rounding)
        faults.push_back(fmt::format("disks {} and {} overlap by {}", i, j, static_cast<double>(overlap)));
      const Real meeting = pair_time(i, j, nearest);
      // Cells are as wide as disks become in this epoch; disks that grow into another later are found when the next begins.
      if (meeting < std::min({next_of(i).time, next_of(j).time, epoch_length_}))
        faults.push_back(fmt::format("disks {} and {} meet before either has an event planned", i, j));
    }
  }
  return faults;
}

}  // namespace carom
