#pragma once
// Runs handed out over processes: the first one has the list, all of them ask for a run when they have nothing to do. So nobody
// waits for the slowest, and whoever fails to run costs no more than that run.

#include "studies/sweep/mpi.hpp"
#include "studies/sweep/threads.hpp"
#include "terminal/command.hpp"

#include <functional>

namespace carom::cli {

/// In the first process.
class SweepServer {
 public:
  explicit SweepServer(Ranks& ranks) : ranks_(ranks), working_(ranks.size() - 1) {}
  ~SweepServer();  ///< sends the others home
  SweepServer(const SweepServer&) = delete;
  SweepServer& operator=(const SweepServer&) = delete;

  /// Answers the others until none of them works any more and `done_here` says so. Has them stop their runs where `stop` says so.
  void serve(const RunDesk& desk, const std::function<bool()>& done_here, const std::function<bool()>& stop);

 private:
  void answer(const Message& message, const RunDesk& desk);
  void to_all(int kind);

  Ranks& ranks_;
  int working_;
  bool stopping_ = false;
};

/// In the others: so many runs at a time, until there are no more.
[[nodiscard]] ExitCode work_for_first_rank(Ranks& ranks, int threads);

}  // namespace carom::cli
