#pragma once
// A value of a TOML document as text again, on one line.

#include <toml++/toml.h>

#include <string>
#include <string_view>

namespace carom::detail {

/// In quotes, with what TOML asks to be escaped.
std::string quoted_text(std::string_view text);

/// What stands behind the "=" of an override that gives this value. Dates have no meaning in a scene and come out as nothing.
std::string value_text(const toml::node& value);

}  // namespace carom::detail
