#include "terminal/run_estimate.hpp"

#include <algorithm>

namespace carom::cli {

double fraction_done(const Scene& scene, const Progress& progress) {
  const auto pairs = static_cast<double>(progress.totals.pair);
  double fraction = 0.0;
  if (progress.equilibrating) {
    if (!scene.run.equilibrate) return 0.0;
    const Run::Equilibrate& goal = *scene.run.equilibrate;
    if (goal.time && *goal.time > 0.0) fraction = progress.time / *goal.time;
    // One collision is one for each of its two disks.
    if (goal.collisions_per_disk && *goal.collisions_per_disk > 0.0) {
      fraction = 2.0 * pairs / (*goal.collisions_per_disk * static_cast<double>(scene.disk_count()));
    }
  } else {
    if (scene.run.time && *scene.run.time > 0.0) fraction = progress.time / *scene.run.time;
    if (scene.run.collisions && *scene.run.collisions > 0) {
      fraction = std::max(fraction, pairs / static_cast<double>(*scene.run.collisions));
    }
  }
  return std::clamp(fraction, 0.0, 1.0);
}

RunEstimate::Estimate RunEstimate::at(const Progress& progress, Clock::time_point now) {
  if (progress.equilibrating != equilibrating_) {
    equilibrating_ = progress.equilibrating;
    phase_start_ = now;
  }
  Estimate estimate{.done = fraction_done(scene_, progress)};
  if (progress.loop_seconds > 0.0) estimate.per_second = static_cast<double>(progress.totals.pair) / progress.loop_seconds;
  const double spent = std::chrono::duration<double>(now - phase_start_).count();
  // An estimate from the first instants would jump about.
  if (estimate.done > 0.0 && spent > 0.5) estimate.seconds_left = spent * (1.0 - estimate.done) / estimate.done;
  return estimate;
}

}  // namespace carom::cli
