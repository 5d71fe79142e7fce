// Reads TOML values with sentences for everything that can be wrong with them.

#include "scene/table_reader.hpp"

#include "scene/excerpt.hpp"
#include "scene/known_keys.hpp"
#include "scene/number_text.hpp"
#include "scene/overrides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
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

double read_number(const toml::node& node, const std::string& path, Range range, const std::string& example) {
  static constexpr const char* kinds[] = {"a finite number", "a finite number, zero or more", "a finite number above zero"};
  const std::string expected = fmt::format("{}, such as {}", kinds[static_cast<int>(range)], example);
  if (!node.is_number()) refuse(node, path, expected);
  const double value = node.is_integer() ? static_cast<double>(node.as_integer()->get()) : node.as_floating_point()->get();
  const bool in_range = range == Range::any || value > 0.0 || (range == Range::zero_or_more && value == 0.0);
  if (!std::isfinite(value) || !in_range) refuse(node, path, expected);
  return value;
}

double read_number_between(const toml::node& node, const std::string& path, double least, double most,
                           const std::string& example) {
  const std::string expected = fmt::format("a number from {} to {}, such as {}", least, most, example);
  if (!node.is_number()) refuse(node, path, expected);
  const double value = node.is_integer() ? static_cast<double>(node.as_integer()->get()) : node.as_floating_point()->get();
  if (!(value >= least && value <= most)) refuse(node, path, expected);
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

Eigen::Vector2d read_pair(const toml::node& node, const std::string& path, const std::string& example) {
  const toml::array* list = node.as_array();
  if (list == nullptr || list->size() != 2) refuse(node, path, "two numbers in brackets, such as " + example);
  const double first = read_number((*list)[0], path + ".0", Range::any, example);
  const double second = read_number((*list)[1], path + ".1", Range::any, example);
  return {first, second};
}

std::vector<Eigen::Vector2d> read_pairs(const toml::array& list, const std::string& path, const std::string& example,
                                        Rows* rows) {
  std::vector<Eigen::Vector2d> pairs;
  pairs.reserve(list.size());
  if (rows != nullptr) rows->source = location_of(list).source;
  for (std::size_t i = 0; i < list.size(); ++i) {
    pairs.push_back(read_pair(list[i], fmt::format("{}.{}", path, i), example));
    const Location where = location_of(list[i]);
    if (rows != nullptr) rows->places.push_back({where.line, where.column});
  }
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

std::optional<double> TableReader::number(std::string_view key, Range range, const std::string& example) const {
  const toml::node* node = find(key);
  return node == nullptr ? std::nullopt : std::optional(read_number(*node, path(key), range, example));
}

double TableReader::required_number(std::string_view key, Range range, const std::string& example) const {
  return read_number(require(key, "give it, such as " + example), path(key), range, example);
}

std::optional<double> TableReader::number_between(std::string_view key, double least, double most,
                                                  const std::string& example) const {
  const toml::node* node = find(key);
  return node == nullptr ? std::nullopt : std::optional(read_number_between(*node, path(key), least, most, example));
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
