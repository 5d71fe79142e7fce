#pragma once
// carom run SCENE --changes FILE: a run that was changed while it went on, again.

#include "app/commands.hpp"

namespace carom::cli {

/// Runs the scene with the changes of options.changes at their times, up to run.time, and prints how it ended. Writes samples.csv
/// where the scene samples and asks for it, and nothing else. Throws UsageError for options that only other runs have; SceneError
/// where the list or one of its changes is wrong, before or during the run.
ExitCode run_with_changes(const RunOptions& options);

}  // namespace carom::cli
