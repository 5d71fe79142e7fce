#pragma once
// A recorded run, in its files or in memory, as pages play it. What is large is read when it is asked for.

#include <carom/io/run_reader.hpp>

#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace carom {

struct Recording {
  Scene scene;
  Disks disks;
  std::vector<std::string> species_names;
  std::string title;
  std::vector<std::pair<std::string, std::string>> facts;  ///< names and values, for the foot of a page
  std::optional<double> Z;                                 ///< of the whole run, if it has one
  double end = 0.0;                                        ///< the time that the run reached
  std::uint64_t samples = 0;
  std::uint64_t events = 0;  ///< 0 without a log
  std::string why_no_log;    ///< half a sentence where there is no log of all collisions; else empty
  std::function<State(std::uint64_t k)> sample;
  std::function<std::vector<double>()> sample_times;
  std::function<std::vector<Event>()> event_log;  ///< requires a log

  Recording() = default;
  /// The run in a directory is one. The functions throw OutputError, as those of the reader do.
  Recording(const RunReader& run);
};

/// Returns the recording of a run in memory. `samples`: its states in order of time, from the first to the last moment; their
/// images and remainders are not looked at. Its clock begins at the first sample. Requires one.
[[nodiscard]] Recording recording_in_memory(const Scene& scene, const Disks& disks, std::vector<State> samples,
                                            std::vector<Event> events);
/// The same of a run of which not all collisions are known; `why_no_log` is half a sentence.
[[nodiscard]] Recording recording_in_memory(const Scene& scene, const Disks& disks, std::vector<State> samples,
                                            const std::string& why_no_log);

}  // namespace carom
