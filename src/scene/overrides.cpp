// Each override is parsed as a small TOML document of its own, with itself as the source name: whatever is found wrong
// with its value later, the error then names the override and not a line of the file.

#include "scene/overrides.hpp"

#include "scene/excerpt.hpp"
#include "scene/table_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace carom::detail {
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

std::optional<std::size_t> as_index(const std::string& part) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
  const bool whole = error == std::errc() && end == part.data() + part.size();
  return whole ? std::optional(index) : std::nullopt;
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
    toml::table made = toml::parse(value == nullptr && as_index(parts_[i + 1]) ? "v = []" : "v = {}", where_.source);
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
    const std::optional<std::size_t> index = as_index(parts_[i]);
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

void apply_override(toml::table& document, const std::string& text) {
  const Location where{name_of(text), 0, 0};
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) throw SceneError(where, fmt::format("there is no \"=\" in it; {}", shape));
  const std::string_view key = trimmed(std::string_view(text).substr(0, equals));
  const std::string_view value = trimmed(std::string_view(text).substr(equals + 1));
  if (value.empty()) throw SceneError(where, fmt::format("there is no value behind \"=\"; {}", shape));
  toml::table parsed = parse_value(value, where);
  Walk(split_key(key, where), where).assign(document, *parsed.get("v"));
}

}  // namespace carom::detail
