#pragma once
// What the engine's future event lists hold.

#include <cstdint>

namespace carom {

/// What a disk's next event is: `other` tells events of one disk at one time apart.
struct FutureEvent {
  double time;
  std::int32_t disk;
  std::int32_t other;

  friend bool operator==(const FutureEvent&, const FutureEvent&) = default;
};

/// Which disk's event comes next, and when: infinity where none is left.
struct Upcoming {
  double time;
  std::int32_t disk;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(time, disk);
  }
};

}  // namespace carom
