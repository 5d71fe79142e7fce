// Joins the pieces of embedded files.

#include "pages/embedded_files.hpp"

#include <stdexcept>

namespace carom::detail {

std::string embedded_text(std::string_view name) {
  for (const EmbeddedFile& file : embedded_files()) {
    if (file.name != name) continue;
    std::string text;
    for (const std::string_view piece : file.pieces) text += piece;
    return text;
  }
  throw std::invalid_argument("no embedded file is called " + std::string(name));
}

}  // namespace carom::detail
