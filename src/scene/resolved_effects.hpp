#pragma once
// The effects of a scene as TOML.

#include <carom/effects.hpp>

#include <string>

namespace carom::detail {

/// Returns the table [collision] and one for every effect that is there; each begins with an empty line.
std::string effects_toml(const Effects& effects);

/// Returns the effects that effects_toml() has written. Throws SceneError for other texts.
Effects parse_effects(const std::string& text);

}  // namespace carom::detail
