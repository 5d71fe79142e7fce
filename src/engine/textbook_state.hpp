#pragma once
// The textbook engine's beginning, its state seen from outside, and the check of its plan: everything but the loop.

#include "engine/textbook.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace carom {

template <class Real, class Rule>
TextbookEngine<Real, Rule>::TextbookEngine(const Box& box, const Disks& disks, const State& start)
    : domain_(box),
      grid_(domain_, disks.count() == 0 ? Real(1) : 2 * Real(*std::max_element(disks.radius.begin(), disks.radius.end())),
            disks.count()),
      records_(disks.count()),
      plans_(disks.count()),
      images_(Images::Zero(2, static_cast<Eigen::Index>(disks.count()))),
      box_size_(std::sqrt(box.lengths()[0]) * std::sqrt(box.lengths()[1])) {
  for (std::int32_t i = 0; i < count(); ++i) {
    record(i).r = start.positions.col(i).cast<Real>();
    record(i).v = start.velocities.col(i).cast<Real>();
    record(i).radius = Real(disks.radius[static_cast<std::size_t>(i)]);
    record(i).mass = Real(disks.mass[static_cast<std::size_t>(i)]);
    if (start.images.cols() > i) images_.col(i) = start.images.col(i);
  }
  begin_epoch(Real(0));
}

template <class Real, class Rule>
State TextbookEngine<Real, Rule>::state() const {
  State state;
  state.time = now().high;
  state.positions.resize(2, count());
  state.velocities.resize(2, count());
  state.images.resize(2, count());
  constexpr bool wide = std::numeric_limits<Real>::digits > std::numeric_limits<double>::digits;
  if (wide) state.remainders.resize(2, count());
  for (std::int32_t i = 0; i < count(); ++i) {
    Vec2<Real> r = position(record(i), now_);
    state.images.col(i) = images_.col(i) + domain_.wrap(r);
    state.positions.col(i) = r.template cast<double>();
    for (int a = 0; a < 2; ++a) {  // rounding to double may reach the upper edge, which is the next box's lower one
      if (!domain_.periodic[a] || state.positions(a, i) < static_cast<double>(domain_.upper[a])) continue;
      state.positions(a, i) = static_cast<double>(domain_.lower[a]);
      ++state.images(a, i);
      r[a] -= domain_.length[a];
    }
    if (wide) state.remainders.col(i) = (r - state.positions.col(i).template cast<Real>()).template cast<double>();
    state.velocities.col(i) = record(i).v.template cast<double>();
  }
  return state;
}

template <class Real, class Rule>
Real TextbookEngine<Real, Rule>::suitable_epoch_length() const {
  const double speed = rms_speed(records_, [](const Record& a) -> const Vec2<Real>& { return a.v; });
  return Real(epoch_length(box_size_ / std::sqrt(std::max(count(), 1)), speed));
}

template <class Real, class Rule>
std::vector<std::string> TextbookEngine<Real, Rule>::check_invariants() const {
  std::vector<std::string> faults;
  const Real tolerance = Real(1e-12) + 1000 * epsilon<Real>;
  for (std::int32_t i = 0; i < count(); ++i) {
    const Record& a = record(i);
    const Vec2<Real> r = position(a, now_);
    if (!r.allFinite() || !a.v.allFinite()) faults.push_back(fmt::format("disk {}: position or velocity is not finite", i));
    if (next_of(i).time < now_ * (1 - tolerance)) faults.push_back(fmt::format("disk {}: its next event lies in the past", i));
    const Vec2<Real> from = grid_.cell_lower(i);
    for (int axis = 0; axis < 2; ++axis) {
      const Real slack = grid_.width()[axis] / 256;
      const Real beyond = std::max<Real>(from[axis] - r[axis], r[axis] - from[axis] - grid_.width()[axis]);
      if (beyond > slack && domain_.periodic[axis])
        faults.push_back(fmt::format("disk {}: outside its cell along axis {}", i, axis));
      const Real out = std::max<Real>(domain_.lower[axis] + a.radius - r[axis], r[axis] - domain_.upper[axis] + a.radius);
      if (!domain_.periodic[axis] && out > tolerance * domain_.length[axis])
        faults.push_back(fmt::format("disk {}: {} beyond a wall across axis {}", i, static_cast<double>(out), axis));
    }
  }
  if (count() > 2000) return faults;  // the rest compares all pairs

  for (std::int32_t i = 0; i < count(); ++i) {
    for (std::int32_t j = i + 1; j < count(); ++j) {
      const Vec2<Real> apart = position(record(i), now_) - position(record(j), now_);
      Winding nearest = Winding::Zero();
      for (int axis = 0; axis < 2; ++axis) {
        using std::floor;
        if (domain_.periodic[axis])
          nearest[axis] = static_cast<std::int64_t>(floor(apart[axis] / domain_.length[axis] + Real(0.5)));
      }
      const Real sigma = record(i).radius + record(j).radius;
      using std::sqrt;
      const Real gap = sqrt(separation(record(i), record(j), now_, nearest).squaredNorm()) - sigma;
      if (gap < -tolerance * sigma)
        faults.push_back(fmt::format("disks {} and {} overlap by {}", i, j, static_cast<double>(-gap)));
      const Real meeting = pair_time(record(i), record(j), nearest);
      if (meeting < std::min(next_of(i).time, next_of(j).time))
        faults.push_back(fmt::format("disks {} and {} meet before either has an event planned", i, j));
    }
  }
  return faults;
}

}  // namespace carom
