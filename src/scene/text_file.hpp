#pragma once
// Reads whole text files and TOML documents, and says in one sentence why one cannot be read.

#include <toml++/toml.h>

#include <string>

namespace carom::detail {

/// Returns the bytes of a file of at most 1 GiB. Throws SceneError located at the path: missing, a directory, a device, no
/// permission, too large.
std::string read_text_file(const std::string& path);

/// Returns the TOML document in `text`; `source` stands in every location. Throws SceneError where it is not TOML.
toml::table parse_toml(const std::string& text, const std::string& source);

}  // namespace carom::detail
