#pragma once
// The example scenes of docs/scenes, for tests that go over all of them.

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace carom::test {

/// Of the checkout.
inline const std::filesystem::path docs = std::filesystem::path(CAROM_SOURCE_DIR) / "docs";

inline std::vector<std::string> example_scenes() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(CAROM_SOURCE_DIR "/docs/scenes"))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

inline std::string example_path(const std::string& name) { return CAROM_SOURCE_DIR "/docs/scenes/" + name + ".toml"; }

}  // namespace carom::test
