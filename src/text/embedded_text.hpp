#pragma once
// Text files that are compiled in, as they were when the library was built.

#include <span>
#include <string_view>

namespace carom::detail {

struct EmbeddedText {
  std::string_view path;  ///< below the source tree: "docs/scenes/box.toml"
  std::string_view text;
};

}  // namespace carom::detail
