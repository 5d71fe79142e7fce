// Reads a file into a HardCase: numbers in hexfloat become decimal ones, the tables [case] and [expect] are read here, and the
// rest is a scene for the scene's own reader. Lines keep their numbers, so that every message names the right one.

#include "scene/document.hpp"
#include "scene/known_keys.hpp"
#include "scene/read_tables.hpp"
#include "scene/value_text.hpp"
#include "studies/hard_cases/hard_case.hpp"

#include <carom/scene.hpp>
#include <carom/simulation.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <limits>
#include <regex>
#include <string_view>
#include <system_error>

namespace carom {

namespace {

using detail::Range;
using detail::TableReader;

/// Returns `text` with numbers such as "0x1.8p-3" (quotes included) in decimal, 0.1875, with enough digits for the same bits.
std::string without_hexfloats(const std::string& text) {
  static const std::regex hexfloat("\"([+-]?)0x([0-9a-fA-F]+\\.?[0-9a-fA-F]*p[+-]?[0-9]+)\"");
  std::string plain;
  auto at = text.cbegin();
  for (auto match = std::sregex_iterator(text.begin(), text.end(), hexfloat); match != std::sregex_iterator(); ++match) {
    plain.append(at, text.cbegin() + match->position());
    at = text.cbegin() + match->position() + match->length();
    const std::string digits = (*match)[2];
    double value = 0.0;
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::hex);
    const bool exact = read.ec == std::errc() && read.ptr == digits.data() + digits.size();
    plain += exact ? ((*match)[1] == "-" ? "-" : "") + detail::number_text(value) : std::string(*match->begin());
  }
  return plain.append(at, text.cend());
}

/// The lines on which anything begins that is not below `key`.
void lines_of_others(const toml::table& document, std::string_view key, std::vector<std::uint32_t>& lines) {
  for (const auto& [name, node] : document) {
    if (name.str() == key) continue;
    lines.push_back(name.source().begin.line);
    if (const toml::array* list = node.as_array())
      for (const toml::node& entry : *list) lines.push_back(entry.source().begin.line);
    if (const toml::table* table = node.as_table()) lines_of_others(*table, "", lines);
  }
}

/// Empties the lines of one table: from its header to the next line on which something else begins.
void blank(std::string& text, const toml::table& document, std::string_view key) {
  const toml::node* node = document.get(key);
  if (node == nullptr) return;
  const std::uint32_t first = node->source().begin.line;
  std::vector<std::uint32_t> others;
  lines_of_others(document, key, others);
  std::uint32_t end = std::numeric_limits<std::uint32_t>::max();
  for (const std::uint32_t line : others)
    if (line > first) end = std::min(end, line);
  std::string kept;
  std::uint32_t line = 1;
  for (const char c : text) {
    if (line < first || line >= end || c == '\n') kept += c;
    if (c == '\n') ++line;
  }
  text = kept;
}

std::int32_t partner_named(const toml::node& node) {
  if (const auto id = node.value<std::int64_t>()) return static_cast<std::int32_t>(*id);
  const std::string name = node.value<std::string>().value_or("");
  if (name == "left") return wall_left;
  if (name == "right") return wall_right;
  if (name == "bottom") return wall_bottom;
  if (name == "top") return wall_top;
  if (name == "obstacle") return first_obstacle;
  throw SceneError(
      detail::location_of(node),
      fmt::format("{} is no partner; give a disk's id, or left, right, bottom, top or obstacle", detail::describe(node)));
}

/// [[time, disk, partner], ...]
std::vector<ExpectedEvent> read_events(const toml::node& node) {
  std::vector<ExpectedEvent> events;
  const toml::array* list = node.as_array();
  if (list == nullptr) detail::refuse(node, "expect.events", "a list such as [[1.5, 0, 1], [2.0, 1, \"right\"]]");
  for (const toml::node& entry : *list) {
    const toml::array* event = entry.as_array();
    if (event == nullptr || event->size() != 3 || !(*event)[0].is_number() || !(*event)[1].is_integer())
      detail::refuse(entry, "an entry of expect.events", "[time, disk, partner]");
    events.push_back({*(*event)[0].value<double>(), static_cast<std::int32_t>(*(*event)[1].value<std::int64_t>()),
                      partner_named((*event)[2])});
  }
  return events;
}

std::optional<ExpectedNumber> read_expected(const TableReader& table, std::string_view key) {
  const toml::node* node = table.find(key);
  if (node == nullptr) return std::nullopt;
  const Eigen::Vector2d pair = detail::read_pair(*node, table.path(key), "[value, relative bound]");
  return ExpectedNumber{pair[0], pair[1]};
}

Eigen::Matrix4Xd read_states(const toml::node& node) {
  const toml::array* list = node.as_array();
  if (list == nullptr) detail::refuse(node, "expect.final", "a list of [x, y, vx, vy], one per disk");
  Eigen::Matrix4Xd states(4, static_cast<Eigen::Index>(list->size()));
  for (std::size_t i = 0; i < list->size(); ++i) {
    const toml::array* row = (*list)[i].as_array();
    if (row == nullptr || row->size() != 4) detail::refuse((*list)[i], "a row of expect.final", "[x, y, vx, vy]");
    for (std::size_t k = 0; k < 4; ++k)
      states(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i)) =
          detail::read_number((*row)[k], "expect.final", {"", "[x, y, vx, vy]"});
  }
  return states;
}

std::optional<std::uint64_t> read_count(const TableReader& table, std::string_view key) {
  const auto count = table.integer(key, fmt::format("{} = 3", key));
  return count ? std::optional(static_cast<std::uint64_t>(*count)) : std::nullopt;
}

std::string required_string(const TableReader& table, std::string_view key, const char* advice) {
  return detail::read_string(table.require(key, advice), table.path(key), fmt::format("{} = \"...\"", key));
}

Expectations read_expectations(const toml::table& node) {
  const TableReader table(
      node, "expect",
      {"refused",      "stopped", "stopped_disks", "stop_time",   "pair",    "wall",        "obstacle",    "well",
       "boundaries",   "events",  "within_ulps",   "same_events", "overlap", "energy",      "momentum",    "final",
       "final_within", "returns", "reversed",      "relabelled",  "samples", "last_sample", "late_sample", "Z"});
  Expectations expect;
  expect.refused = table.string("refused", "refused = \"a part of the sentence\"");
  expect.stopped = table.string("stopped", "stopped = \"jammed\"").value_or("");
  if (const toml::node* list = table.find("stopped_disks")) {
    if (list->as_array() == nullptr) detail::refuse(*list, "expect.stopped_disks", "a list of ids");
    for (const toml::node& id : *list->as_array())
      expect.stopped_disks.push_back(static_cast<std::int32_t>(detail::read_integer(id, "expect.stopped_disks", "[0, 1]")));
  }
  expect.stop_time = read_expected(table, "stop_time");
  expect.pair = read_count(table, "pair");
  expect.wall = read_count(table, "wall");
  expect.obstacle = read_count(table, "obstacle");
  expect.well = read_count(table, "well");
  expect.boundaries = read_count(table, "boundaries");
  if (const toml::node* events = table.find("events")) expect.events = read_events(*events);
  expect.event_ulps = table.number({"within_ulps", "within_ulps = 2", Range::zero_or_more}).value_or(0.0);
  expect.same_events = read_count(table, "same_events").value_or(expect.same_events);
  expect.overlap = table.number({"overlap", "overlap = 1e-12", Range::zero_or_more}).value_or(expect.overlap);
  expect.energy = table.number({"energy", "energy = 1e-12", Range::zero_or_more});
  expect.momentum = table.number({"momentum", "momentum = 1e-12", Range::zero_or_more});
  if (const toml::node* states = table.find("final")) expect.final_state = read_states(*states);
  expect.final_within = table.number({"final_within", "final_within = 1e-14", Range::zero_or_more}).value_or(0.0);
  expect.returns = table.number({"returns", "returns = 0.0", Range::zero_or_more});
  expect.reversed = table.number({"reversed", "reversed = 1e-9", Range::zero_or_more});
  expect.relabelled = table.number({"relabelled", "relabelled = 0.0", Range::zero_or_more});
  expect.samples = read_count(table, "samples");
  expect.last_sample = table.number({"last_sample", "last_sample = 1.0", Range::zero_or_more});
  if (const auto late = read_expected(table, "late_sample"))
    expect.late_sample = LateSample{static_cast<std::uint64_t>(late->value), late->bound};
  expect.Z = read_expected(table, "Z");
  return expect;
}

void read_case(const toml::table& node, HardCase& hard_case) {
  const TableReader table(node, "case", {"family", "why", "source", "engines", "bits", "long"});
  hard_case.family = required_string(table, "family", "name the family that the case belongs to");
  const auto& families = hard_case_families();
  if (std::find(families.begin(), families.end(), hard_case.family) == families.end())
    throw SceneError(table.where("family"),
                     fmt::format("there is no family \"{}\"; choose one of {}", hard_case.family, fmt::join(families, ", ")));
  hard_case.why = required_string(table, "why", "say why the case is hard");
  hard_case.source = required_string(table, "source", "say where the case or its answer comes from");
  hard_case.bits = static_cast<int>(table.integer("bits", "bits = 53").value_or(hard_case.bits));
  hard_case.takes_long = table.on_or_off("long").value_or(false);
  const toml::node* engines = table.find("engines");
  if (engines == nullptr) return;
  if (engines->as_array() == nullptr) detail::refuse(*engines, "case.engines", "a list of names");
  const std::vector<std::string> names = engine_names();
  for (const toml::node& entry : *engines->as_array()) {
    const std::string name = detail::read_string(entry, "case.engines", "[\"fast\"]");
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw SceneError(detail::location_of(entry),
                       fmt::format("there is no engine \"{}\"; choose from {}", name, fmt::join(names, ", ")));
    hard_case.engines.push_back(name);
  }
}

}  // namespace

HardCase read_hard_case(const std::string& text, const std::string& file) {
  HardCase hard_case;
  hard_case.name = std::filesystem::path(file).stem().string();
  hard_case.file = file;
  hard_case.text = text;
  hard_case.scene = without_hexfloats(text);
  const toml::table document = detail::parse_toml(hard_case.scene, file);
  const auto part = [&](const char* key) -> const toml::table& {
    const toml::table* table = document[key].as_table();
    if (table == nullptr)
      throw SceneError({file, 1, 1}, fmt::format("a hard case has a table [{}], and this file has none", key));
    return *table;
  };
  read_case(part("case"), hard_case);
  hard_case.expect = read_expectations(part("expect"));
  hard_case.title = document["title"].value<std::string>().value_or("");
  for (const char* key : {"case", "expect"}) blank(hard_case.scene, document, key);
  return hard_case;
}

HardCase load_hard_case(const std::string& path) { return read_hard_case(detail::read_text_file(path), path); }

}  // namespace carom
