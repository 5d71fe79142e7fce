#pragma once
// Lees-Edwards boundaries (Lees & Edwards, J. Phys. C 5, 1921 (1972)): a flow v_x = rate y without walls. The images above slide
// past those below: by `displacement` to the right, at the speed rate times the height of the box. A disk that leaves upwards
// comes back from below, by so much farther left and slower.

#include "core/vec2.hpp"

#include <carom/box.hpp>
#include <carom/effects.hpp>

#include <cmath>
#include <cstdint>
#include <optional>

namespace carom {

/// The images above and below a sheared box.
template <class Real>
class LeesEdwards {
 public:
  LeesEdwards(const Box& box, const std::optional<Shear>& shear, double displacement)
      : present_(acts(shear)),
        rate_(shear ? Real(shear->rate) : Real(0)),
        speed_(rate_ * Real(box.lengths()[1])),
        length_(Real(box.lengths()[0])),
        middle_(Real((box.lower[1] + box.upper[1]) / 2.0)),
        displacement_(Real(displacement)) {}

  /// Returns whether images slide: the table is there, and its rate is not 0.
  [[nodiscard]] static bool acts(const std::optional<Shear>& shear) { return shear && shear->rate != 0.0; }
  [[nodiscard]] bool present() const { return present_; }
  /// Returns the speed of the images one box height above; length / time.
  [[nodiscard]] Real speed() const { return speed_; }
  [[nodiscard]] Real displacement(Real t) const { return displacement_ + speed_ * t; }
  /// Returns the whole box lengths in the displacement at time t. They shift no image: a disk that leaves upwards comes back
  /// farther left by the rest.
  [[nodiscard]] std::int64_t whole_lengths(Real t) const {
    using std::floor;
    return static_cast<std::int64_t>(floor(displacement(t) / length_));
  }
  /// Returns the velocity of the flow along x at height y.
  [[nodiscard]] Real flow(Real y) const { return rate_ * (y - middle_); }

  /// Returns the displacement at time t without whole box lengths, in [0, length).
  [[nodiscard]] Real reduced(Real t) const {
    using std::floor;
    const Real all = displacement(t), rest = all - length_ * floor(all / length_);
    return rest < length_ ? rest : Real(0);
  }

  /// The clock's zero moves to `now`.
  void rebase(Real now) { displacement_ = reduced(now); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(displacement_);
  }

 private:
  bool present_;
  Real rate_;
  Real speed_;
  Real length_;
  Real middle_;
  Real displacement_;  ///< at the clock's zero, in [0, length)
};

}  // namespace carom
