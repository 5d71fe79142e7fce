#pragma once
// The samples of a run that are taken at known times: the scene's own, and those of the grids of its hooks.

#include "core/instant.hpp"
#include "simulation/sampling_times.hpp"

#include <carom/simulation.hpp>
#include <carom/state.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace carom::detail {

class SamplingGrids {
 public:
  SamplingGrids(const Run& run, const RunHooks& hooks);

  /// The time of the next sample; `forever` where none is left.
  [[nodiscard]] Instant next() const;

  /// What those look at that take a sample at a time.
  enum class Needed { nothing, velocities, state };
  [[nodiscard]] Needed needed(const Instant& when) const;

  /// Gives the state to each grid that has a sample at a time. Returns whether the scene's own grid has.
  bool hand_out(const Instant& when, const State& state, const std::function<Totals()>& totals);

  /// The number of the next sample of each grid.
  [[nodiscard]] std::vector<std::uint64_t> numbers() const;
  /// Goes on with such numbers. A grid that was not there then goes on with its first sample after `now`; with its first of all
  /// where the measured run has not begun, and `now` is nothing.
  void go_on(const std::vector<std::uint64_t>& numbers, const std::optional<Instant>& now);

 private:
  struct Grid {
    SamplingTimes times;
    std::uint64_t stride;  ///< sample k is at number k * stride of these
    std::uint64_t last;
    const SamplingGrid* hook;  ///< null: the scene's own
    std::uint64_t k = 0;

    /// Returns the time of the next sample. That of the last does not depend on where the run ends.
    [[nodiscard]] Instant time() const { return k > last ? forever : times.at(k * stride); }
    [[nodiscard]] bool due(const Instant& when) const { return !(when < time()); }
  };
  /// Returns whether somebody looks at the samples of a grid.
  [[nodiscard]] bool looks(const Grid& grid) const {
    return grid.hook == nullptr ? static_cast<bool>(hooks_.sample) : static_cast<bool>(grid.hook->sample);
  }

  const RunHooks& hooks_;
  std::vector<Grid> grids_;
};

}  // namespace carom::detail
