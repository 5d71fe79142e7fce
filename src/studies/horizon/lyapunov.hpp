#pragma once
// The largest Lyapunov exponent of a scene: how fast two trajectories part that begin next to each other.

#include "studies/horizon/pace.hpp"
#include "studies/horizon/report.hpp"

#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <cstdint>
#include <functional>
#include <optional>

namespace carom {

struct LyapunovOptions {
  std::uint64_t collisions = 0;  ///< number of pair collisions; 0: half a million, or 100 per disk where that is more
  std::function<bool(double fraction)> proceed = {};  ///< several times a second; false ends it
};

/// Benettin's method (benettin1980) along one trajectory of the engine that runs the scene, from `start`: a tangent vector
/// (studies/horizon/lyapunov_tangent.hpp) is brought back to length 1 about once per collision of every disk, and the logarithms
/// of what it had grown by are averaged. The first fifth, in which it turns towards the direction that grows fastest, is left
/// out. The error is that of the mean over up to 32 blocks of 10 or more collisions per disk each; rates forget one
/// another in 1 or 2, so that blocks are independent to some tenths of the error itself.
///
/// Empty where `pace` has seen no collision, too few came, contacts dissipate energy, so that there is no steady rate, or the
/// caller said stop. Throws as make_simulation.
std::optional<Lyapunov> measure_lyapunov(const Scene& scene, const State& start, const Pace& pace,
                                         const LyapunovOptions& options = {});

}  // namespace carom
