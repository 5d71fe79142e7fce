#pragma once
// The progress of a run on one line of stderr.

#include "terminal/run_estimate.hpp"

#include <carom/scene.hpp>
#include <carom/simulation.hpp>

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

namespace carom::cli {

/// A line on stderr that is rewritten in place; nothing where stderr is no terminal.
class StatusLine {
 public:
  StatusLine() = default;
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;
  ~StatusLine() { show(""); }
  void show(const std::string& text) const {
    if (!terminal_) return;
    std::fprintf(stderr, "\r\x1b[K%s", text.c_str());
    std::fflush(stderr);
  }

 private:
  bool terminal_ = isatty(STDERR_FILENO) == 1;
};

enum class ProgressMode { automatic, always, never };  ///< automatic: only where stderr is a terminal

/// Returns the mode that --progress and --quiet ask for. Throws UsageError where `when` is not auto, always or never.
ProgressMode progress_mode(const std::string& when, bool quiet);

/// The progress of a run: rewritten in place on a terminal, appended now and then elsewhere.
class ProgressLine {
 public:
  ProgressLine(ProgressMode mode, const Scene& scene);
  ~ProgressLine();  ///< clears the line
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Cheap when called more often than the line changes.
  void update(const Progress& progress);

  /// Shows the progress of work that is not a run: what is being done, the fraction that is done (0 to 1), and after some of it
  /// the time that the rest will take.
  void update(const std::string& doing, double fraction);

  /// Does so for work whose pace changes too much to say what time the rest will take.
  void update_share(const std::string& doing, double fraction);

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] bool is_due(Clock::time_point now) const;
  void show(const std::string& text, Clock::time_point now);
  [[nodiscard]] std::string line(const Progress& progress, Clock::time_point now);

  bool shown_;
  bool terminal_;
  RunEstimate estimate_;
  std::optional<Clock::time_point> last_;
  std::optional<std::pair<Clock::time_point, double>> begun_;  ///< time and fraction of the first work that is not a run
};

}  // namespace carom::cli
