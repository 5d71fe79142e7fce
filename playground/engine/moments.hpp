#pragma once
// Moments of a run to which the page goes back.

#include "live/live_run.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>

namespace carom::playground {

/// The start of a run and later moments of it, in order, as many as 64 MiB hold: old ones are thinned out.
class Moments {
 public:
  /// Keeps the moment that the run is in, unless it is the last one kept.
  void keep(const LiveRun& run) {
    if (!kept_.empty() && kept_.back().time == run.time() &&
        kept_.back().changes + kept_.back().own_changes == run.changes_made())
      return;
    kept_.push_back(run.moment());
    bytes_ += kept_.back().bytes.size();
    while (bytes_ > most_bytes && kept_.size() > 3) thin_out();
  }

  /// Forgets moments that come after so many events, and returns the last one left; null where there is none.
  const LiveRun::Moment* last_before(std::uint64_t events) {
    while (kept_.size() > 1 && kept_.back().events > events) {
      bytes_ -= kept_.back().bytes.size();
      kept_.pop_back();
    }
    return kept_.empty() || kept_.back().events > events ? nullptr : &kept_.back();
  }

 private:
  static constexpr std::size_t most_bytes = 64u << 20;

  /// Every other one of the older half goes; the start stays.
  void thin_out() {
    std::deque<LiveRun::Moment> kept;
    bytes_ = 0;
    for (std::size_t k = 0; k < kept_.size(); ++k) {
      if (k % 2 == 1 && k < kept_.size() / 2) continue;
      if (k > 0 && kept_.size() > 512 && k < kept_.size() / 4) continue;
      bytes_ += kept_[k].bytes.size();
      kept.push_back(std::move(kept_[k]));
    }
    if (kept.size() == kept_.size()) kept.erase(kept.begin() + 1);
    kept_ = std::move(kept);
  }

  std::deque<LiveRun::Moment> kept_;
  std::size_t bytes_ = 0;
};

}  // namespace carom::playground
