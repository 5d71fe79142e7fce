#pragma once
// What carom sweep prints: its progress on one line of stderr, and its results.

#include "studies/sweep/child_runs.hpp"
#include "studies/sweep/results.hpp"
#include "terminal/command.hpp"
#include "terminal/progress.hpp"

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

namespace carom::cli {

class SweepProgress {
 public:
  /// Begins with `before` of `runs` runs finished.
  SweepProgress(ProgressMode mode, std::size_t runs, std::size_t before);

  void begun();
  void ended(const RunOutcome& outcome);
  void tick();  ///< now and then

 private:
  using Clock = std::chrono::steady_clock;
  [[nodiscard]] std::string words() const;
  void show();

  std::mutex mutex_;
  ProgressLine line_;
  std::size_t runs_, before_;
  std::size_t begun_ = 0, finished_ = 0, failed_ = 0, stopped_ = 0;
  Clock::time_point start_ = Clock::now();
};

/// Returns the points with some of their numbers, the failed runs, and the names of the files.
[[nodiscard]] std::string sweep_text(const Sweep& sweep, const SweepResults& results, const std::filesystem::path& directory);

/// A shell command for each of these runs, one per line.
[[nodiscard]] std::string commands_of(const Sweep& sweep, const std::vector<std::size_t>& runs,
                                      const std::filesystem::path& directory, const Invocation& invocation);

}  // namespace carom::cli
