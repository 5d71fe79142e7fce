#pragma once
// A value of a TOML document as text again, on one line.

#include <toml++/toml.h>

#include <string>
#include <string_view>

namespace carom::detail {

/// Returns `text` in quotes, escaped as TOML requires.
std::string quoted_text(std::string_view text);

/// Returns the text behind the "=" of an override that gives this value. Dates have no meaning in a scene and give empty text.
std::string value_text(const toml::node& value);

}  // namespace carom::detail
