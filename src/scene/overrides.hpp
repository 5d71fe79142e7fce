#pragma once
// Changes to a scene from the command line: "run.time=2" replaces one value of the TOML document before it is read.

#include <toml++/toml.h>

#include <string>

namespace carom::detail {

/// Returns whether a source name is that of an override ("--set run.time=2") and not of a file.
bool is_override(const std::string& source);

/// Applies "dotted.key=value" to the document. Numbers in the key are indices, from 0, into lists. Tables on the way
/// are made where they are missing. Throws SceneError where the text has not that form, or the way is barred.
void apply_override(toml::table& document, const std::string& text);

}  // namespace carom::detail
