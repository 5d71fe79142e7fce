#pragma once
// Observables of a finished run, measured afterwards from the samples and collisions that it has kept: the same numbers, to the
// last bit, as if the run itself had been asked for them.

#include <carom/observe.hpp>
#include <carom/scene.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace carom {

struct Analysis {
  Scene scene;  ///< scene of the run, with [observe] as it was measured: default steps are filled in
  std::vector<Measurement> observables;
  std::uint64_t samples = 0, events = 0;  ///< numbers of samples and events that the run has stored
};

/// Measures `observables`, each "NAME" or "NAME={ key = value, ... }" as in the [observe] table; without any, those of the run's
/// own scene. States are needed at multiples of the step of the run's samples (or of the length of its blocks); an observable
/// without `every` gets the multiple nearest to its own default. Where the run's positions were unwrapped, the results equal
/// those of the run to rounding. `progress`, if given, is called repeatedly with the fraction that is done (0 to 1). Throws
/// OutputError for a fault of the run directory, SceneError for a fault of the observables, and std::invalid_argument where the
/// run has not stored the data that one of them needs.
[[nodiscard]] Analysis analyse(const std::filesystem::path& run_directory, const std::vector<std::string>& observables,
                               const std::function<void(double)>& progress = {});

}  // namespace carom
