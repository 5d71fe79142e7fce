#pragma once
// Descriptions of files in words: the text of `carom info`.

#include "io/output_error.hpp"

#include <filesystem>
#include <string>
#include <utility>

namespace carom {

/// A directory in which some files cannot be described. The message is the sentence about the first of them.
struct PartlyDescribed : OutputError {
  PartlyDescribed(const std::string& fault, std::string described) : OutputError(fault), text(std::move(described)) {}
  std::string text;  ///< description of the other files
};

/// Describes a file that Carom wrote (also one of a run that still goes on, or was killed), a run directory, or a scene, in
/// a few lines. Throws OutputError for anything else, PartlyDescribed for a directory with a damaged file, and SceneError for a
/// scene with a mistake.
std::string describe_file(const std::filesystem::path& path);

}  // namespace carom
