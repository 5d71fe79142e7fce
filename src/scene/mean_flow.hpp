#pragma once
// The flow that the disks of a scene are in.

#include <carom/box.hpp>
#include <carom/effects.hpp>

namespace carom::detail {

/// The mean flow v_x = rate (y - middle), relative to which velocities are drawn and count as heat. Most scenes have none.
class MeanFlow {
 public:
  MeanFlow(const Box& box, const Effects& effects)
      : rate_(effects.shear_rate()), middle_(0.5 * (box.lower.y() + box.upper.y())) {}

  /// Returns whether there is a flow: heat then depends on where disks are.
  [[nodiscard]] bool present() const { return rate_ != 0.0; }

  /// Returns the velocity of the flow along x at height y.
  [[nodiscard]] double at(double y) const { return rate_ * (y - middle_); }

 private:
  double rate_;
  double middle_;
};

}  // namespace carom::detail
