#pragma once
// The example scenes as they were when the library was built. embed_presets.cmake writes the definition.

#include <span>
#include <string_view>

namespace carom::detail {

struct PresetText {
  std::string_view name;
  std::string_view toml;
};

std::span<const PresetText> preset_texts();

}  // namespace carom::detail
