#pragma once
// Andersen's thermostat (J. Chem. Phys. 72, 2384 (1980)): now and then a disk, any of them, forgets how it moved and draws its
// velocity from the Maxwell distribution, as if a molecule of a heat bath had hit it. Kicks come as a Poisson process: N disks
// that are each kicked at a rate wait an exponential time at N times that rate for the next kick of any.
//
// Kick number n draws everything from a stream of its own, so that it is the same whatever engine runs the scene and wherever
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

/// What a thermostat does next.
struct Kick {
  double wait = 0.0;      ///< since the kick before, or since the start
  std::int32_t disk = 0;  ///< the one that is kicked
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

  /// Kick number n, from 0. Requires acts().
  [[nodiscard]] Kick kick(std::uint64_t n) const {
    RandomStream random(seed_, Stream::thermostat, n);
    Kick kick;
    kick.wait = boost::random::exponential_distribution<double>(rate_)(random);
    kick.disk = boost::random::uniform_int_distribution<std::int32_t>(0, disks_ - 1)(random);
    kick.normals = draw_normals(random);
    return kick;
  }

  /// <m v^2> = 2 kT
  [[nodiscard]] Eigen::Vector2d velocity(const Kick& kick, double mass) const {
    const double scale = std::sqrt(temperature_ / mass);
    return {scale * kick.normals.a, scale * kick.normals.b};
  }
  /// <I w^2> = kT
  [[nodiscard]] double spin(const Kick& kick, double moment_of_inertia) const {
    return std::sqrt(temperature_ / moment_of_inertia) * kick.normals.c;
  }

 private:
  double temperature_;
  double rate_;  ///< of all disks together
  std::int32_t disks_;
  std::uint64_t seed_;
};

}  // namespace carom
