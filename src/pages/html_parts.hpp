#pragma once
// Parts of an HTML page: embedded files, escaped text, and plots as JSON.

#include <carom/pages/page.hpp>

#include <span>
#include <string>
#include <string_view>

namespace carom::detail {

/// A file of a page (style, script, library) as it was when the library was built; embed_files.cmake writes them.
struct EmbeddedFile {
  std::string_view name;                     ///< its path below src/pages
  std::span<const std::string_view> pieces;  ///< its bytes, cut because compilers limit the length of a literal
};

std::span<const EmbeddedFile> embedded_files();

/// Returns the bytes of a file. Throws std::invalid_argument where there is none of that name.
std::string embedded_text(std::string_view name);

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

/// Returns a plot as JSON, from which the scripts of the page draw it and which other programs may read: {"id", "title", "x":
/// {"title", "log"}, "y", "series": [{"name", "group", "style", "visible", "x": [], "y": [], ...}], "marks"}. null stands for a
/// number that is not finite. Nothing in the text can end a script element. Throws std::invalid_argument where the lengths of a
/// series differ or its group is negative.
std::string plot_json(const Plot& plot);

}  // namespace carom::detail
