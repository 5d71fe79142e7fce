#pragma once
// Why an engine can go no further: time stands still, speeds are too small to compute with, or a velocity is not finite.

#include "effects/vanishing.hpp"
#include "effects/world.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace carom {

class Ending {
 public:
  Ending(const Effects& effects, std::size_t disks)
      : patience_((effects.dissipate() ? 100'000 : 10'000'000) + 100 * static_cast<std::uint64_t>(disks)),
        may_cool_(effects.dissipate() && !(effects.gravity && !effects.gravity->acceleration.isZero(0.0))) {}

  /// There is an event, later than the one before or at its instant.
  void count(bool later) { at_one_instant_ = later ? 0 : at_one_instant_ + 1; }

  /// Whether it is the end: so many events at one instant that time stands still, or what one of the functions below has said.
  [[nodiscard]] bool has_come() const { return at_one_instant_ > patience_; }

  /// These disks, or a disk and a wall, have met at such a `smallness` (effects/vanishing.hpp), and lost a share of it. At the
  /// end of a series of events at one instant that is a collapse: its speeds vanish, and no event follows, before patience ends.
  template <class Real>
  void note_loss(Real smallness, std::initializer_list<std::int32_t> disks) {
    if (!squares_vanish(smallness)) return;
    if (at_one_instant_ < noted_at_) slow_.clear();  // time has gone on since
    noted_at_ = at_one_instant_;
    for (const std::int32_t disk : disks)
      if (std::find(slow_.begin(), slow_.end(), disk) == slow_.end()) slow_.push_back(disk);
    if (vanishes(smallness) && at_one_instant_ >= series) at_one_instant_ = noted_at_ = end;
  }
  /// Where that is the end, those who met so.
  [[nodiscard]] std::vector<std::int32_t> slow() const { return noted_at_ == end ? slow_ : std::vector<std::int32_t>(); }

  /// Speeds are what they are at the beginning of an epoch.
  void note_speeds(bool too_slow) {
    if (may_cool_ && too_slow) cooled_ = true, at_one_instant_ = end;
  }
  [[nodiscard]] bool cooled() const { return cooled_; }

  /// A velocity would not be finite. `what`: a sentence without its full stop.
  void fail(std::string what) { fault_ = std::move(what), at_one_instant_ = end; }
  [[nodiscard]] const std::string& fault() const { return fault_; }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(at_one_instant_, noted_at_, slow_, cooled_, fault_);
  }

 private:
  static constexpr std::uint64_t end = std::numeric_limits<std::uint64_t>::max();
  /// Events: fewer than a collapse takes to bring a speed from 1 to nothing, a hundred halvings in single precision.
  static constexpr std::uint64_t series = 64;

  std::uint64_t patience_;            ///< events at one instant after which time is taken to stand still
  bool may_cool_;                     ///< collisions take energy, and nothing brings it back by itself
  std::uint64_t at_one_instant_ = 0;  ///< events since time last advanced
  std::uint64_t noted_at_ = 0;        ///< what that was at the last call of note_loss() that meant something
  std::vector<std::int32_t> slow_;
  bool cooled_ = false;
  std::string fault_;
};

}  // namespace carom
