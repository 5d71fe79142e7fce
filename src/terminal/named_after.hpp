#pragma once
// Names of directories for results made from a directory: beside it, with a suffix.

#include <filesystem>
#include <string>

namespace carom::cli {

/// Returns the path of a directory with a suffix behind its name: of "runs/gas/" and "-again", runs/gas-again.
inline std::filesystem::path named_after(const std::string& directory, const char* word) {
  const std::filesystem::path name = std::filesystem::path(directory).lexically_normal();
  std::filesystem::path beside = name.has_filename() ? name : name.parent_path();
  beside += word;
  return beside;
}

}  // namespace carom::cli
