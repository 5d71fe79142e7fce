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
  Scene scene;  ///< of the run, with [observe] as it was measured: steps that follow from the mean free time are filled in
  std::vector<Measurement> observables;
  std::uint64_t samples = 0, events = 0;  ///< that the run has kept
};

/// Measures `observables`, each "NAME" or "NAME={ key = value, ... }" as in the [observe] table; where there are none, what the
/// run's own scene lists. States are needed at multiples of the step of the run's samples (or of the length of its blocks), which
/// an observable without `every` gets: the nearest to what it would choose. Where the run's positions were unwrapped, the results
/// are those of the run to the rounding of these.
/// `progress`, where there is one, is told again and again how much is done (0 to 1).
/// Throws OutputError for what is wrong with the run directory, SceneError for what is wrong with the observables, and
/// std::invalid_argument where the run has not kept what one of them needs.
[[nodiscard]] Analysis analyse(const std::filesystem::path& run_directory, const std::vector<std::string>& observables,
                               const std::function<void(double)>& progress = {});

}  // namespace carom
