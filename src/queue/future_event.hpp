#pragma once
// The entries of the engine's future event lists.

#include <cstdint>

namespace carom {

/// The next event of a disk; `other` distinguishes events of one disk at one time.
struct FutureEvent {
  double time;
  std::int32_t disk;
  std::int32_t other;

  friend bool operator==(const FutureEvent&, const FutureEvent&) = default;
};

/// The disk of the next event and its time, infinity where none is left.
struct Upcoming {
  double time;
  std::int32_t disk;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(time, disk);
  }
};

}  // namespace carom
