#pragma once
// Where a command puts what it makes of a run: a directory beside that of the run, or a page.

#include <filesystem>
#include <string>
#include <string_view>

namespace carom::cli {

/// Returns the path of a directory with a suffix behind its name: of "runs/gas/" and "-again", runs/gas-again. A path that ends
/// in "." or ".." names its directory only after links are followed.
[[nodiscard]] std::filesystem::path named_after(const std::string& directory, const char* word);

struct PageKind {
  std::string_view name;           ///< "player"
  std::string_view mark;           ///< mark in the first 512 bytes of every page of this kind
  std::string_view option = "-o";  ///< option that names the place of the page
};

/// `output` as the user gave it, or `otherwise` where it is empty. Throws UsageError where a page cannot go there: it is called
/// like no page, is a directory, or is there already and no page of this kind.
[[nodiscard]] std::filesystem::path place_for_page(const std::string& output, const std::filesystem::path& otherwise,
                                                   const PageKind& kind);

/// Under its own name only when it is whole. Throws UsageError where the place cannot be written to, OutputError where writing
/// fails later.
void write_whole_file(const std::filesystem::path& path, const std::string& text);

}  // namespace carom::cli
