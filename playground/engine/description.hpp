#pragma once
// What the page is told of a scene.

#include "session.hpp"

#include <string>

namespace carom::playground {

/// Returns the scene of now as JSON: its box, species and effects, the engine that runs it, and what theory says of it.
std::string description(const Session& session);

}  // namespace carom::playground
