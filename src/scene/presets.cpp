// Looks presets up by name. Their texts are listed in embed_presets.cmake.

#include "scene/presets.hpp"

#include "scene/known_keys.hpp"
#include "text/embedded_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <span>
#include <stdexcept>

namespace carom {

namespace detail {
std::span<const EmbeddedText> preset_texts();
}

namespace {

std::string name_of(const detail::EmbeddedText& text) { return std::filesystem::path(text.path).stem().string(); }

}  // namespace

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  for (const detail::EmbeddedText& text : detail::preset_texts()) names.push_back(name_of(text));
  return names;
}

std::string preset(const std::string& name) {
  for (const detail::EmbeddedText& text : detail::preset_texts())
    if (name_of(text) == name) return std::string(text.text);
  const std::vector<std::string> names = preset_names();
  const std::string_view near = detail::nearest_word(name, std::vector<std::string_view>(names.begin(), names.end()));
  throw std::invalid_argument(near.empty()
                                  ? fmt::format("there is no preset \"{}\"; the presets are {}", name, fmt::join(names, ", "))
                                  : fmt::format("there is no preset \"{}\"; did you mean \"{}\"?", name, near));
}

}  // namespace carom
