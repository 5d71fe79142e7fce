#pragma once
// The events of a Poisson process that gives disks new velocities: those of Andersen's thermostat, and tumbles.

#include "core/random.hpp"
#include "effects/maxwell.hpp"

#include <boost/random/exponential_distribution.hpp>
#include <boost/random/uniform_int_distribution.hpp>

#include <cstdint>

namespace carom {

/// One event: a disk gets a new velocity.
struct ThermostatEvent {
  double wait = 0.0;      ///< time since the event before, or since the start
  std::int32_t disk = 0;  ///< id of the disk
  Normals normals{};      ///< two for its velocity, one for its spin

  template <class Archive>
  void serialize(Archive& archive) {
    archive(wait, disk, normals);
  }
};

/// Returns the event of a process that has `rate` events of all disks together in a unit of time. The exponential and normal
/// deviates are Boost's, by table and comparison: no logarithm enters their digits.
inline ThermostatEvent draw_event(RandomStream random, double rate, std::int32_t disks) {
  ThermostatEvent drawn;
  drawn.wait = boost::random::exponential_distribution<double>(rate)(random);
  drawn.disk = boost::random::uniform_int_distribution<std::int32_t>(0, disks - 1)(random);
  drawn.normals = draw_normals(random);
  return drawn;
}

}  // namespace carom
