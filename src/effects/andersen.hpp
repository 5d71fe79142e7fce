#pragma once
// Andersen's thermostat (J. Chem. Phys. 72, 2384 (1980)): now and then a disk, chosen at random, redraws its velocity from
// the Maxwell distribution, as if a molecule of a heat bath had hit it. Its events are a Poisson process: N disks
// that each have them at a rate wait an exponential time at N times that rate for the next event of any.
//
// Event number n draws everything from a stream of its own, so that it is the same whatever engine runs the scene and wherever
// runs stop.

#include "core/random.hpp"
#include "effects/maxwell.hpp"
#include "effects/thermostat_event.hpp"

#include <carom/effects.hpp>

#include <Eigen/Core>

#include <cstdint>
#include <optional>

namespace carom {

class Andersen {
 public:
  Andersen(const std::optional<Thermostat>& thermostat, std::int32_t disks, std::uint64_t seed)
      : temperature_(thermostat ? thermostat->temperature : 0.0),
        rate_(thermostat ? thermostat->rate * disks : 0.0),
        disks_(disks),
        seed_(seed) {}

  /// Neutral at rate 0.
  [[nodiscard]] bool acts() const { return rate_ > 0.0; }

  /// Returns the rate of events of all disks together; 1 / time.
  [[nodiscard]] double rate() const { return rate_; }

  /// Returns event number n, from 0. Requires acts().
  [[nodiscard]] ThermostatEvent event(std::uint64_t n) const {
    return draw_event(RandomStream(seed_, Stream::thermostat, n), rate_, disks_);
  }

  [[nodiscard]] Eigen::Vector2d velocity(const ThermostatEvent& event, double mass) const {
    return maxwell_velocity(event.normals, temperature_, mass);
  }
  [[nodiscard]] double spin(const ThermostatEvent& event, double moment_of_inertia) const {
    return maxwell_spin(event.normals, temperature_, moment_of_inertia);
  }

 private:
  double temperature_;
  double rate_;  ///< of all disks together
  std::int32_t disks_;
  std::uint64_t seed_;
};

}  // namespace carom
