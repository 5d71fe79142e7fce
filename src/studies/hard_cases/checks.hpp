#pragma once
// The checks of a hard case against the run of an engine: one small function per expectation.

#include "studies/hard_cases/hard_case.hpp"
#include "studies/hard_cases/run.hpp"

#include <carom/scene.hpp>

#include <vector>

namespace carom {

/// Everything that one run shows by itself.
[[nodiscard]] std::vector<CaseCheck> checks_of_run(const HardCase& hard_case, const Scene& scene, const EngineRun& run);

/// Returns the checks that all engines have the same events in the same order, where the case asks for it: one for each engine
/// but the one that the others are compared with.
[[nodiscard]] std::vector<CaseCheck> checks_of_order(const HardCase& hard_case, const std::vector<EngineRun>& runs);

/// Returns the checks that need runs of their own: velocities reversed, disks in another order, a late sample.
[[nodiscard]] std::vector<CaseCheck> checks_of_reruns(const HardCase& hard_case, const Scene& scene, const EngineRun& run);

/// Returns the check of a number against a bound; NaN is beyond every bound.
[[nodiscard]] CaseCheck within(std::string what, const EngineRun& run, double value, double bound);

/// Returns a bound of double precision for the engine of the run: in single precision it is 2^29 times as wide.
[[nodiscard]] double widened(double bound, const EngineRun& run);

}  // namespace carom
