#pragma once
// The disks of a fixed-step method: positions and velocities at the present step, and nothing else.

#include "core/domain.hpp"

#include <carom/state.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace carom {

struct Bodies {
  Bodies(const Box& box, const Disks& disks, const State& start)
      : domain(box),
        around(domain.periodic[0] ? domain.length[0] : infinity<double>,
               domain.periodic[1] ? domain.length[1] : infinity<double>),
        r(disks.count()),
        v(disks.count()),
        radius(disks.radius),
        mass(disks.mass),
        images(Images::Zero(2, static_cast<Eigen::Index>(disks.count()))) {
    for (std::size_t i = 0; i < r.size(); ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      r[i] = start.positions.col(column);
      v[i] = start.velocities.col(column);
      if (start.images.cols() > column) images.col(column) = start.images.col(column);
    }
  }

  [[nodiscard]] std::size_t count() const { return r.size(); }
  [[nodiscard]] std::size_t bytes() const {
    return (r.capacity() + v.capacity()) * sizeof(Vec2<double>) + (radius.capacity() + mass.capacity()) * sizeof(double) +
           static_cast<std::size_t>(images.size()) * sizeof(std::int64_t);
  }

  /// Returns whether all positions and velocities are finite.
  [[nodiscard]] bool finite() const {
    Vec2<double> places(0.0, 0.0), speeds(0.0, 0.0);  // what is not finite leaves no 0
    for (std::size_t i = 0; i < r.size(); ++i) {
      places += 0.0 * r[i];
      speeds += 0.0 * v[i];
    }
    return (places + speeds).sum() == 0.0;
  }

  /// Returns a - b between the nearest images. Requires both inside the box along periodic axes.
  [[nodiscard]] Vec2<double> separation(const Vec2<double>& a, const Vec2<double>& b) const {
    Vec2<double> apart = a - b;
    for (int axis = 0; axis < 2; ++axis) {
      if (around[axis] - std::abs(apart[axis]) < std::abs(apart[axis])) apart[axis] -= std::copysign(around[axis], apart[axis]);
    }
    return apart;
  }

  /// Returns separation(a, b).squaredNorm(), to the last bit, without a branch that half of all pairs would take.
  [[nodiscard]] double squared_distance(const Vec2<double>& a, const Vec2<double>& b) const {
    const Vec2<double> apart = (a - b).cwiseAbs();
    return apart.cwiseMin(around - apart).squaredNorm();
  }

  /// Moves disk i by its velocity u times t, past periodic edges where need be.
  void move(std::size_t i, const Vec2<double>& u, double t) {
    r[i] += u * t;
    if (inside(r[i])) return;
    images.col(static_cast<Eigen::Index>(i)) += domain.wrap(r[i]);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(r, v, images);
  }

  Domain<double> domain;
  Vec2<double> around;          ///< how far it is round the box; infinite between walls
  std::vector<Vec2<double>> r;  ///< at the last step
  std::vector<Vec2<double>> v;
  std::vector<double> radius;
  std::vector<double> mass;
  Images images;

 private:
  [[nodiscard]] bool inside(const Vec2<double>& a) const {
    return a[0] >= domain.lower[0] && a[0] < domain.upper[0] && a[1] >= domain.lower[1] && a[1] < domain.upper[1];
  }
};

}  // namespace carom
