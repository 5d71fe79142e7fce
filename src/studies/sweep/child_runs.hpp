#pragma once
// Runs of a sweep as child processes of this program, several at a time: a crash, or a lack of memory, ends one run alone.

#include "terminal/signals.hpp"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace carom::cli {

/// A run to carry out, and its directory. It can be sent to other machines as it is.
struct RunOrder {
  std::size_t run = 0;              ///< its number in the sweep
  std::filesystem::path directory;  ///< directory of its results
  std::string scene;                ///< the scene with every default
  std::string checkpoint_every;     ///< interval as carom run takes it; empty: only when it is stopped
};

struct RunOutcome {
  bool finished = false;
  std::string failure = {};  ///< a sentence; empty too where the run was stopped
};

/// Writes the scene into the directory, runs it there or goes on from the checkpoint that is there, and leaves the sentence of a
/// failure there too. Calls `tick` some times a second; stops the run, which then completes its files, where `stop` says so or
/// `tick` returns false. Never throws: whatever goes wrong is the failure of this run.
[[nodiscard]] RunOutcome carry_out(const RunOrder& order, const StopRequest& stop, const std::function<bool()>& tick);

/// The source of runs, to which their outcomes are reported. Each function is called by one thread at a time.
struct RunSource {
  std::function<std::optional<RunOrder>()> next;  ///< empty when there are no more
  std::function<void(const RunOrder&, const RunOutcome&)> done;
};

/// Carries out all that `source` hands out, so many at a time. `work` is called by several threads at once.
void run_in_threads(int threads, const RunSource& source, const std::function<RunOutcome(const RunOrder&)>& work);

}  // namespace carom::cli
