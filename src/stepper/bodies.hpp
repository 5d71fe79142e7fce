#pragma once
// The disks of a fixed-step method: positions and velocities at the present step, how disks fly, what stands round them, what
// collisions keep of their speed, and how stiff the springs are of a method that has some.

#include "core/sides.hpp"
#include "core/simulation_box.hpp"
#include "effects/gravity.hpp"
#include "effects/impact.hpp"
#include "stepper/step_shapes.hpp"

#include <carom/state.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace carom {

struct Bodies {
  Bodies(const Box& box, const Disks& disks, const State& start, const Effects& effects = {}, std::optional<double> spring = {})
      : domain(box),
        walled{!box.periodic(0) && !box.is_circle, !box.periodic(1) && !box.is_circle},
        shapes(step_shapes(box, effects)),
        around(domain.periodic[0] ? domain.length[0] : infinity<double>,
               domain.periodic[1] ? domain.length[1] : infinity<double>),
        r(disks.count()),
        v(disks.count()),
        radius(disks.radius),
        mass(disks.mass),
        falling(effects.gravity),
        impact{(1.0 + effects.collision.restitution.value_or(1.0)) / 2.0, 0.0},
        stiffness(spring),
        images(Images::Zero(2, static_cast<Eigen::Index>(disks.count()))) {
    for (std::size_t k = 0; k < wall_restitution.size(); ++k) wall_restitution[k] = effects.walls[k].restitution.value_or(1.0);
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

  /// Returns whether there is anything round the disks besides other disks.
  [[nodiscard]] bool bounded() const { return walled[0] || walled[1] || shapes != nullptr; }

  /// Returns the largest speed.
  [[nodiscard]] double fastest() const {
    double even = 0.0, odd = 0.0;
    for (std::size_t i = 0; i + 1 < v.size(); i += 2) {
      even = std::max(even, v[i].squaredNorm());
      odd = std::max(odd, v[i + 1].squaredNorm());
    }
    if (!v.empty()) odd = std::max(odd, v.back().squaredNorm());
    return std::sqrt(std::max(even, odd));
  }

  /// Returns whether all positions and velocities are finite, and their sums.
  [[nodiscard]] bool finite() const {
    Vec2<double> even(0.0, 0.0), odd(0.0, 0.0);  // what is not finite leaves no 0
    for (std::size_t i = 0; i + 1 < r.size(); i += 2) {
      even += 0.0 * (r[i] + v[i]);
      odd += 0.0 * (r[i + 1] + v[i + 1]);
    }
    if (!r.empty()) odd += 0.0 * (r.back() + v.back());
    return (even + odd).sum() == 0.0;
  }

  /// Returns a - b between the nearest images. Requires both inside the box along periodic axes.
  [[nodiscard]] Vec2<double> separation(const Vec2<double>& a, const Vec2<double>& b) const {
    Vec2<double> apart = a - b;
    for (int axis = 0; axis < 2; ++axis) {  // a branch would be taken by half of all pairs across an edge
      const double far = std::abs(apart[axis]);
      apart[axis] -= around[axis] - far < far ? std::copysign(around[axis], apart[axis]) : 0.0;
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
    if (!is_inside(r[i])) enter_again(i);
  }

  /// Moves all disks along their flights for a time t: straight ones by v t, or parabolas under gravity.
  void fly(double t) {
    if (!falling.present()) {
      const std::size_t whole = count() - count() % block;
      for (std::size_t i = 0; i < whole; i += block) move_block(i, t);
      for (std::size_t i = whole; i < count(); ++i) move(i, v[i], t);
      return;
    }
    for (std::size_t i = 0; i < count(); ++i) {
      move(i, mean_velocity(v[i], t), t);
      accelerate(i, t);
    }
  }

  /// Returns the mean velocity over a time t of a flight that begins with velocity u.
  [[nodiscard]] Vec2<double> mean_velocity(const Vec2<double>& u, double t) const {
    return falling.present() ? Vec2<double>(u + (t / 2) * falling.g) : u;
  }

  /// Gives disk i the velocity that it has a time t later, or earlier for t < 0.
  void accelerate(std::size_t i, double t) {
    if (falling.present()) v[i] += t * falling.g;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(r, v, images);
  }

  SimulationBox<double> domain;
  bool walled[2];                            ///< across which axes there are walls
  std::shared_ptr<const StepShapes> shapes;  ///< null where there are none
  Vec2<double> around;                       ///< how far it is round the box; infinite between walls
  std::vector<Vec2<double>> r;               ///< at the last step
  std::vector<Vec2<double>> v;
  std::vector<double> radius;
  std::vector<double> mass;
  Falling<double> falling;
  Inelasticity<double> impact;             ///< of two disks
  std::array<double, 4> wall_restitution;  ///< left, right, bottom, top
  std::optional<double> stiffness;         ///< of springs, force per overlap; empty where it follows from the step
  Images images;

 private:
  static constexpr std::size_t block = 4;

  /// Moves disks i to i + block - 1 as move() does, and looks once whether any has left the box.
  void move_block(std::size_t i, double t) {
    using Pair = double __attribute__((vector_size(16)));
    const Pair lower{domain.lower[0], domain.lower[1]}, upper{domain.upper[0], domain.upper[1]};
    auto inside = lower <= upper;  // true on both axes
    for (std::size_t k = i; k < i + block; ++k) {
      const Pair place = Pair{r[k][0], r[k][1]} + Pair{v[k][0], v[k][1]} * t;
      inside &= (place >= lower) & (place < upper);
      r[k][0] = place[0];
      r[k][1] = place[1];
    }
    if ((inside[0] & inside[1]) != 0) return;
    for (std::size_t k = i; k < i + block; ++k)
      if (!is_inside(r[k])) enter_again(k);
  }

  [[nodiscard]] bool is_inside(const Vec2<double>& a) const {
    return a[0] >= domain.lower[0] && a[0] < domain.upper[0] && a[1] >= domain.lower[1] && a[1] < domain.upper[1];
  }

  /// Disk i has left the box: past a periodic edge it comes in again at the other side.
  [[gnu::noinline, gnu::cold]] void enter_again(std::size_t i) { images.col(static_cast<Eigen::Index>(i)) += domain.wrap(r[i]); }
};

}  // namespace carom
