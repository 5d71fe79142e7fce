#pragma once
// Scenes in text for the tests of this folder: a small valid one, and ways to change it.

#include <carom/scene.hpp>

#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace carom::test {

/// A box [0, 10] x [0, 8] with walls and ten disks of radius 0.25.
inline constexpr std::string_view small_scene = R"([box]
x = [0.0, 10.0]
y = [0.0, 8.0]
boundary = "walls"

[[disks]]
count = 10
radius = 0.25
mass = 1.0
positions = "random"
velocities = { uniform = 1.0 }

[collision]
rule = "specular"

[run]
time = 5.0
)";

/// The small scene with each `from` replaced by `to`; every `from` must occur.
inline std::string changed(std::initializer_list<std::pair<std::string_view, std::string_view>> changes,
                           std::string_view base = small_scene) {
  std::string text(base);
  for (const auto& [from, to] : changes) {
    const std::size_t at = text.find(from);
    if (at == std::string::npos) throw std::logic_error("the scene has no \"" + std::string(from) + "\" to change");
    text.replace(at, from.size(), to);
  }
  return text;
}

inline Scene parse_changed(std::initializer_list<std::pair<std::string_view, std::string_view>> changes) {
  return parse_scene(changed(changes));
}

}  // namespace carom::test
