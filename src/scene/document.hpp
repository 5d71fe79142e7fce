#pragma once
// Text files and TOML documents, read whole, with one sentence where one cannot be read; and overrides, "run.time=2", which
// change a document before a scene is read from it.

#include <toml++/toml.h>

#include <string>

namespace carom::detail {

/// Returns the bytes of a file of at most 1 GiB. Throws SceneError located at the path: missing, a directory, a device, no
/// permission, too large.
std::string read_text_file(const std::string& path);

/// Returns the TOML document in `text`; `source` stands in every location. Throws SceneError where it is not TOML.
toml::table parse_toml(const std::string& text, const std::string& source);

/// Returns whether a source name is that of an override ("--set run.time=2") and not of a file.
bool is_override(const std::string& source);

/// Applies "dotted.key=value" to the document. Numbers in the key are indices, from 0, into lists. Tables on the way
/// are made where they are missing. Throws SceneError where the text has not that form, or the way is barred.
void apply_override(toml::table& document, const std::string& text);

/// Returns the key of an override "key = value", without the blanks round it.
[[nodiscard]] std::string_view key_of_override(std::string_view text);

}  // namespace carom::detail
