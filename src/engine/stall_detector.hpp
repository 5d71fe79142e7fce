#pragma once
// Why an engine can go no further: time stands still, speeds are too small to compute with, or a velocity is not finite.

#include "effects/plain_world.hpp"
#include "effects/vanishing.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace carom {

class StallDetector {
 public:
  /// `effects` and the number of disks decide after how many events at one instant time is taken to stand still.
  StallDetector(const Effects& effects, std::size_t disks)
      : patience_((effects.dissipate() ? 100'000 : 10'000'000) + 100 * static_cast<std::uint64_t>(disks)),
        dissipates_(effects.dissipate()),
        may_cool_(dissipates_ && effects.acceleration().isZero(0.0)) {}

  /// Counts an event, which is later than the event before it or at the same instant.
  void count_event(bool later) { at_one_instant_ = later ? 0 : at_one_instant_ + 1; }
  /// Does so for an event at `time` where contacts may take energy. It is at the same instant where rounding alone keeps disks
  /// apart that close in on each other, or a disk from the wall that it rests on.
  void count_event(double time, double now) {
    const bool later = time > now + instant_ && time > resting_until_;
    if (later) rests_ = 0;
    count_event(later);
  }

  /// Records that a disk has come to rest on a wall that its weight presses it to, by an event at `now` (Walls::Hit::rest): what
  /// follows within `rest` of it is at one instant. Beside a wall that moves, rounding lets the disk fall by a step of its
  /// coordinate again and again, and time with it.
  void record_rest(double now, double rest) {
    if (!(rest > 0.0)) return;
    resting_until_ = now + rest;
    ++rests_;
  }
  /// The number of record_rest() since time last advanced.
  [[nodiscard]] std::uint64_t rests() const { return rests_; }
  /// Begins an epoch, from which times count. Rests before it do not: disks that rest now and then, among many others, never have
  /// as many events in an epoch as patience takes.
  void begin_epoch() { resting_until_ = 0.0, rests_ = 0; }
  /// Takes the length of the epoch, whose last ulps of time are one instant: coordinates are rounded by as much.
  void set_epoch_length(double length) { instant_ = dissipates_ && length < infinity<double> ? 0x1p-50 * length : 0.0; }

  /// Whether the engine can go no further: time stands still, as for disks that touch on all sides and still are to move, or one
  /// of the functions below has found another reason.
  [[nodiscard]] bool is_stalled() const { return at_one_instant_ > patience_; }

  /// Records that these disks, or a disk and a wall, lost a share of a speed of such a `smallness` (effects/vanishing.hpp). At
  /// the end of a series of events at one instant that is a collapse: its speeds vanish, and no event follows, before patience
  /// ends.
  template <class Real>
  void record_loss(Real smallness, std::initializer_list<std::int32_t> disks) {
    if (!squares_vanish(smallness)) return;
    if (at_one_instant_ < recorded_at_) slow_.clear();  // time has gone on since
    recorded_at_ = at_one_instant_;
    for (const std::int32_t disk : disks)
      if (std::find(slow_.begin(), slow_.end(), disk) == slow_.end()) slow_.push_back(disk);
    if (vanishes(smallness) && at_one_instant_ >= series) at_one_instant_ = recorded_at_ = stalled;
  }
  /// The ids of the disks whose vanishing speeds stalled the engine; empty where another reason did.
  [[nodiscard]] std::vector<std::int32_t> stalled_disks() const {
    return recorded_at_ == stalled ? slow_ : std::vector<std::int32_t>();
  }

  /// Stalls the engine as cooled where speeds at the beginning of an epoch are too small to compute with (engine/epoch.hpp) and
  /// nothing will raise them.
  void check_speeds(bool too_slow) {
    if (may_cool_ && too_slow) cooled_ = true, at_one_instant_ = stalled;
  }
  /// Whether the engine stalled because speeds have become too small to compute with.
  [[nodiscard]] bool cooled() const { return cooled_; }

  /// Stalls the engine before a velocity that would not be finite. `what` is a sentence without its full stop.
  void fail(std::string what) { fault_ = std::move(what), at_one_instant_ = stalled; }
  /// The argument of fail(); empty where nothing failed.
  [[nodiscard]] const std::string& fault() const { return fault_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(at_one_instant_, recorded_at_, instant_, resting_until_, rests_, slow_, cooled_, fault_);
  }

 private:
  static constexpr std::uint64_t stalled = std::numeric_limits<std::uint64_t>::max();
  /// Events: fewer than a collapse takes to bring a speed from 1 to nothing, a hundred halvings in single precision.
  static constexpr std::uint64_t series = 64;

  std::uint64_t patience_;            ///< events at one instant after which time is taken to stand still
  bool dissipates_;                   ///< contacts take energy
  bool may_cool_;                     ///< collisions take energy, and nothing brings it back by itself
  std::uint64_t at_one_instant_ = 0;  ///< events since time last advanced; `stalled` for any other reason
  std::uint64_t recorded_at_ = 0;     ///< what that was at the last record_loss() of a speed whose square vanishes
  double instant_ = 0.0;              ///< time within which events count as at one instant
  double resting_until_ = 0.0;        ///< time since the epoch
  std::uint64_t rests_ = 0;
  std::vector<std::int32_t> slow_;
  bool cooled_ = false;
  std::string fault_;
};

}  // namespace carom
