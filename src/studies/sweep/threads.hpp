#pragma once
// Runs handed out one by one to the threads of this machine.

#include "studies/sweep/child_run.hpp"

#include <functional>
#include <optional>

namespace carom::cli {

/// The source of runs, which is also told how they end. Each function is called by one thread at a time.
struct RunDesk {
  std::function<std::optional<RunOrder>()> next;  ///< nothing: there are no more
  std::function<void(const RunOrder&, const RunEnd&)> done;
};

/// Carries out all that `desk` hands out, so many at a time. `work` is called by several threads at once.
void run_in_threads(int threads, const RunDesk& desk, const std::function<RunEnd(const RunOrder&)>& work);

}  // namespace carom::cli
