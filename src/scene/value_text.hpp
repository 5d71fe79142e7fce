#pragma once
// Values as TOML text.

#include <toml++/toml.h>

#include <string>
#include <string_view>

namespace carom::detail {

/// Returns the fewest digits that read back to the same bits, and always a TOML float: "1.0", "0.1", "1e-300", "-0.0", "inf".
std::string number_text(double value);

/// Returns `text` in quotes, escaped as TOML requires.
std::string quoted_text(std::string_view text);

/// Returns the text behind the "=" of an override that gives this value. Dates have no meaning in a scene and give empty text.
std::string value_text(const toml::node& value);

}  // namespace carom::detail
