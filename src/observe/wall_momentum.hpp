#pragma once
// The bounded part of what walls get. Between walls at +-h from the middle (for the centres of disks) the disks' momentum P and
// action G = sum of m (x - middle) v along the axis change by
//
//   dP = I_low - I_high,   dG = S dt - h (I_low + I_high),   S = sum of m v^2 + virial of collisions,
//
// where I is what each wall gets, outward positive. So I_low = S dt / 2h - d(G / h - P) / 2 and I_high = S dt / 2h - d(G / h + P)
// / 2: sound and the disks' flight from wall to wall are in G and P, which stay bounded, and the pressure is in S. Disks of
// several sizes, weight and thermal walls leave a part of it in the rest, which does no harm.

#include "observe/observed_run.hpp"

namespace carom {

struct WallMomentum {
  double momentum = 0.0;  ///< P
  double action = 0.0;    ///< G
};

/// Along an axis. Positions are to be those of the state.
[[nodiscard]] WallMomentum wall_momentum(const ObservedRun& run, const State& state, int axis);

/// Returns h for disks of the mean diameter; 0 where there is no room.
[[nodiscard]] double reach_between_walls(const ObservedRun& run, int axis);

}  // namespace carom
