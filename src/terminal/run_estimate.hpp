#pragma once
// The fraction of a run that is done, and the time that it still needs.

#include <carom/scene.hpp>
#include <carom/simulation.hpp>

#include <chrono>
#include <optional>

namespace carom::cli {

/// Returns the fraction, 0 to 1, of the equilibration or of the measured run that is done.
[[nodiscard]] double fraction_done(const Scene& scene, const Progress& progress);

class RunEstimate {
 public:
  using Clock = std::chrono::steady_clock;
  struct Estimate {
    double done = 0.0;                        ///< 0 to 1, of equilibration or of the measured run
    std::optional<double> seconds_left = {};  ///< absent in the first instants
    double per_second = 0.0;                  ///< collisions; 0 where nothing is known
  };

  /// Requires the scene to live as long as this.
  explicit RunEstimate(const Scene& scene) : scene_(scene), phase_start_(Clock::now()) {}

  [[nodiscard]] Estimate at(const Progress& progress, Clock::time_point now);

 private:
  const Scene& scene_;
  Clock::time_point phase_start_;  ///< of equilibration, then of the measured run
  bool equilibrating_ = false;
};

}  // namespace carom::cli
