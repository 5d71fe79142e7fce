#pragma once
// The disks that are followed through time one by one: at most a thousand of each species, chosen at random, so that memory
// stays bounded.

#include "observe/observed_run.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace carom {

class TrackedDisks {
 public:
  static constexpr std::size_t most = 1000;

  /// Tracks the disks of one species.
  TrackedDisks(const ObservedRun& run, std::size_t species);

  [[nodiscard]] std::size_t channels() const { return 2 * ids_.size(); }
  /// Returns x and y of each disk, relative to the common motion of all along axes that keep momentum. Valid until the next call.
  [[nodiscard]] std::span<const double> velocities(const Eigen::Matrix2Xd& peculiar);
  /// Returns unwrapped positions, less `drift`, the displacement of the centre of mass.
  [[nodiscard]] std::span<const double> unwrapped(const ObservedRun& run, const State& state, const Eigen::Vector2d& drift);

 private:
  std::vector<std::int32_t> ids_;
  std::vector<double> values_;
};

}  // namespace carom
