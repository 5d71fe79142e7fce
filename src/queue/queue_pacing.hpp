#pragma once
// The width of the spans of the calendar, and whether many events are to be expected, by the last epoch.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace carom {

class QueuePacing {
 public:
  /// The length of a span; 0 before the first call of choose_span() or judge().
  [[nodiscard]] double span() const { return span_; }
  /// Chooses the first span from the times of the next events of all disks: half of them come within the median. `longest` is the
  /// end of the epoch, or infinity.
  void choose_span(std::vector<double> times, double longest) {
    span_ = 1.0;
    if (times.empty()) return;
    const auto median = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
    std::nth_element(times.begin(), median, times.end());
    const double span = 4.0 * *median / static_cast<double>(times.size());
    constexpr double infinite = std::numeric_limits<double>::infinity();
    if (span > 0.0 && span < infinite)
      span_ = span;
    else if (longest < infinite)
      span_ = longest;
  }
  /// Whether the last epoch had a new event for every fourth disk or more.
  [[nodiscard]] bool busy() const { return busy_; }

  /// Counts events from here: the queue has been filled, and `pushed` counts the events that it ever got.
  void begin(std::uint64_t pushed) { begun_with_ = pushed; }
  /// Judges the time `elapsed` since begin(): `pushed` counts now the events that the queue ever got.
  void judge(double elapsed, std::uint64_t pushed, std::size_t disks) {
    const std::uint64_t events = pushed - begun_with_;
    const bool enough = events > disks / 4 + 16;  // too few say nothing: an epoch may have been cut short
    if (enough) span_ = events_per_span * elapsed / static_cast<double>(events);
    if (elapsed > 0.0) busy_ = enough;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(span_, begun_with_, busy_);
  }

 private:
  /// Between two and eight there is no difference in speed; fewer take more memory.
  static constexpr double events_per_span = 6.0;

  double span_ = 0.0;
  std::uint64_t begun_with_ = 0;
  bool busy_ = true;
};

}  // namespace carom
