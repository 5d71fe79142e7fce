#pragma once
// The four sides of the box, each by itself: hard, inelastic, diffuse at a temperature (and perhaps sliding along itself), moving
// at constant speed, vibrating with or without amplitude, or a free piston under a load. Where nothing is asked of a side, the
// component of the velocity across it is reversed when the disk's edge reaches it.
//
// A side is like a disk of infinite width: a displacement, a velocity and an acceleration since a time of its own. Speeds
// here are outward ones, positive towards the left at the left wall, so that all four sides are treated alike.

#include "core/fall_time.hpp"
#include "core/random.hpp"
#include "core/sides.hpp"
#include "core/simulation_box.hpp"
#include "effects/maxwell.hpp"
#include "effects/oscillation.hpp"
#include "effects/rebound.hpp"
#include "effects/vanishing.hpp"

#include <carom/effects.hpp>
#include <carom/state.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom {

template <class Real>
class Walls {
 public:
  Walls(const Box& box, const std::array<WallProperties, 4>& properties, std::uint64_t seed) : box_(box), seed_(seed) {
    for (std::size_t k = 0; k < 4; ++k) {
      const auto wall = static_cast<Wall>(-1 - static_cast<int>(k));
      const WallProperties& asked = properties[k];
      Side& side = sides_[k];
      side.restitution = Real(asked.restitution.value_or(1.0));
      side.temperature = asked.temperature.value_or(0.0);
      side.sliding = Real(asked.tangential_velocity.value_or(0.0));
      side.vibration = Real(asked.vibration.value_or(0.0));
      side.oscillation = OscillatingSide<Real>(asked.oscillation);
      side.velocity = Real(asked.velocity.value_or(0.0)) * (is_upper(wall) ? 1 : -1);
      side.mass = Real(asked.mass.value_or(0.0));
      if (asked.mass) side.acceleration = -Real(asked.load.value_or(0.0) * box.lengths()[1 - axis_of(wall)] / *asked.mass);
    }
  }

  /// Returns the time from which the motion of the side is known: contact is predicted from there, or from where the disk's own
  /// flight is known.
  [[nodiscard]] Real since(Wall wall) const { return side(wall).t; }

  /// Returns the time a disk takes to reach the side, from time t >= since(wall). `room`: from the disk's edge to where the side
  /// of the box was at the start, `outward` and `acceleration`: the disk's, `expansion`: of its radius, all at t. Infinite for
  /// never, and perhaps where it takes longer than `until`, on which the bits of the time do not depend.
  [[nodiscard]] Real contact(Wall wall, Real room, Real outward, Real acceleration, Real expansion, Real t,
                             Real until = infinity<Real>) const {
    const Side& s = side(wall);
    if (s.oscillation.present()) return s.oscillation.contact(room, -outward - expansion, -acceleration, t, until);
    return fall_time<Real>(room + s.displacement_at(t), (s.velocity_at(t) - outward) - expansion, s.acceleration - acceleration);
  }

  /// Returns whether a disk that moves like that at time t >= since(wall) never comes nearer to the side: contact() is infinite
  /// then.
  [[nodiscard]] bool recedes(Wall wall, Real outward, Real acceleration, Real expansion, Real t) const {
    const Side& s = side(wall);
    if (s.oscillation.present()) return false;
    return (s.velocity_at(t) - outward) - expansion >= 0 && s.acceleration >= acceleration;
  }

  /// The result of a contact.
  struct Hit {
    Real impulse = 0;  ///< that the side took, outward
    Real shear = 0;    ///< momentum that the side took along itself, towards +x or +y
    Real energy = 0;   ///< that the side took from the disk
    Real work = 0;     ///< what of that energy is work: the force on the side times its velocity; the rest is heat
    /// The speed of which it took its share (effects/vanishing.hpp); infinite where it took none, and where the disk is pressed
    /// against it, so that contacts never end.
    Real smallness = infinity<Real>;
    /// How long a disk that its weight presses to the side, and that leaves it with no speed (rebound()), may take to fall what
    /// rounding has left between them: 2^-40 of its radius. 0 for other disks.
    Real rest = 0;
  };

  /// The disk hits the side at time t: changes its velocity, and a piston's. `g` is the acceleration of the disk, `elastic`
  /// whether it may lose nothing (TC model).
  Hit meet(Wall wall, Vec2<Real>& v, const Vec2<Real>& g, Real mass, Real radius, Real expansion, bool elastic, Real t) {
    Side& s = side(wall);
    const int axis = axis_of(wall);
    const Real sign = is_upper(wall) ? 1 : -1;
    const Real outward = sign * v[axis];
    // A wall that vibrates hits a disk on its way in, wherever it stands.
    const Real surface = s.velocity_at(t) - s.vibration;
    const Real before = v.squaredNorm();
    using std::max;
    const Real closing = max<Real>((outward + expansion) - surface, 0);
    Real after;
    Real small = infinity<Real>, shear = 0, rest = 0, motion = surface;
    if (s.temperature > 0) {
      RandomStream random(seed_, Stream::thermal_walls, 4 * draws_++ + index_of(wall));
      const DiffuseVelocity drawn = diffuse_velocity(random, s.temperature, static_cast<double>(mass));
      after = (surface - expansion) - Real(drawn.inward);
      const Real along = v[1 - axis];
      v[1 - axis] = Real(drawn.along) + s.sliding;
      shear = mass * (along - v[1 - axis]);
    } else {
      const Real restitution = elastic ? Real(1) : s.restitution, pressing = sign * g[axis] - s.acceleration_at(t);
      const Real parting = rebound<Real>(closing, restitution, pressing, radius);
      if (restitution < 1 && closing > 0 && !(pressing > 0)) small = smallness<Real>(closing, radius);
      using std::sqrt;
      if (restitution < 1 && pressing > 0 && parting == 0 && s.vibration == 0) rest = sqrt(Real(0x1p-39) * radius / pressing);
      after = (surface - expansion) - parting;
      if (s.mass > 0) {
        // Shares of the change of the relative velocity, by mass.
        const Real change = closing + parting;
        after = outward - change * (s.mass / (mass + s.mass));
        s.displacement = s.displacement_at(t);
        s.velocity = surface + change * (mass / (mass + s.mass));
        s.t = t;
        motion = (surface + s.velocity) / 2;  // its impulse times this is the energy of motion that the piston gains
      }
    }
    v[axis] = sign * after;
    const Real impulse = mass * (outward - after);
    return {impulse, shear, mass * (before - v.squaredNorm()) / 2, impulse * motion + shear * s.sliding, small, rest};
  }

  /// Lets a disk that has left the side with no speed but that of its growing surface recede from it, where `expansion` is that
  /// with which contacts are planned: they may differ by an ulp, and it would meet the side again and again at one instant.
  void let_recede(Wall wall, Vec2<Real>& v, Real expansion, Real t) const {
    const int axis = axis_of(wall);
    const Real sign = is_upper(wall) ? 1 : -1, surface = side(wall).velocity_at(t);
    if ((surface - sign * v[axis]) - expansion < 0) v[axis] = sign * (surface - expansion);
  }

  /// Returns whether the side moves by itself after a contact, which makes all predictions with it void.
  [[nodiscard]] bool is_piston(Wall wall) const { return side(wall).mass > 0; }
  [[nodiscard]] bool any_moves() const {
    return std::any_of(sides_.begin(), sides_.end(),
                       [](const Side& s) { return s.velocity != 0 || s.mass > 0 || s.oscillation.present(); });
  }
  /// Returns whether any side is not where the box has it.
  [[nodiscard]] bool any_moved() const {
    return std::any_of(sides_.begin(), sides_.end(), [](const Side& s) { return s.displacement != 0; });
  }
  /// The fastest that any of the sides moves at time t, or in any of its periods.
  [[nodiscard]] Real fastest(Real t) const {
    Real most = 0;
    for (const Side& s : sides_) most = std::max<Real>(most, s.fastest(t));
    return most;
  }

  /// The strongest acceleration of any of the sides that can go far by it.
  [[nodiscard]] Real strongest() const {
    using std::abs;
    Real most = 0;
    for (const Side& s : sides_) most = std::max<Real>(most, abs(s.acceleration));
    return most;
  }

  /// Returns the distance by which a side has moved outward at time t.
  [[nodiscard]] Real displacement(Wall wall, Real t) const { return side(wall).displacement_at(t); }

  /// The clock's zero moves to `now`.
  void rebase(Real now) {
    for (Side& s : sides_) {
      if (s.oscillation.present()) {
        s.oscillation.rebase(now);
        continue;
      }
      const Real displacement = s.displacement_at(now), velocity = s.velocity_at(now);
      s.displacement = displacement;
      s.velocity = velocity;
      s.t = 0;
    }
  }

  /// Continues from a state, at time 0.
  void start_from(const std::vector<WallState>& walls) {
    for (std::size_t k = 0; k < std::min<std::size_t>(walls.size(), 4); ++k) {
      const auto wall = static_cast<Wall>(-1 - static_cast<int>(k));
      const double sign = is_upper(wall) ? 1.0 : -1.0;
      const double edge = is_upper(wall) ? box_.upper[axis_of(wall)] : box_.lower[axis_of(wall)];
      sides_[k].displacement = Real(sign * (walls[k].position - edge));
      if (sides_[k].oscillation.present()) {
        sides_[k].oscillation.place(sides_[k].displacement);
        continue;
      }
      sides_[k].velocity = Real(sign * walls[k].velocity);
    }
  }

  /// Random numbers that diffuse walls have drawn so far.
  [[nodiscard]] std::uint64_t draws() const { return draws_; }
  /// Goes on with the stream behind the first `draws` numbers.
  void go_on_drawing(std::uint64_t draws) { draws_ = draws; }

  /// Returns how long each side has vibrated at time t.
  [[nodiscard]] std::array<OscillationClock, 4> oscillation_clocks(Real t) const {
    std::array<OscillationClock, 4> clocks;
    for (std::size_t k = 0; k < 4; ++k)
      if (sides_[k].oscillation.present()) clocks[k] = sides_[k].oscillation.clock_at(t);
    return clocks;
  }
  /// Goes on with the vibrations of another engine, at the clock's zero. Returns whether any side does: plans made before are
  /// void then.
  bool go_on_oscillating(const std::array<OscillationClock, 4>& before) {
    bool any = false;
    for (std::size_t k = 0; k < 4; ++k) any = sides_[k].oscillation.go_on(before[k]) || any;
    return any;
  }

  /// Left, right, bottom, top at time t; empty where none moves.
  [[nodiscard]] std::vector<WallState> states(Real t) const {
    std::vector<WallState> walls;
    if (!any_moves()) return walls;
    for (const Wall wall : {wall_left, wall_right, wall_bottom, wall_top}) {
      const double sign = is_upper(wall) ? 1.0 : -1.0;
      const double edge = is_upper(wall) ? box_.upper[axis_of(wall)] : box_.lower[axis_of(wall)];
      walls.push_back({edge + sign * static_cast<double>(side(wall).displacement_at(t)),
                       sign * static_cast<double>(side(wall).velocity_at(t)) + 0.0});
    }
    return walls;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(sides_, draws_);
  }

 private:
  struct Side {
    Real displacement = 0;  ///< outward, at time t
    Real velocity = 0;      ///< outward, at time t
    Real acceleration = 0;  ///< outward: a load's is negative
    Real t = 0;
    Real restitution = 1;
    Real mass = 0;                      ///< of a piston; 0: no contact moves the side
    Real sliding = 0;                   ///< velocity along itself, towards +x or +y
    Real vibration = 0;                 ///< inward speed with which it hits disks, beside its velocity
    double temperature = 0.0;           ///< 0: not diffuse
    OscillatingSide<Real> oscillation;  ///< takes the place of the motion above

    [[nodiscard]] Real displacement_at(Real when) const {
      if (oscillation.present()) return oscillation.displacement(when);
      const Real dt = when - t;
      return displacement + (velocity * dt + (acceleration * dt) * (dt / 2));
    }
    [[nodiscard]] Real velocity_at(Real when) const {
      return oscillation.present() ? oscillation.velocity(when) : velocity + acceleration * (when - t);
    }
    /// Returns the fastest that the side moves at that time, or in any of its periods.
    [[nodiscard]] Real fastest(Real when) const {
      using std::abs;
      return oscillation.present() ? oscillation.fastest() : abs(velocity_at(when));
    }
    [[nodiscard]] Real acceleration_at(Real when) const {
      return oscillation.present() ? oscillation.acceleration(when) : acceleration;
    }

    template <class Archive>
    void serialize(Archive& archive) {
      archive(displacement, velocity, t, oscillation);
    }
  };

  [[nodiscard]] Side& side(Wall wall) { return sides_[index_of(wall)]; }
  [[nodiscard]] const Side& side(Wall wall) const { return sides_[index_of(wall)]; }

  Box box_;
  std::array<Side, 4> sides_;
  std::uint64_t seed_;
  std::uint64_t draws_ = 0;  ///< from diffuse walls so far
};

}  // namespace carom
