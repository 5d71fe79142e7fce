#pragma once
// The data that replay a recorded run exactly: its start and all of its events, where these determine how the disks moved.

#include "io/run_reader.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// The largest distance of an exact replay from the run's samples, over the longer side of the box.
inline constexpr double replay_tolerance = 1e-6;

struct ExactRun {
  State start;  ///< the first sample
  std::vector<Event> events;
  double distance = 0.0;  ///< largest distance from the samples that it was compared with
  std::string why_not;    ///< half a sentence where the run cannot be replayed; then there are no events
  [[nodiscard]] bool exact() const { return why_not.empty(); }
};

/// `holder` ends the sentence about a log of more than `most_events`: "a page can hold". Throws OutputError where the run cannot
/// be read.
[[nodiscard]] ExactRun read_exactly(const RunReader& run, std::uint64_t most_events, std::string_view holder);

}  // namespace carom
