#pragma once
// The files that make a page what it is (style, scripts, plotting library), as they were when the library was built.
// embed_files.cmake writes the definition.

#include <span>
#include <string>
#include <string_view>

namespace carom::detail {

struct EmbeddedFile {
  std::string_view name;                     ///< its path below src/pages
  std::span<const std::string_view> pieces;  ///< its bytes, cut because compilers limit the length of a literal
};

std::span<const EmbeddedFile> embedded_files();

/// Returns the bytes of a file. Throws std::invalid_argument where there is none of that name.
std::string embedded_text(std::string_view name);

}  // namespace carom::detail
