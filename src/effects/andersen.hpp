#pragma once
// Andersen's thermostat (J. Chem. Phys. 72, 2384 (1980)): now and then a disk, any of them, forgets how it moved and draws its
// velocity from the Maxwell distribution, as if a molecule of a heat bath had hit it. Its events are a Poisson process: N disks
// that each have them at a rate wait an exponential time at N times that rate for the next event of any.
//
// Event number n draws everything from a stream of its own, so that it is the same whatever engine runs the scene and wherever
// runs stop. The exponential and normal deviates are Boost's, by table and comparison: no logarithm enters their digits.

#include "core/random.hpp"
#include "effects/maxwell.hpp"

#include <carom/effects.hpp>

#include <Eigen/Core>

#include <boost/random/exponential_distribution.hpp>
#include <boost/random/uniform_int_distribution.hpp>

#include <cmath>
#include <cstdint>
#include <optional>

namespace carom {

/// One event of the thermostat: a disk gets a new velocity.
struct ThermostatEvent {
  double wait = 0.0;      ///< time since the event before, or since the start
  std::int32_t disk = 0;  ///< id of the disk
  Normals normals{};      ///< two for its velocity, one for its spin

  template <class Archive>
  void serialize(Archive& archive) {
    archive(wait, disk, normals);
  }
};

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
    RandomStream random(seed_, Stream::thermostat, n);
    ThermostatEvent drawn;
    drawn.wait = boost::random::exponential_distribution<double>(rate_)(random);
    drawn.disk = boost::random::uniform_int_distribution<std::int32_t>(0, disks_ - 1)(random);
    drawn.normals = draw_normals(random);
    return drawn;
  }

  /// <m v^2> = 2 kT
  [[nodiscard]] Eigen::Vector2d velocity(const ThermostatEvent& event, double mass) const {
    const double scale = std::sqrt(temperature_ / mass);
    return {scale * event.normals.a, scale * event.normals.b};
  }
  /// <I w^2> = kT
  [[nodiscard]] double spin(const ThermostatEvent& event, double moment_of_inertia) const {
    return std::sqrt(temperature_ / moment_of_inertia) * event.normals.c;
  }

 private:
  double temperature_;
  double rate_;  ///< of all disks together
  std::int32_t disks_;
  std::uint64_t seed_;
};

}  // namespace carom
