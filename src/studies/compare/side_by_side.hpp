#pragma once
// One start flown by exact events and by a fixed-step method, kept so that both can be shown: collisions on one side, turns on
// the other, how far the two have come apart, and which disks overlap where none can. Nothing here draws.

#include "studies/compare/comparison.hpp"
#include "studies/compare/flown_overlaps.hpp"

#include <carom/scene.hpp>
#include <carom/simulation.hpp>
#include <carom/state.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace carom {

/// A change of velocity: from step `step` on, at step * dt, `disk` flies with `velocity`.
struct Turn {
  std::uint32_t step = 0;
  std::int32_t disk = 0;
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
};

/// Why no more is shown.
enum class ShownUntil {
  end,      ///< the scene's run ends here
  parted,   ///< disks have lost each other, and as much time again has passed
  numbers,  ///< more would not fit
  work,     ///< more steps would take too long
  stuck,    ///< time stands still in the exact run
  stopped,  ///< the caller said stop
};

/// More disks than this are too small to be seen overlapping, and a page of them too large.
inline constexpr std::int64_t most_disks_side_by_side = 2000;

/// Distance, in mean diameters, beyond which a disk meets other partners than on the other side.
inline constexpr double clearly_parted = 0.5;

struct SideBySideLimits {
  std::size_t numbers = 450'000;  ///< kept: six of a collision, three of a turn or an overlap; 5 MB of page
  /// 10,000 per step, which is a million steps at most; 300 per disk and step, of the naive methods 5 per pair besides:
  /// nanoseconds, roughly.
  double work = 1e10;
};

struct SideBySideOptions {
  FixedStep step;
  std::string engine = "auto";  ///< engine of the exact side
  double until = 0.0;           ///< time, > 0: the end of the scene's run
  double free_time = 0.0;       ///< mean; as far as ten of them are shown however early the two have parted
  double sigma = 1.0;           ///< mean diameter, the unit of distances
  SideBySideLimits limits = {};
  std::function<bool(double fraction)> proceed = {};  ///< several times a second; false ends it
};

struct SideBySide {
  FixedStep step;
  std::string engine;  ///< engine of the exact side
  State start;
  Disks disks;
  double sigma = 1.0;
  double until = 0.0;  ///< time that is shown
  ShownUntil because = ShownUntil::end;
  double free_time = 0.0;
  std::vector<Event> events;  ///< events of the exact side
  /// changes of velocity of the fixed steps, by step, then by disk; the first ones at step 0, where a velocity was changed
  std::vector<Turn> turns;
  std::vector<Overlap> overlaps;     ///< overlaps of the fixed steps, in the order in which they began
  std::vector<double> times;         ///< times of steps, rising from 0; a thousand at most
  std::vector<double> distance;      ///< then, of the two sides: root mean square over disks, to nearest images, in sigma
  double energy_change_exact = 0.0;  ///< the largest at these times, as a share of the energy at the start
  double energy_change_stepped = 0.0;

  [[nodiscard]] std::optional<double> parted_at() const;  ///< the first of `times` with a distance of `clearly_parted`
};

/// Flies both. Throws as make_simulation.
[[nodiscard]] SideBySide fly_side_by_side(const Scene& scene, const State& start, const SideBySideOptions& options);

/// Returns, of the study's steps, the one nearest to that in which a disk of typical speed goes a fiftieth of a diameter:
/// overlaps are then visible, and errors still have two decades to grow. Where a tenth of the mean free time is shorter, the step
/// is nearest to that: it detects most collisions.
[[nodiscard]] double visible_step(const ComparePlan& plan, const State& start);

}  // namespace carom
