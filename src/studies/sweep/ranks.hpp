#pragma once
// Distribution of runs over processes: the first one has the list, and each asks it for a run when it is idle. So no process
// waits for the slowest, and a process that fails loses only the run that it had.

#include "studies/sweep/child_runs.hpp"
#include "terminal/command.hpp"
#include "terminal/processes.hpp"

#include <functional>

namespace carom::cli {

/// The first process, which has the list of runs.
class SweepServer {
 public:
  explicit SweepServer(Processes& ranks) : ranks_(ranks), working_(ranks.size() - 1) {}
  ~SweepServer();  ///< has the other processes end
  SweepServer(const SweepServer&) = delete;
  SweepServer& operator=(const SweepServer&) = delete;

  /// Answers the others until none of them works any more and `done_here` says so. Has them stop their runs where `stop` says so.
  void serve(const RunSource& source, const std::function<bool()>& done_here, const std::function<bool()>& stop);

 private:
  void answer(const Message& message, const RunSource& source);
  void to_all(int kind);

  Processes& ranks_;
  int working_;
  bool stopping_ = false;
};

/// Carries out `threads` runs at a time in a process other than the first, until there are no more.
[[nodiscard]] ExitCode work_for_first_rank(Processes& ranks, int threads);

}  // namespace carom::cli
