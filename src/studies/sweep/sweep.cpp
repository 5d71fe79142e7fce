#include "studies/sweep/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>

namespace carom {

namespace {

bool is_letter_or_digit(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

bool is_plain(char c) { return is_letter_or_digit(c) || std::string_view("._+-").find(c) != std::string_view::npos; }

/// Returns the last `parts` parts of a dotted key.
std::string_view end_of(std::string_view key, std::size_t parts) {
  std::size_t dot = key.size();
  for (; parts > 0 && dot != std::string_view::npos; --parts) dot = dot == 0 ? std::string_view::npos : key.rfind('.', dot - 1);
  return dot == std::string_view::npos ? key : key.substr(dot + 1);
}

/// FNV-1a (Fowler, Noll, Vo), folded to 32 bits.
std::uint32_t hash_of(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return static_cast<std::uint32_t>(hash ^ (hash >> 32U));
}

std::string value_name(std::string_view value) {
  constexpr std::size_t longest = 40, kept = 24;
  std::string name;
  for (const char c : value) {
    if (is_plain(c)) {
      name += c;
    } else if (!name.empty() && name.back() != '-') {
      name += '-';
    }
  }
  while (name.ends_with('-')) name.pop_back();
  return name.size() <= longest ? name : fmt::format("{}-{:08x}", name.substr(0, kept), hash_of(value));
}

}  // namespace

std::vector<std::string> short_keys(const std::vector<std::string>& keys) {
  std::vector<std::string> ends;
  for (const std::string& key : keys) {
    std::size_t parts = 1;
    const auto shared = [&] {
      return std::count_if(keys.begin(), keys.end(),
                           [&](const std::string& other) { return end_of(other, parts) == end_of(key, parts); }) > 1;
    };
    while (end_of(key, parts) != key && shared()) ++parts;
    ends.emplace_back(end_of(key, parts));
  }
  return ends;
}

std::string point_name(const std::vector<std::string>& short_keys, const std::vector<std::string>& values) {
  std::string name;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (values[k].empty()) continue;
    name += fmt::format("{}{}={}", name.empty() ? "" : "_", value_name(short_keys[k]), value_name(values[k]));
  }
  return name.empty() ? "scene" : name;
}

bool is_point_name(std::string_view name) {
  constexpr std::size_t longest = 100;
  return !name.empty() && name.size() <= longest && is_letter_or_digit(name.front()) &&
         std::all_of(name.begin(), name.end(), [](char c) { return is_plain(c) || c == '='; });
}

std::filesystem::path Sweep::directory_of(std::size_t run) const {
  return std::filesystem::path(point_of(run).name) / fmt::format("seed={}", seed_of(run));
}

std::vector<std::string> Sweep::changes_of(const SweepPoint& point) const {
  std::vector<std::string> changes = shared;
  for (std::size_t k = 0; k < keys.size(); ++k)
    if (!point.values[k].empty()) changes.push_back(fmt::format("{}={}", keys[k], point.values[k]));
  return changes;
}

std::vector<std::string> Sweep::overrides_of(std::size_t run) const {
  std::vector<std::string> overrides = changes_of(point_of(run));
  overrides.push_back(fmt::format("run.seed={}", seed_of(run)));
  return overrides;
}

Scene Sweep::scene_of(std::size_t run) const {
  return parse_scene(scene_text, scene_path, overrides_of(run), std::filesystem::path(scene_path).parent_path().string());
}

}  // namespace carom
