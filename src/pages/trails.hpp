#pragma once
// The trails of disks: their flights during the last stretch of time, kept while a replay goes on.

#include "pages/moment.hpp"

#include <deque>

namespace carom {

class Trails {
 public:
  /// Trails are `span` long in time. Flights are parabolas with this acceleration.
  Trails(const Box& box, const Eigen::Vector2d& acceleration, double span);

  [[nodiscard]] double span() const { return span_; }
  /// Starts the trail of this disk; flights of other disks are not kept.
  void follow(std::size_t disk);
  /// All that was noted.
  void forget();

  /// Adds the flight of `disk` from here and `time` on. Requires increasing times.
  void note(std::size_t disk, double time, const Eigen::Vector2d& position, const Eigen::Vector2d& velocity,
            double shear_displacement = 0.0);

  /// Returns the trail of every disk up to `time`. Each stretch begins in the box and is at most half as long as it.
  [[nodiscard]] std::vector<std::vector<Stretch>> until(double time) const;

 private:
  struct Flight {
    double time;
    Eigen::Vector2d position, velocity;
    double shear_displacement;
  };
  void add_stretches(const Flight& flight, double from, double to, std::vector<Stretch>& trail) const;

  Box box_;
  Eigen::Vector2d acceleration_;
  double span_;
  std::vector<std::deque<Flight>> flights_;  ///< of each disk up to the last that is followed
  std::vector<bool> followed_;
};

}  // namespace carom
