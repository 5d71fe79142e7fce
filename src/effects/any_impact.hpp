#pragma once
// What happens when two disks meet, with everything that a scene may ask of it: either rule, restitution, roughness with spin,
// the TC model, growing disks, wells. It holds what the loop's records do not: spins, when each disk last collided, and who is
// inside whose well.

#include "effects/impact.hpp"
#include "effects/reversal.hpp"
#include "effects/rough.hpp"
#include "effects/specular.hpp"
#include "effects/square_well.hpp"

#include <carom/effects.hpp>
#include <carom/state.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom {

template <class Real>
class AnyImpact {
 public:
  static constexpr bool plain = false;

  AnyImpact(const Effects& effects, std::size_t disks)
      : rule_(effects.collision.rule),
        turn_((1 + Real(effects.collision.restitution.value_or(1.0))) / 2),
        roughness_(Real(effects.collision.roughness.value_or(-1.0))),
        elastic_below_(Real(effects.collision.elastic_below.value_or(0.0))),
        spins_(effects.collision.roughness ? disks : 0, Real(0)),
        last_(elastic_below_ > 0 && effects.dissipate() ? disks : 0, -infinity<Real>),
        wells_(effects.square_well, disks),
        by_rule_alone_(turn_ == 1 && roughness_ == -1 && last_.empty()) {}

  /// A disk as it takes part in a collision.
  struct Body {
    std::int32_t disk;
    Real mass;
    Real radius;
    Vec2<Real>& v;
  };

  /// Disks i and j meet at separation r = r_i - r_j at time `now`, at their hard cores or at the edge of their well. `growth`: of
  /// their contact distance. Changes velocities and keeps count.
  void meet(const Vec2<Real>& r, Real growth, const Body& i, const Body& j, Real now, Totals& totals) {
    const Real before = i.v.x();
    ImpactResult<Real> impact;
    if (wells_.present() && wells_.at_edge(r, i.radius + j.radius)) {
      ++totals.well;
      impact = wells_.cross_edge(i.disk, j.disk, r, i.mass, i.v, j.mass, j.v);
    } else {
      ++totals.pair;
      impact = by_rule_alone_ && growth == 0 ? collide(r, i, j) : collide(r, growth, i, j, now);
      (growth > 0 ? totals.growth_energy : totals.dissipated) += (growth > 0 ? 1 : -1) * static_cast<double>(impact.energy);
    }
    totals.virial += static_cast<double>(impact.virial);
    totals.virial_yx += static_cast<double>(r.y() * i.mass * (i.v.x() - before));
  }

  /// TC model (Luding & McNamara 1998): a disk that collided less than `elastic_below` ago loses nothing.
  [[nodiscard]] bool rests(std::int32_t i, Real now) const {
    return !last_.empty() && now - last_[static_cast<std::size_t>(i)] < elastic_below_;
  }
  void touched(std::int32_t i, Real now) {
    if (!last_.empty()) last_[static_cast<std::size_t>(i)] = now;
  }

  /// The clock's zero moves to `now`.
  void rebase(Real now) {
    for (Real& t : last_) t -= now;
  }

  [[nodiscard]] bool spinning() const { return !spins_.empty(); }
  [[nodiscard]] Real& spin(std::int32_t i) { return spins_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] Real spin(std::int32_t i) const { return spins_[static_cast<std::size_t>(i)]; }

  [[nodiscard]] SquareWells<Real>& wells() { return wells_; }
  [[nodiscard]] const SquareWells<Real>& wells() const { return wells_; }

  [[nodiscard]] std::size_t bytes() const { return (spins_.capacity() + last_.capacity()) * sizeof(Real) + wells_.bytes(); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(spins_, last_, wells_);
  }

 private:
  ImpactResult<Real> collide(const Vec2<Real>& r, const Body& i, const Body& j) const {
    return rule_ == CollisionRule::reversal ? carom::collide<Reversal, Real>(r, i.mass, i.v, j.mass, j.v)
                                            : carom::collide<Specular, Real>(r, i.mass, i.v, j.mass, j.v);
  }
  ImpactResult<Real> collide(const Vec2<Real>& r, Real growth, const Body& i, const Body& j, Real now) {
    const bool elastic = rests(i.disk, now) || rests(j.disk, now);
    const Inelasticity<Real> how{elastic ? Real(1) : turn_, growth};
    ImpactResult<Real> result = rule_ == CollisionRule::reversal
                                    ? carom::collide<Reversal, Real>(r, i.mass, i.v, j.mass, j.v, how)
                                    : carom::collide<Specular, Real>(r, i.mass, i.v, j.mass, j.v, how);
    if (!spins_.empty() && roughness_ != -1 && (roughness_ == 1 || !elastic))
      result.energy += roughen(r, roughness_, i.mass, i.radius, i.v, spin(i.disk), j.mass, j.radius, j.v, spin(j.disk));
    touched(i.disk, now);
    touched(j.disk, now);
    return result;
  }

  CollisionRule rule_;
  Real turn_;  ///< (1 + e) / 2
  Real roughness_;
  Real elastic_below_;
  std::vector<Real> spins_;
  std::vector<Real> last_;  ///< collision of each disk, since the clock's zero
  SquareWells<Real> wells_;
  bool by_rule_alone_;  ///< at a hard core
};

}  // namespace carom
