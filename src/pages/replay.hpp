#pragma once
// A recorded run, carried from event to event: free flight from the first sample, and after every event the velocities that the
// log names. What the log does not name but follows from it, the motion of pistons and the rescaling of growing disks, is made up
// here. The player does the same arithmetic in the browser.

#include "pages/recording.hpp"

#include <carom/scene.hpp>
#include <carom/state.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// The precision of velocities in the file that the player reads.
enum class VelocityDigits { single, twice };

class Replay {
 public:
  /// `start` is the first sample. With single digits every velocity after an event is rounded to a float.
  Replay(const Scene& scene, const Disks& disks, const State& start, VelocityDigits digits = VelocityDigits::twice);

  /// Requires events in order of time, from the first one on. The result is what all velocities were multiplied by just after.
  std::optional<double> apply(const Event& event);

  [[nodiscard]] Eigen::Vector2d position(std::size_t disk, double time) const;  ///< not folded into a periodic box
  [[nodiscard]] Eigen::Vector2d velocity(std::size_t disk, double time) const;
  /// One wall, left, right, bottom or top: the last time at which it changed its motion, and its position then.
  struct Side {
    double time = 0.0, position = 0.0, velocity = 0.0, acceleration = 0.0;  ///< along its axis
  };
  [[nodiscard]] const std::array<Side, 4>& sides() const { return sides_; }
  /// Requires a time not before the last change of its motion, and a wall that does not vibrate.
  [[nodiscard]] double wall_position(std::size_t side, double time) const;

 private:
  struct Flight {
    Eigen::Vector2d position, velocity;
    double time;
  };
  void turn(std::size_t disk, double time, const Eigen::Vector2d& velocity);
  void push(std::size_t side, std::size_t disk, double time, const Eigen::Vector2d& velocity);
  [[nodiscard]] double kinetic_energy(double time) const;
  [[nodiscard]] double rounded(double value) const;

  const Disks* disks_;
  VelocityDigits digits_;
  Eigen::Vector2d acceleration_ = Eigen::Vector2d::Zero();
  std::vector<Flight> flights_;
  std::array<Side, 4> sides_;
  std::array<double, 4> piston_mass_{};  ///< 0: no piston
  std::uint64_t pairs_ = 0;
  std::uint64_t rescale_every_ = 0;  ///< pair collisions; 0: never
  double energy_at_start_ = 0.0;
};

/// Returns why collisions and the data made up here do not determine how the disks moved, as a sentence; empty where they do.
[[nodiscard]] std::string why_no_replay(const Scene& scene);

/// Returns the largest distance of the replay from the run's samples, over some fifty samples spread over the run; `sample`
/// returns them by their number.
[[nodiscard]] double distance_from_samples(const Scene& scene, Replay replay, const std::vector<Event>& events,
                                           std::uint64_t samples, const std::function<State(std::uint64_t)>& sample);

/// The largest distance of an exact replay from the run's samples, over the longer side of the box.
inline constexpr double replay_tolerance = 1e-6;

struct ExactRun {
  State start;  ///< the first sample
  std::vector<Event> events;
  double distance = 0.0;  ///< largest distance from the samples that it was compared with
  std::string why_not;    ///< half a sentence where the run cannot be replayed; then there are no events
  [[nodiscard]] bool exact() const { return why_not.empty(); }
};

/// `holder` ends the sentence about a log of more than `most_events`: "a page can hold". Throws OutputError where the run cannot
/// be read.
[[nodiscard]] ExactRun read_exactly(const Recording& run, std::uint64_t most_events, std::string_view holder);

}  // namespace carom
