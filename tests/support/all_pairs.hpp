#pragma once
// The slow and obvious twin of the textbook engine: no cells, no queue, no plans. Before every event it compares all
// pairs, in all images that can matter, and all walls, and takes the first. Same arithmetic, so the same bits.

#include "core/contact_time.hpp"
#include "core/instant.hpp"
#include "core/sides.hpp"
#include "core/simulation_box.hpp"
#include "effects/impact.hpp"
#include "engine/epoch.hpp"

#include <carom/state.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <vector>

namespace carom::test {

template <class Real>
struct WallContact {
  Real time = infinity<Real>;
  Wall wall = wall_left;
};

/// The next contact of a disk of the given radius, at position r at time t, with a wall. A disk that touches or
/// overlaps a wall and moves into it is in contact now. Of a corner's two walls the vertical one comes first.
template <class Real>
[[nodiscard]] WallContact<Real> next_wall_contact(const SimulationBox<Real>& domain, const Vec2<Real>& r, const Vec2<Real>& v,
                                                  Real radius, Real t) {
  WallContact<Real> next;
  for (int a = 0; a < 2; ++a) {
    if (domain.periodic[a] || v[a] == 0) continue;
    const bool up = v[a] > 0;
    const Real gap = up ? (domain.upper[a] - radius) - r[a] : r[a] - (domain.lower[a] + radius);
    const Real time = gap > 0 ? t + gap / (up ? v[a] : -v[a]) : t;
    if (time < next.time) next = {time, static_cast<Wall>(wall_left - 2 * a - (up ? 1 : 0))};
  }
  return next;
}

template <class Rule>
class AllPairsTwin {
 public:
  AllPairsTwin(const Box& box, const Disks& disks, const State& start) : domain_(box), disks_(disks) {
    for (std::size_t i = 0; i < disks.count(); ++i) {
      r_.push_back(start.positions.col(static_cast<Eigen::Index>(i)));
      v_.push_back(start.velocities.col(static_cast<Eigen::Index>(i)));
      t_.push_back(0.0);
    }
    begin_epoch(0.0);
  }

  /// The next collision, made to happen. At time infinity where disks would travel more than 8 box lengths before it, or 1,000
  /// where a single axis is periodic: too many images to search.
  Event step() {
    for (;;) {
      const Event event = next_event();
      if (event.disk != epoch_change) return event;
    }
  }

 private:
  static constexpr int epoch_change = -2;

  /// The next collision, or the change of the epoch if that comes first.
  Event next_event() {
    double first = infinity<double>;
    int a = -1;
    int b = -1;
    Winding shift = Winding::Zero();
    for (int i = 0; i < n(); ++i) {
      const auto wall = next_wall_contact<double>(domain_, r_[at(i)], v_[at(i)], disks_.radius[at(i)], t_[at(i)]);
      if (std::tie(wall.time, i) < std::tie(first, a) || (wall.time == first && i == a && wall.wall < b))
        first = wall.time, a = i, b = wall.wall;
    }
    // With images up to `reach` box lengths away; widened until nothing beyond could come in before what was found.
    for (std::int64_t reach = 1;; reach *= 2) {
      for (int i = 0; i < n(); ++i) {
        for (int j = i + 1; j < n(); ++j) {
          for (std::int64_t x = domain_.periodic[0] ? -reach : 0; x <= (domain_.periodic[0] ? reach : 0); ++x) {
            for (std::int64_t y = domain_.periodic[1] ? -reach : 0; y <= (domain_.periodic[1] ? reach : 0); ++y) {
              const Winding s(x, y);
              const double from = std::max(t_[at(i)], t_[at(j)]);
              const double time = from + contact_time<double>(separation(i, j, from, s), v_[at(i)] - v_[at(j)], sigma(i, j));
              if (std::tie(time, i, j) < std::tie(first, a, b)) first = time, a = i, b = j, shift = s;
            }
          }
        }
      }
      double travel = 0.0;
      for (int i = 0; i < n(); ++i) travel = std::max(travel, 2.0 * v_[at(i)].norm() * (std::min(first, length_) - t_[at(i)]));
      double box = infinity<double>;
      for (int axis = 0; axis < 2; ++axis)
        if (domain_.periodic[axis]) box = std::min(box, domain_.length[axis]);
      if (!(travel + 2.0 * box > static_cast<double>(reach) * box)) break;
      if (reach >= (domain_.periodic[0] && domain_.periodic[1] ? 8 : 1024)) return {infinity<double>, 0.0, -1, -1, {}, {}};
    }
    if (length_ <= first) {
      begin_epoch(length_);
      return {0.0, 0.0, epoch_change, -1, {}, {}};
    }
    const double now = first;
    Event event;
    event.disk = a;
    event.partner = b;
    if (b >= 0) {
      shift -= bring_to(a, now) - bring_to(b, now);
      collide<Rule, double>(separation(a, b, now, shift), disks_.mass[at(a)], v_[at(a)], disks_.mass[at(b)], v_[at(b)]);
      event.partner_velocity = v_[at(b)];
    } else {
      bring_to(a, now);
      double& across = v_[at(a)][axis_of(static_cast<Wall>(b))];
      across = -across;
    }
    event.velocity = v_[at(a)];
    const Instant when = epoch_.plus(now);
    event.time = when.high;
    event.time_remainder = when.low;
    const auto outruns = [&](int i) { return outruns_epoch(v_[at(i)], now, box_size()); };
    if (outruns(a) || (b >= 0 && outruns(b))) begin_epoch(now);
    return event;
  }

  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  [[nodiscard]] double box_size() const { return std::sqrt(domain_.length[0]) * std::sqrt(domain_.length[1]); }
  [[nodiscard]] int n() const { return static_cast<int>(r_.size()); }
  [[nodiscard]] double sigma(int i, int j) const { return disks_.radius[at(i)] + disks_.radius[at(j)]; }

  [[nodiscard]] Vec2<double> separation(int i, int j, double time, const Winding& s) const {
    const Vec2<double> a = r_[at(i)] + v_[at(i)] * (time - t_[at(i)]);
    const Vec2<double> b = r_[at(j)] + v_[at(j)] * (time - t_[at(j)]);
    Vec2<double> r = a - b;
    for (int k = 0; k < 2; ++k) r[k] -= static_cast<double>(s[k]) * domain_.length[k];
    return r;
  }

  Winding bring_to(int i, double now) {
    r_[at(i)] = r_[at(i)] + v_[at(i)] * (now - t_[at(i)]);
    t_[at(i)] = now;
    return domain_.wrap(r_[at(i)]);
  }

  void begin_epoch(double now) {
    for (int i = 0; i < n(); ++i) {
      bring_to(i, now);
      t_[at(i)] = 0.0;
    }
    epoch_ = epoch_.plus(now);
    const double speed = rms_speed(v_, [](const Vec2<double>& v) -> const Vec2<double>& { return v; });
    length_ = epoch_length(box_size() / std::sqrt(std::max(n(), 1)), speed);
  }

  SimulationBox<double> domain_;
  Disks disks_;
  std::vector<Vec2<double>> r_;
  std::vector<Vec2<double>> v_;
  std::vector<double> t_;
  Instant epoch_;
  double length_ = 0.0;
};

}  // namespace carom::test
