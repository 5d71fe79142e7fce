#pragma once
// How far two runs of one scene have come apart: in positions, and in the order of their events.

#include "observe/horizon_report.hpp"

#include <carom/box.hpp>
#include <carom/state.hpp>

#include <deque>
#include <optional>
#include <span>

namespace carom {

/// From where disk i is in state b to where it is in state a, to the nearest image along periodic axes, with what the states
/// know beyond doubles (State::remainders).
[[nodiscard]] Eigen::Vector2d displacement(const Box& box, const State& a, const State& b, Eigen::Index i);

/// The largest distance of a disk in one state from itself in the other, to the nearest image along periodic axes; with
/// what the states know beyond doubles (State::remainders). Infinite where a position is not finite. Both states of one time.
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
