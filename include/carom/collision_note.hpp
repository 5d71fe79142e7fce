#pragma once

#include <cstdint>

namespace carom {

/// A collision as the event loop writes it down, where every instruction counts: its numbers as they are.
struct alignas(16) CollisionNote {
  double time;                                                      ///< since the epoch of the engine
  std::int32_t place, partner;                                      ///< where the two are in the engine's memory
  double before[2], partner_before[2], after[2], partner_after[2];  ///< velocities
};

}  // namespace carom
