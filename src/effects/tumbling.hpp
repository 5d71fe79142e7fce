#pragma once
// Run-and-tumble motion (Berg, Random Walks in Biology; Tailleur & Cates, Phys. Rev. Lett. 100, 218103 (2008)): now and then a
// disk turns into another direction, all of which are as likely, and goes on as fast as before. Tumbles are a Poisson process, as
// the events of Andersen's thermostat are. A free disk of speed v has <r^2> = 2 v^2 T^2 (t/T - 1 + exp(-t/T)), T = 1 / rate.
//
// Event number n draws everything from a stream of its own. A direction is that of two normal deviates: no sine enters its
// digits.

#include "core/random.hpp"
#include "effects/thermostat_event.hpp"

#include <carom/effects.hpp>

#include <Eigen/Core>

#include <cmath>
#include <cstdint>
#include <optional>

namespace carom {

/// The tumbles of all disks, a Poisson process.
class Tumbles {
 public:
  Tumbles(const std::optional<Tumbling>& tumbling, std::int32_t disks, std::uint64_t seed)
      : rate_(tumbling ? tumbling->rate * disks : 0.0), disks_(disks), seed_(seed) {}

  /// Neutral at rate 0.
  [[nodiscard]] bool acts() const { return rate_ > 0.0; }

  /// Returns the rate of tumbles of all disks together; 1 / time.
  [[nodiscard]] double rate() const { return rate_; }

  /// Returns event number n, from 0. Requires acts().
  [[nodiscard]] ThermostatEvent event(std::uint64_t n) const {
    return draw_event(RandomStream(seed_, Stream::tumbling, n), rate_, disks_);
  }

  /// Returns a velocity as fast as `v`.
  [[nodiscard]] static Eigen::Vector2d velocity(const ThermostatEvent& event, const Eigen::Vector2d& v) {
    const double a = event.normals.a, b = event.normals.b;
    const double length = std::sqrt(a * a + b * b);
    const double speed = std::sqrt(v.x() * v.x() + v.y() * v.y());
    return {speed * (a / length), speed * (b / length)};
  }

 private:
  double rate_;  ///< of all disks together
  std::int32_t disks_;
  std::uint64_t seed_;
};

}  // namespace carom
