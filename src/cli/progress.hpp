#pragma once
// One line on stderr that says how far a run has come.

#include <carom/scene.hpp>
#include <carom/simulation.hpp>

#include <chrono>
#include <optional>

namespace carom::cli {

enum class ProgressMode { automatic, always, never };  ///< automatic: only where stderr is a terminal

class ProgressLine {
 public:
  ProgressLine(ProgressMode mode, const Scene& scene);
  ~ProgressLine();  ///< leaves an empty line where the progress stood
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Cheap when called more often than the line changes.
  void update(const Progress& progress);

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] double fraction_done(const Progress& progress) const;
  [[nodiscard]] std::string line(const Progress& progress, Clock::time_point now) const;

  const Scene& scene_;
  bool shown_;
  bool terminal_;
  Clock::time_point phase_start_;  ///< of equilibration, then of the measured run
  bool equilibrating_ = false;
  std::optional<Clock::time_point> last_;
};

}  // namespace carom::cli
