#include "studies/horizon/difference.hpp"

#include <algorithm>

namespace carom {

void LogComparison::add(std::span<const Event> log, std::span<const Event> better_log) {
  if (found_) return;
  waiting_.insert(waiting_.end(), log.begin(), log.end());
  better_waiting_.insert(better_waiting_.end(), better_log.begin(), better_log.end());
  match();
}

void LogComparison::match() {
  while (!waiting_.empty() && !better_waiting_.empty()) {
    const Event& event = waiting_.front();
    const Event& first = better_waiting_.front();
    const auto at_one_instant = [&](const Event& one) {
      return one.time == first.time && one.time_remainder == first.time_remainder;
    };
    const auto past_ties = std::find_if_not(better_waiting_.begin(), better_waiting_.end(), at_one_instant);
    const auto counterpart = std::find_if(better_waiting_.begin(), past_ties, [&](const Event& one) {
      return one.disk == event.disk && one.partner == event.partner;
    });
    if (counterpart == past_ties) {
      found_ = {matched_, first.time, first.disk, first.partner, event.disk, event.partner};
      waiting_.clear();
      better_waiting_.clear();
      return;
    }
    better_waiting_.erase(counterpart);
    waiting_.pop_front();
    ++matched_;
  }
}

}  // namespace carom
