#pragma once
// carom run --watch: the box, how far the run has come, and its speeds, redrawn in place on a terminal while the run goes on.

#include "terminal/dot_canvas.hpp"
#include "terminal/picture.hpp"
#include "terminal/run_estimate.hpp"

#include <carom/simulation.hpp>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace carom::cli {

/// Returns the colours that stderr can show; empty where it is no terminal, or one that cannot move its cursor, has no UTF-8 or
/// is smaller than 60 x 18.
[[nodiscard]] std::optional<TerminalColours> terminal_for_pictures();

class LiveView {
 public:
  /// Requires the simulation to live as long as this.
  LiveView(const Simulation& simulation, TerminalColours colours);

  /// Draws where it is time to: at most ten times a second, and so that drawing takes no more than a fiftieth of the time.
  void update(const Progress& progress);

  /// Draws a run that is slowed down to `pace` (simulated time per second): waits until the state is due, then draws it.
  void keep_pace(double pace, const State& state, const Totals& totals);

  /// The last picture, which stays.
  void finish(const Progress& progress) { draw(progress); }

 private:
  using Clock = std::chrono::steady_clock;

  void draw(const Progress& progress);
  [[nodiscard]] std::vector<std::string> gauges(const Progress& progress, const State& state, Clock::time_point now);
  void put(const std::vector<std::string>& lines, TextArea terminal);

  const Simulation& simulation_;
  TerminalColours colours_;
  Clock::time_point next_;
  RunEstimate estimate_;
  std::optional<Clock::time_point> paced_since_;
  std::optional<double> energy_at_start_;  ///< of the measured run
  TextArea drawn_on_;                      ///< the terminal's size at the last picture
  int drawn_ = 0;                          ///< lines of that picture
};

}  // namespace carom::cli
