#pragma once
// Plain text made safe for HTML.

#include <string>
#include <string_view>

namespace carom::detail {

/// Safe between tags and inside a quoted attribute. Control characters, which HTML cannot hold, become U+FFFD.
std::string html_text(std::string_view text);

/// Escapes text for HTML, with text between two `backquotes` as code. An odd backquote stays as it is.
std::string html_prose(std::string_view text);

/// Returns a whole document, which is HTML and UTF-8 already, as the value of a quoted attribute.
std::string html_document_text(std::string_view document);

/// The content security policy of a page: the browser fetches nothing, and shows only the file and pictures that its scripts
/// make.
inline constexpr const char* page_policy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; base-uri 'none'; "
    "form-action 'none'";

}  // namespace carom::detail
