#pragma once
// Soft disks by fixed steps, as discrete element codes run them: a repulsive linear spring of stiffness k acts on the overlap of
// two disks, or of a disk and a wall or a fixed shape, and velocity Verlet integrates it. In each step:
//
//   1. v += F dt / (2 m); move along the flights of bodies.hpp for a time dt;
//   2. find the overlaps and their forces F; v += F dt / (2 m); record the positions.
//
// Two disks of reduced mass mu = m_i m_j / (m_i + m_j) that meet are half a period of the oscillator (k, mu) in contact, and a
// disk at a wall half of that of (k, m):
//
//     t_c = pi sqrt(mu / k),    deepest overlap = v_n t_c / pi,    v_n: the speed with which they close.
//
// Hard disks are the limit t_c -> 0, and the positions of soft ones differ from theirs by the order of v_n t_c. So a stiffness is
// a step: unless k is given, it is such that the shortest contact of the scene, that of its two lightest disks, takes
// `steps_per_contact` steps,
//
//     k = mu (pi / (steps_per_contact dt))^2.
//
// Velocity Verlet is stable for omega dt < 2, where a pair has omega = sqrt(k / mu), which is pi / steps_per_contact here, and
// equal disks with contacts all around have up to sqrt(3) times that (stable_step.hpp): no dt is unstable, a longer one makes
// softer disks. That holds at any ratio of masses; a large disk no heavier than small ones that are a hundred times smaller may
// have so many contacts that every dt is unstable. A given k is stable for short steps alone. Where v_n t_c / pi comes near a
// diameter disks pass through each other.
//
// A contact begins and ends between steps. That changes the speed with which an elastic pair parts by a random share, whatever dt
// is: (pi dt / t_c)^2 / 19 (root mean square; the spread of x - x^2 for two random moments x in a step), 6e-4 for 30 steps. Where
// t_c is a whole number of steps, as for two equal disks alone, the two ends cancel, and 1.2 (dt / t_c)^3 is left, 4e-5.
//
// A restitution e < 1 is a dashpot beside the spring: a force -gamma v_n with v_n the rate at which the overlap shrinks, and
//
//     gamma = -2 ln(e) sqrt(k mu) / sqrt(pi^2 + ln(e)^2),
//
// so that the damped oscillator leaves the overlap zero with e times the speed with which it came. v_n is that at the step
// itself, v + (k overlap - gamma v_n) dt / (2 mu) with v before the second half of the kick, solved for v_n.
//
// The energy that springs hold is not part of the kinetic energy, so that dips while disks are in contact. A contact is counted
// and logged when it ends.

#include "core/sides.hpp"
#include "core/vec2.hpp"
#include "stepper/bodies.hpp"
#include "stepper/grid.hpp"
#include "stepper/tally.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace carom {

template <class Pairs>
class SoftStep {
 public:
  /// The number of steps of the scene's shortest contact.
  static constexpr double steps_per_contact = 30.0;

  /// Requires restitutions above 0.
  SoftStep(const Bodies& bodies, double dt)
      : dt_(dt), stiffness_(bodies.stiffness.value_or(stiffness(bodies.mass, dt))), pairs_(bodies, dt) {
    damping_ = relative_damping(2.0 * bodies.impact.reflected_fraction - 1.0);
    for (std::size_t wall = 0; wall < 4; ++wall) wall_damping_[wall] = relative_damping(bodies.wall_restitution[wall]);
  }

  [[nodiscard]] static double work(double disks) { return Pairs::work(disks); }

  void advance(Bodies& bodies, Tally& /*tally*/) { advance(bodies, dt_); }

  void check(Bodies& bodies, Tally& tally) {
    std::swap(contacts_, before_);
    contacts_.clear();
    push_pairs(bodies, tally);
    if (bodies.bounded()) push_walls(bodies, tally);
    kick(bodies, span_ / 2);
    count_ended(bodies, tally);
  }

  /// Moves disks from the last step to a time before the next one, by a step that is shorter.
  void move_on(Bodies& bodies, double time) const {
    SoftStep step = *this;
    Tally unseen;
    step.advance(bodies, time);
    step.check(bodies, unseen);
  }

  [[nodiscard]] std::size_t bytes() const {
    return pairs_.bytes() + (contacts_.capacity() + before_.capacity()) * sizeof(Contact);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(pairs_, contacts_);
  }

  /// Returns the k that steps of dt have where none is given.
  [[nodiscard]] static double stiffness(const std::vector<double>& masses, double dt) {
    if (masses.empty()) return 0.0;
    double lightest = infinity<double>, second = infinity<double>;
    for (const double mass : masses) {
      second = std::min(second, std::max(mass, lightest));
      lightest = std::min(lightest, mass);
    }
    const double reduced = lightest / (1.0 + lightest / second);
    const double omega = std::numbers::pi / (steps_per_contact * dt);
    return reduced * omega * omega;
  }

  /// Returns gamma / sqrt(k mu), below 2. Requires a restitution above 0.
  [[nodiscard]] static double relative_damping(double restitution) {
    if (restitution == 1.0) return 0.0;
    const double log = std::log(restitution);
    return -2.0 * log / std::hypot(std::numbers::pi, log);
  }

 private:
  /// A disk in contact with a disk j > i, or with wall or fixed shape j < 0, and the force on it.
  struct Contact {
    std::uint32_t i;
    std::int32_t j;
    double force[2];
  };

  /// A spring and dashpot at the present step.
  struct Push {
    double force;  ///< that drives them apart
    double power;  ///< that the dashpot takes
  };
  [[nodiscard]] Push push(double overlap, double parting, double mass, double damping) const {
    const double spring = stiffness_ * overlap;
    if (damping == 0.0) return {spring, 0.0};
    const double gamma = damping * std::sqrt(stiffness_ * mass), half = span_ / (2.0 * mass);
    const double speed = (parting + spring * half) / (1.0 + gamma * half);
    return {spring - gamma * speed, gamma * speed * speed};
  }

  void advance(Bodies& bodies, double time) {
    kick(bodies, time / 2);
    bodies.fly(time);
    pairs_.moved(bodies, time);
    span_ = time;
  }

  void kick(Bodies& bodies, double time) const {
    for (const Contact& contact : contacts_) {
      const Vec2<double> impulse(time * contact.force[0], time * contact.force[1]);
      bodies.v[contact.i] += impulse / bodies.mass[contact.i];
      if (contact.j < 0) continue;
      const auto j = static_cast<std::size_t>(contact.j);
      bodies.v[j] -= impulse / bodies.mass[j];
    }
  }

  /// Returns how long the forces of this step act: from half a step before it to half a step after.
  [[nodiscard]] double lasting() const { return (span_ + dt_) / 2; }

  void push_pairs(const Bodies& bodies, Tally& tally) {
    double virial = 0.0, power = 0.0;
    pairs_.for_contacts(bodies, [&](std::size_t i, std::size_t j, const Vec2<double>& r) {
      const double distance = std::sqrt(r.squaredNorm());
      if (!(distance > 0.0)) return;  // centre upon centre: no direction
      const double parting = r.dot(bodies.v[i] - bodies.v[j]) / distance;
      const double mass = bodies.mass[i] / (1.0 + bodies.mass[i] / bodies.mass[j]);
      const Push felt = push(bodies.radius[i] + bodies.radius[j] - distance, parting, mass, damping_);
      virial += felt.force * distance;
      power += felt.power;
      const double along = felt.force / distance;
      contacts_.push_back({static_cast<std::uint32_t>(i), static_cast<std::int32_t>(j), {along * r[0], along * r[1]}});
    });
    if (contacts_.empty()) return;
    tally.totals.virial.add(virial * lasting());
    if (power != 0.0) tally.totals.dissipated.add(power * lasting());
  }

  void push_walls(const Bodies& bodies, Tally& tally) {
    double impulse[4] = {}, power[4] = {};
    for (std::uint32_t i = 0; i < bodies.count(); ++i) {
      for (int axis = 0; axis < 2; ++axis) {
        if (!bodies.walled[axis]) continue;
        const double below = bodies.domain.lower[axis] + bodies.radius[i] - bodies.r[i][axis];
        const double above = bodies.r[i][axis] - (bodies.domain.upper[axis] - bodies.radius[i]);
        if (below > 0.0) push_wall(bodies, i, wall_of(axis, false), below, impulse, power);
        if (above > 0.0) push_wall(bodies, i, wall_of(axis, true), above, impulse, power);
      }
      if (bodies.shapes != nullptr) push_shapes(bodies, i, tally);
    }
    for (std::size_t wall = 0; wall < 4; ++wall) {
      tally.totals.wall_impulse[wall].add(impulse[wall] * lasting());
      tally.totals.wall_energy[wall].add(power[wall] * lasting());
    }
  }

  void push_wall(const Bodies& bodies, std::uint32_t i, Wall wall, double overlap, double* impulse, double* power) {
    const double inward = is_upper(wall) ? -1.0 : 1.0;
    const int axis = axis_of(wall);
    const std::size_t index = index_of(wall);
    const Push felt = push(overlap, inward * bodies.v[i][axis], bodies.mass[i], wall_damping_[index]);
    impulse[index] += felt.force;
    power[index] += felt.power;
    Contact contact{i, wall, {0.0, 0.0}};
    contact.force[axis] = inward * felt.force;
    contacts_.push_back(contact);
  }

  void push_shapes(const Bodies& bodies, std::uint32_t i, Tally& tally) {
    bodies.shapes->for_overlaps(bodies.r[i], bodies.radius[i], bodies.radius[i], [&](const StepShapes::Overlap& overlap) {
      const double force = stiffness_ * overlap.depth;
      const Vec2<double> felt = force * overlap.normal;
      contacts_.push_back({i, first_obstacle - overlap.shape, {felt[0], felt[1]}});
      tally.add_to_shapes(-lasting() * felt, bodies.shapes->is_rim(overlap.shape) ? lasting() * force : 0.0);
    });
  }

  /// Counts the contacts of the last step that are none in this one. Both lists are in order: pairs, then walls.
  void count_ended(const Bodies& bodies, Tally& tally) const {
    auto now = contacts_.begin();
    for (const Contact& contact : before_) {
      while (now != contacts_.end() && comes_before(*now, contact)) ++now;
      if (now != contacts_.end() && now->i == contact.i && now->j == contact.j) continue;
      if (contact.j <= first_obstacle) {
        tally.shape(contact.i, first_obstacle - contact.j, Vec2<double>::Zero(), 0.0, bodies.v[contact.i]);
      } else if (contact.j < 0) {
        tally.wall(contact.i, static_cast<Wall>(contact.j), 0.0, 0.0, bodies.v[contact.i]);
      } else {
        const auto j = static_cast<std::size_t>(contact.j);
        tally.pair(contact.i, j, 0.0, 0.0, bodies.v[contact.i], bodies.v[j]);
      }
    }
  }
  [[nodiscard]] static bool comes_before(const Contact& a, const Contact& b) {
    if ((a.j < 0) != (b.j < 0)) return b.j < 0;
    if (a.i != b.i) return a.i < b.i;
    return a.j < 0 ? a.j > b.j : a.j < b.j;  // walls are found in falling order of their numbers
  }

  double dt_;
  double stiffness_;  ///< k
  double damping_;    ///< gamma / sqrt(k mu) of two disks
  double wall_damping_[4];
  Pairs pairs_;
  double span_ = 0.0;              ///< how long the last flight took
  std::vector<Contact> contacts_;  ///< at the last step
  std::vector<Contact> before_;    ///< at the one before, while contacts are sought
};

}  // namespace carom
