#pragma once
// The scale of radii that grow at a constant rate.

#include "core/instant.hpp"

namespace carom {

struct GrowingScale {
  Instant start{};        ///< the time since which disks grow
  double at_start = 1.0;  ///< the scale at that time
  double rate = 0.0;      ///< 1 / time

  /// Returns the scale at a time.
  [[nodiscard]] double at(const Instant& time) const {
    return at_start + rate * (time < forever ? time.plus(-start.high).plus(-start.low) : forever).high;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(start, at_start, rate);
  }
};

}  // namespace carom
