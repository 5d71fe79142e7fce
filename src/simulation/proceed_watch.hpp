#pragma once
// Asks the caller of a run by the clock whether it may go on.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>

namespace carom::detail {

/// Asks a function some twenty times a second, whatever an event takes: from a tenth of a microsecond in double precision to some
/// microseconds in 113 bits.
class ProceedWatch {
 public:
  /// `proceed` may be empty, and must live as long as this.
  explicit ProceedWatch(const std::function<bool()>& proceed) : proceed_(proceed) {}

  /// Returns how many events may happen before stopped() is called again.
  [[nodiscard]] std::uint64_t events() const { return proceed_ ? events_ : most_events; }

  /// Looks at the clock and, where it is time, asks. Returns whether the answer was to stop.
  [[nodiscard]] bool stopped() {
    if (!proceed_) return false;
    const Clock::time_point now = Clock::now();
    if (now - looked_ < interval / 4) events_ = std::min(2 * events_, most_events);
    if (now - looked_ > interval / 2) events_ = std::max<std::uint64_t>(events_ / 2, 1);
    looked_ = now;
    if (now - asked_ < interval) return false;
    const bool stop = !proceed_();
    asked_ = looked_ = Clock::now();
    return stop;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds interval{50};
  static constexpr std::uint64_t most_events = 1'000'000;  ///< some tenths of a second

  const std::function<bool()>& proceed_;
  std::uint64_t events_ = 1024;
  Clock::time_point looked_ = Clock::now(), asked_ = looked_;
};

}  // namespace carom::detail
