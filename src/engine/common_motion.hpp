#pragma once
// The common motion of disks that lose energy. Collisions keep momentum but for rounding, and what rounding leaves of it does not
// cool: in a gas that was to be at rest as a whole, disks would in the end move together 1e-16 as fast as they once moved against
// each other, and ever slower against each other. So what it leaves is given back.

#include "core/vec2.hpp"
#include "effects/plain_world.hpp"

#include <carom/box.hpp>

#include <algorithm>
#include <cmath>

namespace carom {

template <class Real>
class CommonMotion {
 public:
  CommonMotion(const Box& box, const Effects& effects) {
    const bool sheared = effects.shear_rate() != 0.0;
    for (int axis = 0; axis < 2; ++axis)
      kept_[axis] = effects.dissipate() && !sheared && !centre_of_mass_is_thermal(box, effects, axis);
  }

  /// Whether momentum along any axis is to be kept.
  [[nodiscard]] bool present() const { return kept_[0] || kept_[1]; }

  /// Begins with disks of momenta momentum(disk). Along axes on which they move together, their common motion is left to them.
  template <class Disks, class MomentumOf>
  void begin(const Disks& disks, MomentumOf&& momentum) {
    const Sums sums = sums_of(disks, momentum);
    for (int axis = 0; axis < 2; ++axis) kept_[axis] = kept_[axis] && !exceeds(sums, axis);
  }

  /// Returns minus the total momentum along each conserved axis on which it exceeds the bound of rounding; else 0.
  template <class Disks, class MomentumOf>
  [[nodiscard]] Vec2<Real> momentum_correction(const Disks& disks, MomentumOf&& momentum) const {
    const Sums sums = sums_of(disks, momentum);
    Vec2<Real> correction = Vec2<Real>::Zero();
    for (int axis = 0; axis < 2; ++axis)
      if (kept_[axis] && exceeds(sums, axis)) correction[axis] = -sums.momentum[axis];
    return correction;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(kept_[0], kept_[1]);
  }

 private:
  /// Sums of momenta, and of their absolute values.
  struct Sums {
    Vec2<Real> momentum = Vec2<Real>::Zero();
    Real sizes = 0;
  };

  template <class Disks, class MomentumOf>
  static Sums sums_of(const Disks& disks, MomentumOf&& momentum) {
    Sums sums;
    for (const auto& disk : disks) {
      const Vec2<Real> one = momentum(disk);
      sums.momentum += one;
      sums.sizes += one.cwiseAbs().sum();
    }
    return sums;
  }

  /// Some thousand times what rounding leaves when disks move as fast as they do now, and far from what would be seen. Starts are
  /// rounded to doubles.
  static bool exceeds(const Sums& sums, int axis) {
    using std::abs;
    return abs(sums.momentum[axis]) > 8192 * std::max<Real>(epsilon<Real>, Real(0x1p-52)) * sums.sizes;
  }

  bool kept_[2];
};

}  // namespace carom
