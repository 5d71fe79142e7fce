#pragma once
// Descriptions of files in words: the text of `carom info`.

#include "io/output_error.hpp"

#include <filesystem>
#include <string>

namespace carom {

/// Describes a file that Carom wrote (also one of a run that still goes on, or was killed), a run directory, or a scene, in
/// a few lines. Throws OutputError for anything else, and SceneError for a scene with a mistake.
std::string describe_file(const std::filesystem::path& path);

}  // namespace carom
