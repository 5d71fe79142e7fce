#pragma once
// The progress of a sweep, on one line of stderr and in numbers. Any thread may call it.

#include "studies/sweep/child_run.hpp"
#include "terminal/progress.hpp"

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

namespace carom::cli {

class SweepProgress {
 public:
  /// Begins with `before` of `runs` runs finished.
  SweepProgress(ProgressMode mode, std::size_t runs, std::size_t before);

  void begun();
  void ended(const RunEnd& end);
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

}  // namespace carom::cli
