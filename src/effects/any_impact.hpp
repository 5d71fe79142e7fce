#pragma once
// What happens when two disks meet, with everything that a scene may ask of it: either rule, restitution, roughness with spin,
// the TC model, growing disks, stepped potentials. It holds what the loop's records do not: spins, when each disk last collided,
// and in which step of the potential each pair is.

#include "core/running_totals.hpp"
#include "effects/drag.hpp"
#include "effects/impact.hpp"
#include "effects/reversal.hpp"
#include "effects/rough.hpp"
#include "effects/specular.hpp"
#include "effects/stepped_potential.hpp"

#include <carom/collision_rule.hpp>
#include <carom/effects.hpp>
#include <carom/state.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace carom {

template <class Real>
class AnyImpact {
 public:
  static constexpr bool plain = false;

  AnyImpact(const Effects& effects, std::size_t disks)
      : rule_(effects.collision.rule),
        reflected_fraction_((1 + Real(effects.collision.restitution.value_or(1.0))) / 2),
        roughness_(Real(effects.collision.roughness.value_or(-1.0))),
        elastic_below_(Real(effects.collision.elastic_below.value_or(0.0))),
        spins_(effects.collision.roughness ? disks : 0, Real(0)),
        last_(elastic_below_ > 0 && effects.dissipate() ? disks : 0, -infinity<Real>),
        potential_(effects, disks),
        by_rule_alone_(is_plain()),
        sheared_(effects.shear_rate() != 0.0),
        drag_(effects.drag_rate()) {}

  /// The impact of disks in so many slots of their own.
  [[nodiscard]] AnyImpact with_slots(std::size_t slots) const {
    AnyImpact part = *this;
    part.spins_.assign(spins_.empty() ? 0 : slots, Real(0));
    part.last_.assign(last_.empty() ? 0 : slots, -infinity<Real>);
    part.potential_ = potential_.with_slots(slots);
    return part;
  }
  /// What it knows of one disk, but for its pairs in steps of the potential.
  struct DiskRest {
    Real spin = 0;
    Real last = -infinity<Real>;

    bool operator==(const DiskRest&) const = default;
  };
  [[nodiscard]] DiskRest rest_of(std::int32_t i) const {
    const auto at = static_cast<std::size_t>(i);
    return {spins_.empty() ? Real(0) : spins_[at], last_.empty() ? -infinity<Real> : last_[at]};
  }
  void set_rest(std::int32_t i, const DiskRest& rest) {
    const auto at = static_cast<std::size_t>(i);
    if (!spins_.empty()) spins_[at] = rest.spin;
    if (!last_.empty()) last_[at] = rest.last;
  }

  /// A disk as it takes part in a collision.
  struct Body {
    std::int32_t disk;
    Real mass;
    Real radius;
    Vec2<Real>& v;
  };

  /// Disks i and j meet at separation r = r_i - r_j at time `now`, at their hard cores or at an edge of the potential. `sigma`:
  /// their contact distance; `expansion`: its rate. Changes velocities and keeps count. Returns InelasticResult::smallness.
  Real meet(const Vec2<Real>& r, Real sigma, Real expansion, const Body& i, const Body& j, Real now, RunningTotals& totals) {
    const Real before = i.v.x(), drag_factor = drag_.at(now);
    InelasticResult<Real> impact;
    if (potential_.present() && potential_.at_edge(r, sigma)) {
      ++totals.well;
      impact = {potential_.cross_edge(i.disk, j.disk, r, sigma, i.mass, i.v, j.mass, j.v)};
    } else {
      if (has_correction_) apply_correction(i, j);
      impact = by_rule_alone_ && expansion == 0 ? InelasticResult<Real>{collide(r, i, j)} : collide(r, expansion, i, j, now);
      ++totals.pair;
      if (impact.lost != 0) totals.dissipated.add(static_cast<double>(drag_factor * drag_factor * impact.lost));
      if (expansion > 0) totals.growth_energy.add(static_cast<double>(impact.energy + impact.lost));
    }
    totals.virial.add(static_cast<double>(drag_factor * impact.virial));
    if (sheared_) totals.virial_yx.add(static_cast<double>(r.y() * i.mass * (i.v.x() - before)));
    return impact.smallness;
  }

  /// A program's own rule takes the place of the scene's; an empty one brings that back. `ids`: what the world calls the disks,
  /// by the numbers of bodies; null where these are the same.
  void set_rule(CollisionFunction rule, const std::int32_t* ids) {
    own_rule_ = std::move(rule);
    ids_ = ids;
    by_rule_alone_ = is_plain();
  }

  /// Sets the momentum that the next two colliding disks get in addition (engine/common_motion.hpp).
  void set_momentum_correction(const Vec2<Real>& momentum) {
    momentum_correction_ = momentum;
    has_correction_ = momentum_correction_[0] != 0 || momentum_correction_[1] != 0;
  }

  /// Returns whether the TC model makes a contact of disk i elastic: its last was less than `elastic_below` ago (Luding &
  /// McNamara 1998).
  [[nodiscard]] bool is_elastic(std::int32_t i, Real now) const {
    return !last_.empty() && now - last_[static_cast<std::size_t>(i)] < elastic_below_;
  }
  void record_collision_time(std::int32_t i, Real now) {
    if (!last_.empty()) last_[static_cast<std::size_t>(i)] = now;
  }

  /// The clock's zero moves to `now`.
  void rebase(Real now) {
    for (Real& t : last_) t -= now;
    drag_.rebase(now);
  }

  /// Returns the ratio of true velocities to those that the engine computes with.
  [[nodiscard]] Real drag_factor(Real now) const { return drag_.at(now); }

  [[nodiscard]] bool spinning() const { return !spins_.empty(); }
  [[nodiscard]] Real& spin(std::int32_t i) { return spins_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] Real spin(std::int32_t i) const { return spins_[static_cast<std::size_t>(i)]; }

  [[nodiscard]] PairPotential<Real>& potential() { return potential_; }
  [[nodiscard]] const PairPotential<Real>& potential() const { return potential_; }

  [[nodiscard]] std::size_t bytes() const { return (spins_.capacity() + last_.capacity()) * sizeof(Real) + potential_.bytes(); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(spins_, last_, potential_, momentum_correction_, has_correction_, drag_);
  }

 private:
  /// A share of the relative velocity, for rounding in a program's own rule.
  static constexpr double least_parting = 1e-9;

  ImpactResult<Real> collide(const Vec2<Real>& r, const Body& i, const Body& j) const {
    return rule_ == CollisionRule::reversal ? carom::collide<Reversal, Real>(r, i.mass, i.v, j.mass, j.v)
                                            : carom::collide<Specular, Real>(r, i.mass, i.v, j.mass, j.v);
  }
  InelasticResult<Real> collide(const Vec2<Real>& r, Real expansion, const Body& i, const Body& j, Real now) {
    if (own_rule_) return collide_by_own_rule(r, i, j);
    const bool elastic = is_elastic(i.disk, now) || is_elastic(j.disk, now);
    const Inelasticity<Real> how{elastic ? Real(1) : reflected_fraction_, expansion};
    InelasticResult<Real> result = rule_ == CollisionRule::reversal
                                       ? carom::collide<Reversal, Real>(r, i.mass, i.v, j.mass, j.v, how)
                                       : carom::collide<Specular, Real>(r, i.mass, i.v, j.mass, j.v, how);
    if (!spins_.empty() && roughness_ != -1 && (roughness_ == 1 || !elastic)) {
      const Real gained = roughen(r, roughness_, i.mass, i.radius, i.v, spin(i.disk), j.mass, j.radius, j.v, spin(j.disk));
      result.energy += gained;
      result.lost -= gained;
    }
    record_collision_time(i.disk, now);
    record_collision_time(j.disk, now);
    return result;
  }

  [[nodiscard]] bool is_plain() const { return reflected_fraction_ == 1 && roughness_ == -1 && last_.empty() && !own_rule_; }

  [[nodiscard]] std::int32_t id(const Body& body) const { return ids_ == nullptr ? body.disk : ids_[body.disk]; }

  [[gnu::noinline, gnu::cold]] InelasticResult<Real> collide_by_own_rule(const Vec2<Real>& r, const Body& i, const Body& j) {
    if (!(r.dot(i.v - j.v) < 0)) return {};  // they recede already, by rounding
    const bool swapped = id(j) < id(i);
    const Body &a = swapped ? j : i, &b = swapped ? i : j;
    const Vec2<double> towards = (swapped ? -r : r).template cast<double>();
    CollidingPair contact{.disk = id(a),
                          .partner = id(b),
                          .mass = static_cast<double>(a.mass),
                          .partner_mass = static_cast<double>(b.mass),
                          .radius = static_cast<double>(a.radius),
                          .partner_radius = static_cast<double>(b.radius),
                          .normal = towards / towards.norm(),
                          .velocity = a.v.template cast<double>(),
                          .partner_velocity = b.v.template cast<double>()};
    const Eigen::Vector2d normal = contact.normal;
    own_rule_(contact);
    const Vec2<Real> v_a = contact.velocity.template cast<Real>(), v_b = contact.partner_velocity.template cast<Real>();
    if (!v_a.allFinite() || !v_b.allFinite()) refuse(a, b, "gives velocities that are not finite to");
    if (!(std::max(contact.velocity.norm(), contact.partner_velocity.norm()) < fastest_by_rule))
      refuse(a, b, "gives velocities that are too large to compute with to");
    const Eigen::Vector2d apart = contact.velocity - contact.partner_velocity;
    if (normal.dot(apart) < -least_parting * apart.norm()) refuse(a, b, "leaves approaching each other");

    const auto energy = [&] { return (a.mass * a.v.squaredNorm() + b.mass * b.v.squaredNorm()) / 2; };
    const Real before = energy();
    const Vec2<Real> impulse = a.mass * (v_a - a.v) - b.mass * (v_b - b.v);  // twice, where momentum is kept
    a.v = v_a;
    b.v = v_b;
    if (r.dot(i.v - j.v) < 0) detail::recede<Real>(r, i.mass, i.v, j.mass, j.v);
    InelasticResult<Real> result;
    result.virial = (swapped ? -r : r).dot(impulse) / 2;
    result.energy = energy() - before;
    result.lost = -result.energy;
    return result;
  }

  /// With lengths of up to 1e10, squares of what follows from a velocity are still numbers.
  static constexpr double fastest_by_rule = 1e140;

  [[noreturn]] void refuse(const Body& a, const Body& b, const char* what) const {
    throw std::domain_error("the collision rule " + std::string(what) + " disks " + std::to_string(id(a)) + " and " +
                            std::to_string(id(b)));
  }

  /// Gives both disks the same change of velocity, so that their relative velocity stays.
  [[gnu::noinline, gnu::cold]] void apply_correction(const Body& i, const Body& j) {
    const Vec2<Real> each = momentum_correction_ / (i.mass + j.mass);
    i.v += each;
    j.v += each;
    set_momentum_correction(Vec2<Real>::Zero());
  }

  CollisionRule rule_;
  Real reflected_fraction_;  ///< (1 + e) / 2
  Real roughness_;
  Real elastic_below_;
  std::vector<Real> spins_;
  std::vector<Real> last_;  ///< collision of each disk, since the clock's zero
  PairPotential<Real> potential_;
  Vec2<Real> momentum_correction_ = Vec2<Real>::Zero();  ///< momentum
  bool has_correction_ = false;
  CollisionFunction own_rule_;  ///< of the program
  const std::int32_t* ids_ = nullptr;
  bool by_rule_alone_;  ///< at a hard core
  bool sheared_;
  DragFactor<Real> drag_;
};

}  // namespace carom
