#pragma once
// Plain text made safe for HTML.

#include <string>
#include <string_view>

namespace carom::detail {

/// Safe between tags and inside a quoted attribute. Control characters, which HTML cannot hold, become U+FFFD.
std::string html_text(std::string_view text);

/// The same, with what stands between two `backquotes` as code. An odd one stays as it is.
std::string html_prose(std::string_view text);

/// A whole document, which is HTML and UTF-8 already, as the value of a quoted attribute.
std::string html_document_text(std::string_view document);

/// What a page lets the browser do: it fetches nothing, and shows what the file holds and pictures that its scripts make.
inline constexpr const char* page_policy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; base-uri 'none'; "
    "form-action 'none'";

}  // namespace carom::detail
