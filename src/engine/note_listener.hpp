#pragma once

#include "core/instant.hpp"

#include <carom/collisions.hpp>

#include <functional>
#include <span>

namespace carom {

/// Called in the middle of an event: it must neither touch the engine nor throw.
struct NoteListener {
  /// Hears of collisions, whose times count from `epoch`.
  std::function<void(const Instant& epoch, std::span<const CollisionNote> notes)> hear;
  /// Where the next notes are to be written, until they are told; not there, or empty: in memory of the engine.
  std::function<std::span<CollisionNote>()> room;

  [[nodiscard]] explicit operator bool() const { return static_cast<bool>(hear); }
};

}  // namespace carom
