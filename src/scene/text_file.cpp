// Files and TOML documents from anywhere: also from a wrong path, a device, or 10 MB of garbage.

#include "scene/text_file.hpp"

#include "scene/excerpt.hpp"
#include "scene/table_reader.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

namespace carom::detail {
namespace {

/// A key of ten thousand dotted parts is legal TOML and becomes as many nested tables, which no stack survives when they
/// are destroyed. The format needs three parts; this many leave room for the "unknown key" sentence to be given instead.
constexpr int most_key_parts = 16;

/// Throws where a key has more parts than that. Follows strings and comments just far enough to ignore the dots in them.
void check_key_depth(const std::string& text, const std::string& source) {
  int line = 1;
  int dots = 0;
  const auto skip_string = [&](std::size_t i) {
    const char quote = text[i];
    const bool multiline = text.compare(i, 3, std::string(3, quote)) == 0;
    for (i += multiline ? 3 : 1; i < text.size(); ++i) {
      if (text[i] == '\n') {
        if (!multiline) return i - 1;
        ++line;
      }
      if (text[i] == '\\' && quote == '"') {
        ++i;
      } else if (text[i] == quote && (!multiline || text.compare(i, 3, std::string(3, quote)) == 0)) {
        return multiline ? i + 2 : i;
      }
    }
    return i;
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      i = skip_string(i);
    } else if (c == '#') {
      i = std::min(text.find('\n', i), text.size()) - 1;
    } else if (c == '.') {
      if (++dots >= most_key_parts) {
        throw SceneError({source, line, 1},
                         fmt::format("a key here has more than {} dotted parts; a scene's longest key has 3", most_key_parts));
      }
    } else if (c == '\n' || c == '=' || c == ',' || c == '{' || c == '[') {
      dots = 0;
      line += c == '\n' ? 1 : 0;
    }
  }
}

}  // namespace

std::string read_text_file(const std::string& path) {
  constexpr std::size_t largest = std::size_t{1} << 30;
  const Location where{path, 0, 0};
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw SceneError(where, "there is no such file; check the path");
  if (std::filesystem::is_directory(status)) throw SceneError(where, "this is a directory; give the path of a file in it");
  // A device may never end, or wait for input. Pipes do end.
  if (std::filesystem::is_character_file(status) || std::filesystem::is_block_file(status)) {
    throw SceneError(where, "this is a device; give the path of a file");
  }
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  const auto reason = [] { return std::generic_category().message(errno); };
  if (!file) throw SceneError(where, fmt::format("the file cannot be opened ({}); check its permissions", reason()));
  std::string text;
  constexpr std::size_t block = std::size_t{1} << 20;
  for (std::size_t got = block; got == block;) {
    const std::size_t before = text.size();
    if (before > largest) throw SceneError(where, "the file is larger than 1 GiB; split it or use fewer disks");
    text.resize(before + block);
    got = std::fread(text.data() + before, 1, block, file.get());
    text.resize(before + got);
  }
  if (std::ferror(file.get()) != 0) throw SceneError(where, fmt::format("the file cannot be read ({})", reason()));
  return text;
}

toml::table parse_toml(const std::string& text, const std::string& source) {
  check_key_depth(text, source);
  try {
    return toml::parse(text, source);
  } catch (const toml::parse_error& error) {
    std::string_view reason = error.description();
    if (reason.starts_with("Error ")) reason.remove_prefix(6);  // "Error while parsing ...": "while parsing ..." says as much
    throw SceneError(location_of(error.source()), fmt::format("this is not TOML: {}", excerpt(reason, 300)));
  }
}

}  // namespace carom::detail
