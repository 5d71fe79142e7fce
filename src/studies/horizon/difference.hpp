#pragma once
// The difference between two runs of one scene: in positions, and in the order of their events.

#include "studies/horizon/report.hpp"

#include <carom/box.hpp>
#include <carom/state.hpp>

#include <deque>
#include <optional>
#include <span>

namespace carom {

/// Returns the displacement of disk i from state b to state a, to the nearest image along periodic axes, with the remainders of
/// the states (State::remainders).
[[nodiscard]] Eigen::Vector2d displacement(const Box& box, const State& a, const State& b, Eigen::Index i);

/// Returns the largest displacement of any disk between two states of one time, to the nearest image along periodic axes, with
/// the remainders of the states (State::remainders). Infinite where a position is not finite.
[[nodiscard]] double largest_distance(const Box& box, const State& a, const State& b);

/// Root of the mean square distance of the disks in one state from themselves in the other, likewise; 0 without disks.
[[nodiscard]] double rms_distance(const Box& box, const State& a, const State& b);

/// Two logs of events that arrive in parts, compared as they come. Nothing is kept that has found its counterpart.
///
/// Events of the better log at exactly one instant may come in any order in the other: which of them is first is a rule
/// of the engine, and no physics.
class LogComparison {
 public:
  void add(std::span<const Event> log, std::span<const Event> better_log);
  [[nodiscard]] const std::optional<FirstDifference>& found() const { return found_; }

 private:
  void match();

  std::deque<Event> waiting_;
  std::deque<Event> better_waiting_;
  std::uint64_t matched_ = 0;
  std::optional<FirstDifference> found_;
};

}  // namespace carom
