// Reads TOML values with sentences for everything that can be wrong with them.

#include "scene/table_reader.hpp"

#include "scene/document.hpp"
#include "scene/excerpt.hpp"
#include "scene/known_keys.hpp"
#include "scene/value_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

namespace carom::detail {

Location location_of(const toml::source_region& region) {
  const std::string source = region.path ? *region.path : std::string();
  if (is_override(source)) return {source, 0, 0};
  // Tables that only exist through a dotted header of a sub-table have no place of their own.
  return {source, std::max(1, static_cast<int>(region.begin.line)), std::max(1, static_cast<int>(region.begin.column))};
}

Location location_of(const toml::node& node) { return location_of(node.source()); }

std::string describe(const toml::node& node) {
  constexpr std::size_t longest = 40;
  if (const auto* text = node.as_string()) {
    return fmt::format("a string (\"{}\")", excerpt(text->get(), longest));
  }
  if (const auto* integer = node.as_integer()) return fmt::format("an integer ({})", integer->get());
  if (const auto* number = node.as_floating_point())
    return fmt::format("a floating-point number ({})", number_text(number->get()));
  if (const auto* flag = node.as_boolean()) return fmt::format("a boolean ({})", flag->get());
  if (const auto* list = node.as_array()) return list->empty() ? "an empty list" : fmt::format("a list of {}", list->size());
  if (node.is_table()) return "a table";
  return "a date or time";
}

void refuse(const toml::node& node, const std::string& path, const std::string& expected) {
  throw SceneError(location_of(node), fmt::format("{} is {}; it must be {}", path, describe(node), expected));
}

Location place_of(const toml::table& document, std::string_view path) {
  const toml::node* node = &document;
  while (!path.empty()) {
    const std::string_view key = path.substr(0, path.find('.'));
    const toml::node* next = nullptr;
    if (const toml::table* table = node->as_table()) next = table->get(key);
    if (const toml::array* list = node->as_array()) {
      std::size_t index = 0;
      const bool is_number = std::from_chars(key.data(), key.data() + key.size(), index).ec == std::errc();
      next = is_number ? list->get(index) : nullptr;
    }
    if (next == nullptr) break;
    node = next;
    path.remove_prefix(std::min(key.size() + 1, path.size()));
  }
  return location_of(*node);
}

double read_number(const toml::node& node, const std::string& path, const NumberKey& key) {
  if (!node.is_number()) refuse(node, path, key.expected());
  const double value = node.is_integer() ? static_cast<double>(node.as_integer()->get()) : node.as_floating_point()->get();
  if (!key.holds(value)) refuse(node, path, key.expected());
  return value;
}

std::optional<std::int64_t> whole_number(const toml::node& node) {
  constexpr double most = 9007199254740992.0;  // 2^53: below it every whole number is a double of its own
  if (const auto* integer = node.as_integer()) return integer->get();
  const auto* number = node.as_floating_point();
  const bool whole = number != nullptr && std::abs(number->get()) <= most && std::trunc(number->get()) == number->get();
  return whole ? std::optional(static_cast<std::int64_t>(number->get())) : std::nullopt;
}

std::int64_t read_integer(const toml::node& node, const std::string& path, const std::string& example) {
  const std::optional<std::int64_t> number = whole_number(node);
  if (!number || *number < 0) refuse(node, path, "a whole number, zero or more, such as " + example);
  return *number;
}

bool read_switch(const toml::node& node, const std::string& path, const std::string& example) {
  if (!node.is_boolean()) refuse(node, path, "true or false, such as " + example);
  return node.as_boolean()->get();
}

std::string read_string(const toml::node& node, const std::string& path, const std::string& example) {
  if (!node.is_string()) refuse(node, path, "a string, such as " + example);
  return node.as_string()->get();
}

Eigen::Vector2d read_pair(const toml::node& node, const std::string& path, std::string_view example) {
  const toml::array* list = node.as_array();
  if (list == nullptr || list->size() != 2) refuse(node, path, fmt::format("two numbers in brackets, such as {}", example));
  const double first = read_number((*list)[0], path + ".0", {"", example});
  const double second = read_number((*list)[1], path + ".1", {"", example});
  return {first, second};
}

std::vector<double> read_numbers(const toml::array& list, const std::string& path, const NumberKey& key) {
  std::vector<double> numbers;
  numbers.reserve(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) numbers.push_back(read_number(list[i], fmt::format("{}.{}", path, i), key));
  return numbers;
}

std::vector<Eigen::Vector2d> read_pairs(const toml::array& list, const std::string& path, std::string_view example) {
  std::vector<Eigen::Vector2d> pairs;
  pairs.reserve(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) pairs.push_back(read_pair(list[i], fmt::format("{}.{}", path, i), example));
  return pairs;
}

TableReader::TableReader(const toml::table& table, std::string path, std::vector<std::string_view> known)
    : table_(table), path_(std::move(path)), known_(std::move(known)) {
  // toml++ keeps keys in alphabetical order; the user reads from the top, so the first fault in the text is named.
  const toml::key* first = nullptr;
  const auto place = [](const toml::key& key) { return std::pair(key.source().begin.line, key.source().begin.column); };
  for (const auto& [key, value] : table) {
    const bool is_known = std::find(known_.begin(), known_.end(), key.str()) != known_.end();
    if (!is_known && (first == nullptr || place(key) < place(*first))) first = &key;
  }
  if (first == nullptr) return;
  throw SceneError(location_of(first->source()), unknown_key_sentence(first->str(), path_, known_));
}

std::string TableReader::path(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

Location TableReader::where(std::string_view key) const {
  const toml::node* node = find(key);
  return node == nullptr ? where() : location_of(*node);
}

const toml::node* TableReader::find(std::string_view key) const {
  assert(std::find(known_.begin(), known_.end(), key) != known_.end());
  return table_.get(key);
}

const toml::node& TableReader::require(std::string_view key, const std::string& advice) const {
  const toml::node* node = find(key);
  if (node == nullptr) throw SceneError(where(), fmt::format("{} lacks {}; {}", table_title(path_), key, advice));
  return *node;
}

std::optional<double> TableReader::number(const NumberKey& key) const {
  const toml::node* node = find(key.name);
  return node == nullptr ? std::nullopt : std::optional(read_number(*node, path(key.name), key));
}

double TableReader::required_number(const NumberKey& key) const {
  return read_number(require(key.name, fmt::format("give it, such as {}", key.example)), path(key.name), key);
}

std::optional<std::int64_t> TableReader::integer(std::string_view key, const std::string& example) const {
  const toml::node* node = find(key);
  return node == nullptr ? std::nullopt : std::optional(read_integer(*node, path(key), example));
}

std::optional<bool> TableReader::on_or_off(std::string_view key) const {
  const toml::node* node = find(key);
  return node == nullptr ? std::nullopt : std::optional(read_switch(*node, path(key), fmt::format("{} = true", key)));
}

std::optional<std::string> TableReader::string(std::string_view key, const std::string& example) const {
  const toml::node* node = find(key);
  return node == nullptr ? std::nullopt : std::optional(read_string(*node, path(key), example));
}

const toml::table* TableReader::table(std::string_view key, const std::string& example) const {
  const toml::node* node = find(key);
  if (node == nullptr) return nullptr;
  if (!node->is_table()) refuse(*node, path(key), "a table, such as " + example);
  return node->as_table();
}

}  // namespace carom::detail
