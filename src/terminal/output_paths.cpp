#include "terminal/output_paths.hpp"

#include "io/partial_file.hpp"
#include "terminal/command.hpp"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <system_error>

namespace carom::cli {

namespace fs = std::filesystem;

namespace {

bool is_page(const fs::path& path, std::string_view mark) {
  std::array<char, 512> begin{};
  std::ifstream file(path, std::ios::binary);
  file.read(begin.data(), begin.size());
  return std::string_view(begin.data(), static_cast<std::size_t>(file.gcount())).find(mark) != std::string_view::npos;
}

}  // namespace

fs::path named_after(const std::string& directory, const char* word) {
  fs::path name = fs::path(directory).lexically_normal();
  if (!name.has_filename()) name = name.parent_path();
  if (name.filename() == "." || name.filename() == "..") name = fs::weakly_canonical(name);
  name += word;
  return name;
}

fs::path place_for_page(const std::string& output, const fs::path& otherwise, const PageKind& kind) {
  const fs::path path = output.empty() ? otherwise : fs::path(output);
  if (path.extension() != ".html" && path.extension() != ".htm")
    throw UsageError(fmt::format("{} {}: the {} is an HTML page and nothing else; give it a name that ends in .html", kind.option,
                                 path.string(), kind.name));
  std::error_code error;
  if (fs::is_directory(path, error))
    throw UsageError(fmt::format("{} {}: this is a directory; name a file in it", kind.option, path.string()));
  if (fs::exists(path, error) && !is_page(path, kind.mark))
    throw UsageError(fmt::format("{}: this file is there already, and is no {}; name another one with {}, or remove it",
                                 path.string(), kind.name, kind.option));
  return path;
}

void write_whole_file(const fs::path& path, const std::string& text) {
  PartialFile file = as_usage_error([&] { return PartialFile(path); });
  file.write(text);
  file.publish();
}

}  // namespace carom::cli
