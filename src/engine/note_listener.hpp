#pragma once

#include "core/instant.hpp"

#include <carom/collisions.hpp>

#include <functional>
#include <span>

namespace carom {

/// Hears of collisions, whose times count from `epoch`. It is called in the middle of an event: it must neither touch the engine
/// nor throw.
using NoteListener = std::function<void(const Instant& epoch, std::span<const CollisionNote> notes)>;

}  // namespace carom
