#pragma once
// The first difference in the order of the events of two runs of one scene.

#include "studies/horizon/report.hpp"

#include <carom/state.hpp>

#include <deque>
#include <optional>
#include <span>

namespace carom {

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
