#pragma once
// Brownian dynamics of hard disks by events (Scala, Voigtmann & De Michele, J. Chem. Phys. 126, 134109 (2007)): at equal steps dt
// all disks together redraw their velocities from the Maxwell distribution; in between they fly and
// collide. Over times much longer than dt a free disk diffuses with D = kT dt / (2 m).
//
// Redraw number n draws everything from a stream of its own, disk after disk.

#include "core/random.hpp"
#include "effects/maxwell.hpp"

#include <carom/effects.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <optional>

namespace carom {

/// Redraws of all velocities at equal steps.
class BrownianRedraws {
 public:
  BrownianRedraws(const std::optional<Brownian>& brownian, std::uint64_t seed)
      : temperature_(brownian ? brownian->temperature : 0.0), rate_(brownian ? brownian->rate : 0.0), seed_(seed) {}

  /// Neutral at rate 0.
  [[nodiscard]] bool acts() const { return rate_ > 0.0; }
  /// Returns how often all velocities are redrawn; 1 / time.
  [[nodiscard]] double rate() const { return rate_; }
  /// Returns the time from one redraw to the next. Requires acts().
  [[nodiscard]] double step() const { return 1.0 / rate_; }

  /// Returns the random numbers of redraw number n, from 0.
  [[nodiscard]] RandomStream stream(std::uint64_t n) const { return RandomStream(seed_, Stream::brownian, n); }

  [[nodiscard]] Eigen::Vector2d velocity(const Normals& normals, double mass) const {
    return maxwell_velocity(normals, temperature_, mass);
  }
  [[nodiscard]] double spin(const Normals& normals, double moment_of_inertia) const {
    return maxwell_spin(normals, temperature_, moment_of_inertia);
  }

 private:
  double temperature_;
  double rate_;
  std::uint64_t seed_;
};

}  // namespace carom
