#pragma once
// The number and the width of the spans of the calendar, and whether many events are to be expected, by the last epoch.

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace carom {

/// The number of spans in the ring of a calendar for so many disks: a power of two, 0.094 to 0.19 of their number, so that few
/// events lie beyond it.
inline std::size_t calendar_spans(std::size_t disks) { return std::bit_ceil(std::max<std::size_t>(64, disks * 3 / 32)); }

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
    const double span = 16.0 * *median / static_cast<double>(times.size());
    constexpr double infinite = std::numeric_limits<double>::infinity();
    if (span > 0.0 && span < infinite)
      span_ = span;
    else if (longest < infinite)
      span_ = longest;
  }
  /// The mean time from one event to the next when the span was judged last.
  [[nodiscard]] double time_per_event() const { return span_ / events_per_span_; }
  /// Makes spans longer by that factor: as many events take so much longer where there are fewer disks.
  void lengthen_span(double factor) { span_ *= factor; }
  /// Whether the last epoch had a new event for every fourth disk or more.
  [[nodiscard]] bool busy() const { return busy_; }

  /// Counts events from time `now` of the epoch on, which may be its middle: the queue has been filled, and `pushed` counts the
  /// events that it ever got.
  void begin(double now, std::uint64_t pushed) { begun_at_ = now, begun_with_ = pushed; }
  /// Judges the time from begin() until `now`: `pushed` counts the events that the queue ever got by now.
  void judge(double now, std::uint64_t pushed, std::size_t disks) {
    const double elapsed = now - begun_at_;
    const std::uint64_t events = pushed - begun_with_;
    const bool enough = events > disks / 4 + 16;  // too few say nothing: an epoch may have been cut short
    events_per_span_ = std::clamp(3.0 * static_cast<double>(disks) / static_cast<double>(calendar_spans(disks)), fewest, most);
    if (enough) span_ = events_per_span_ * elapsed / static_cast<double>(events);
    if (elapsed > 0.0) busy_ = enough;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(span_, begun_at_, begun_with_, busy_);
  }

 private:
  /// Events per span: between 14 and 45 there is little difference in speed. More in a ring that is short for the number of
  /// disks, so that it is three events of each disk long.
  static constexpr double fewest = 24.0, most = 30.0;

  double span_ = 0.0;
  double events_per_span_ = fewest;
  double begun_at_ = 0.0;
  std::uint64_t begun_with_ = 0;
  bool busy_ = true;
};

}  // namespace carom
