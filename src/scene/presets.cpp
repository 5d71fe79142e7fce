// Looks presets up by name. Their texts are compiled in by embed_presets.cmake.

#include "scene/presets.hpp"

#include "scene/known_keys.hpp"
#include "scene/preset_texts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

namespace carom {

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  for (const detail::PresetText& text : detail::preset_texts()) names.emplace_back(text.name);
  return names;
}

std::string preset(const std::string& name) {
  std::vector<std::string_view> names;
  for (const detail::PresetText& text : detail::preset_texts()) {
    if (text.name == name) return std::string(text.toml);
    names.push_back(text.name);
  }
  const std::string_view near = detail::nearest_word(name, names);
  throw std::invalid_argument(near.empty()
                                  ? fmt::format("there is no preset \"{}\"; the presets are {}", name, fmt::join(names, ", "))
                                  : fmt::format("there is no preset \"{}\"; did you mean \"{}\"?", name, near));
}

}  // namespace carom
