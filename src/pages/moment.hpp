#pragma once
// One instant of a recorded run, as pictures need it, and where a disk is drawn that has left a periodic box.

#include <carom/box.hpp>
#include <carom/state.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace carom {

/// A piece of a path: a straight line, or, where disks fall, a parabola, whose tangents at its ends meet in `middle`.
struct Stretch {
  Eigen::Vector2d from, middle, to;
};

struct Moment {
  double time = 0.0;
  Eigen::Matrix2Xd positions;                ///< on periodic axes inside the box
  Eigen::Matrix2Xd velocities;               ///< between two samples those of the sample before
  double scale = 1.0;                        ///< radii are scale * Disks::radius
  std::array<double, 4> sides{};             ///< left, right, bottom, top
  double shear_displacement = 0.0;           ///< displacement of the images above
  std::vector<std::uint64_t> collisions;     ///< number of collisions of each disk so far; empty where the run stored no events
  std::vector<std::vector<Stretch>> trails;  ///< the trail of each disk, oldest first; empty without trails
};

/// Left, right, bottom, top, wherever they have moved to.
[[nodiscard]] std::array<double, 4> sides_of(const Box& box, const State& state);

/// Returns the displacement that takes `position` back into the box: whole box lengths along periodic axes, zero along others. An
/// image that is n boxes above is displaced along x by n times `shear_displacement`, too.
[[nodiscard]] Eigen::Vector2d into_box(const Box& box, const Eigen::Vector2d& position, double shear_displacement = 0.0);

}  // namespace carom
