#pragma once
// What one domain tells a neighbouring one of a disk near their border: all that decides what the disk does next.

#include "neighbours/neighbour_lists.hpp"
#include "neighbours/neighbour_search.hpp"

#include <array>
#include <cstdint>

namespace carom {

/// The partners of a disk within the steps of the potential: ids, rising, and -1 behind them, and the step of each pair.
struct StepsOfPairs {
  static constexpr std::size_t most = 24;
  std::array<std::int32_t, most> ids;
  std::array<std::int16_t, most> steps;

  bool operator==(const StepsOfPairs&) const = default;
};
/// Where there are no steps.
struct NoStepsOfPairs {
  bool operator==(const NoStepsOfPairs&) const = default;
};

/// The state of one disk at the end of a window, as the domain has it to which the disk belongs. Line, FrameRest and
/// ImpactRest are those of the engine (engine/layout.hpp, engine/flight_frame.hpp, effects/any_impact.hpp);
/// Steps is one of the above.
template <class Line, class FrameRest, class ImpactRest, class Steps>
struct DiskMessage {
  Line line;
  double pair_time, edge_time;  ///< of its plan
  std::uint64_t history;        ///< hash of the events of this disk
  std::int32_t id;
  std::int32_t partner;  ///< of its plan, by id; -1 for none
  std::int32_t edge;
  bool stale;  ///< whether the plan is
  NeighbourhoodCentre centre;
  NeighbourLists::DiskSize size;
  FrameRest frame;
  ImpactRest impact;
  Steps steps;
};

}  // namespace carom
