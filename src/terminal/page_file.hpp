#pragma once
// The file of a page about a run, and how it is written: a page of the same kind may be replaced, no other file is.

#include <filesystem>
#include <string>
#include <string_view>

namespace carom::cli {

struct PageKind {
  std::string_view name;  ///< "player"
  std::string_view mark;  ///< mark in the first 512 bytes of every page of this kind
};

/// `output` as the user gave it, or `otherwise` where it is empty. Throws UsageError where a page cannot go there: it is called
/// like no page, is a directory, or is there already and no page of this kind.
[[nodiscard]] std::filesystem::path place_for_page(const std::string& output, const std::filesystem::path& otherwise,
                                                   const PageKind& kind);

/// Under its own name only when it is whole. Throws UsageError where the place cannot be written to, OutputError where writing
/// fails later.
void write_page(const std::filesystem::path& path, const std::string& text);

}  // namespace carom::cli
