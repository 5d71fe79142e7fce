#pragma once
// The effects of a scene as TOML.

#include <carom/effects.hpp>

#include <Eigen/Core>

#include <string>

namespace carom::detail {

/// Returns the coordinates as TOML: "[0.5, 1.0]".
std::string pair_text(const Eigen::Vector2d& value);

/// Returns the one key of the obstacle's table, with its value: "disk = { centre = [0.0, 0.0], radius = 0.5 }".
std::string obstacle_text(const Obstacle& obstacle);

/// Returns the table [collision] and one for every effect that is there; each begins with an empty line.
std::string effects_toml(const Effects& effects);

/// Returns the effects that effects_toml() has written. Throws SceneError for other texts.
Effects parse_effects(const std::string& text);

}  // namespace carom::detail
