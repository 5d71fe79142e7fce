#pragma once

#include <cstdint>

namespace carom {

/// A collision of two disks as the event loop records it: only numbers that it has already computed.
struct alignas(16) CollisionRecord {
  double time;                                              ///< since the epoch of CollisionRecords
  std::int32_t slot_i, slot_j;                              ///< of the two disks; DiskTable has their ids
  double before_i[2], before_j[2], after_i[2], after_j[2];  ///< velocities
};

}  // namespace carom
