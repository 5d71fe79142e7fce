#pragma once
// The extreme positions of walls that vibrate.

#include <carom/scene.hpp>

#include <cstddef>
#include <vector>

namespace carom {

/// A side of the box that vibrates at some time of a run.
struct WallVibration {
  std::size_t side = 0;          ///< left, right, bottom or top
  double low = 0.0, high = 0.0;  ///< its extreme positions where it begins to vibrate at the edge of the box
};

/// Returns the vibrations with an amplitude of the whole run.
[[nodiscard]] std::vector<WallVibration> wall_vibrations(const Scene& scene);

}  // namespace carom
