#pragma once

#include "core/instant.hpp"

#include <carom/collisions.hpp>

#include <functional>
#include <span>

namespace carom {

/// Functions that an engine calls in the middle of an event: they must neither touch the engine nor throw.
struct CollisionListener {
  /// Takes collisions, whose times count from `epoch`.
  std::function<void(const Instant& epoch, std::span<const CollisionRecord> records)> on_collisions;
  /// Returns the memory for the next records until they are taken. Where it is not there, or returns none, they are written in
  /// memory of the engine.
  std::function<std::span<CollisionRecord>()> room;

  [[nodiscard]] explicit operator bool() const { return static_cast<bool>(on_collisions); }
};

}  // namespace carom
