#include "scene/document.hpp"

#include "scene/excerpt.hpp"
#include "scene/table_reader.hpp"
#include "text/number_in.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

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

namespace {

constexpr std::string_view prefix = "--set ";
constexpr const char* shape = "an override looks like run.time=2 or disks.0.radius=0.05";

std::string name_of(const std::string& text) { return std::string(prefix) + excerpt(text, 80); }

std::vector<std::string> split_key(std::string_view key, const Location& where) {
  constexpr std::size_t deepest = 8;
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= key.size();) {
    const std::size_t end = std::min(key.find('.', begin), key.size());
    const std::string_view part = trimmed(key.substr(begin, end - begin));
    const bool bare = !part.empty() && std::all_of(part.begin(), part.end(),
                                                   [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; });
    if (!bare || parts.size() == deepest)
      throw SceneError(where, fmt::format("\"{}\" is not a dotted key; {}", excerpt(key, 60), shape));
    parts.emplace_back(part);
    begin = end + 1;
  }
  return parts;
}

/// Returns the table { v = <value> }, each node of it with the override as its source.
toml::table parse_value(std::string_view value, const Location& where) {
  try {
    toml::table parsed = toml::parse(fmt::format("v = {}", value), where.source);
    if (parsed.size() == 1 && parsed.contains("v")) return parsed;
  } catch (const toml::parse_error&) {
    // Not TOML: a bare word is meant as a string, so that --set box.boundary=periodic works without quotes in quotes.
  }
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  const bool starts_like_a_word = std::isalpha(static_cast<unsigned char>(value.front())) != 0 || value.front() == '_' ||
                                  value.front() == '/' || value.front() == '.';
  if (starts_like_a_word && std::none_of(value.begin(), value.end(), is_control)) {
    toml::table parsed = toml::parse("v = \"\"", where.source);
    parsed.get("v")->as_string()->get() = std::string(value);
    return parsed;
  }
  throw SceneError(where, fmt::format("the value is not TOML; {}", shape));
}

std::string joined(const std::vector<std::string>& parts, std::size_t count) {
  return fmt::format("{}", fmt::join(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(count), "."));
}

class Walk {
 public:
  Walk(std::vector<std::string> parts, Location where) : parts_(std::move(parts)), where_(std::move(where)) {}

  void assign(toml::table& document, toml::node& value) const {
    toml::node* here = &document;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const bool last = i + 1 == parts_.size();
      here =
          here->is_table() ? step(*here->as_table(), i, last ? &value : nullptr) : step_list(*here, i, last ? &value : nullptr);
    }
  }

 private:
  /// Puts `value` under part i of the table, or finds what is there, or makes what is missing.
  toml::node* step(toml::table& table, std::size_t i, toml::node* value) const {
    toml::node* found = table.get(parts_[i]);
    if (value == nullptr && found != nullptr) return found;
    const toml::key key(parts_[i], toml::source_region{{1, 1}, {1, 1}, std::make_shared<const std::string>(where_.source)});
    toml::table made =
        toml::parse(value == nullptr && number_in<std::size_t>(parts_[i + 1]) ? "v = []" : "v = {}", where_.source);
    table.insert_or_assign(key, std::move(value == nullptr ? *made.get("v") : *value));
    return table.get(parts_[i]);
  }

  toml::node* step_list(toml::node& node, std::size_t i, toml::node* value) const {
    toml::array* list = node.as_array();
    const std::string way = joined(parts_, i);
    if (list == nullptr) {
      throw SceneError(where_,
                       fmt::format("{} is {} and has no part \"{}\"; set {} as a whole", way, describe(node), parts_[i], way));
    }
    const std::optional<std::size_t> index = number_in<std::size_t>(parts_[i]);
    if (!index) {
      throw SceneError(where_, fmt::format("{} is a list, so a number from 0 must follow it, such as {}.0; found \"{}\"", way,
                                           way, parts_[i]));
    }
    // A whole entry may be added at the end of a list; a key of an entry that is not there is a slip in counting.
    if (*index > list->size() || (*index == list->size() && value == nullptr && !list->empty())) {
      throw SceneError(where_, fmt::format("{} has {} {}, numbered from 0, so there is no {}.{}", way, list->size(),
                                           list->size() == 1 ? "entry" : "entries", way, *index));
    }
    if (value == nullptr && *index < list->size()) return list->get(*index);
    toml::table made = toml::parse("v = {}", where_.source);
    toml::node& fresh = value == nullptr ? *made.get("v") : *value;
    if (*index == list->size()) {
      list->push_back(std::move(fresh));
    } else {
      list->replace(list->cbegin() + static_cast<std::ptrdiff_t>(*index), std::move(fresh));
    }
    return list->get(*index);
  }

  std::vector<std::string> parts_;
  Location where_;
};

}  // namespace

bool is_override(const std::string& source) { return source.starts_with(prefix); }

std::string_view key_of_override(std::string_view text) { return trimmed(text.substr(0, text.find('='))); }

void apply_override(toml::table& document, const std::string& text) {
  const Location where{name_of(text), 0, 0};
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) throw SceneError(where, fmt::format("there is no \"=\" in it; {}", shape));
  const std::string_view key = key_of_override(text);
  const std::string_view value = trimmed(std::string_view(text).substr(equals + 1));
  if (value.empty()) throw SceneError(where, fmt::format("there is no value behind \"=\"; {}", shape));
  toml::table parsed = parse_value(value, where);
  Walk(split_key(key, where), where).assign(document, *parsed.get("v"));
}

}  // namespace carom::detail
