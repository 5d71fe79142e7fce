#pragma once
// Reads one TOML table of a scene. The reader has the list of the table's keys, so that an unknown word is found before anything
// else; every refusal carries the line and column of what it refuses.

#include <carom/scene.hpp>

#include "scene/draft.hpp"
#include "scene/number_keys.hpp"

#include <toml++/toml.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carom::detail {

/// Returns the place of a node. Nodes from an override carry the override itself in place of a file.
Location location_of(const toml::source_region& region);
Location location_of(const toml::node& node);

/// Returns a value as an error names it: `a string ("wide")`, `an integer (3)`, `a table`.
std::string describe(const toml::node& node);

/// Returns the place of the longest part of a path that the document has: of "walls.top.mass" the table where it has no mass.
Location place_of(const toml::table& document, std::string_view path);

/// `path` is the key's full name: "run.time".
double read_number(const toml::node& node, const std::string& path, const NumberKey& key);
/// Returns the whole number that a node is, also with a point or an exponent (1e5) where it is at most 2^53; empty where it is
/// none.
std::optional<std::int64_t> whole_number(const toml::node& node);
std::int64_t read_integer(const toml::node& node, const std::string& path, const std::string& example);  ///< zero or more
bool read_switch(const toml::node& node, const std::string& path, const std::string& example);
std::string read_string(const toml::node& node, const std::string& path, const std::string& example);
Eigen::Vector2d read_pair(const toml::node& node, const std::string& path, std::string_view example);
/// [a, b, ...]
std::vector<double> read_numbers(const toml::array& list, const std::string& path, const NumberKey& key);
/// [[a, b], ...]
std::vector<Eigen::Vector2d> read_pairs(const toml::array& list, const std::string& path, std::string_view example);

/// Throws the error for a value of the wrong kind: "<path> is <what was found>; it must be <expected>".
[[noreturn]] void refuse(const toml::node& node, const std::string& path, const std::string& expected);

class TableReader {
 public:
  /// `known` are the keys that the format has here. Other words are refused with the nearest of them.
  TableReader(const toml::table& table, std::string path, std::vector<std::string_view> known);

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::string path(std::string_view key) const;  ///< "run.time"
  [[nodiscard]] Location where() const { return location_of(table_); }
  [[nodiscard]] Location where(std::string_view key) const;  ///< place of the value; of the table where the key is absent

  [[nodiscard]] const toml::node* find(std::string_view key) const;  ///< null where absent
  /// Throws "<table> lacks <key>; <advice>" where absent.
  [[nodiscard]] const toml::node& require(std::string_view key, const std::string& advice) const;

  [[nodiscard]] std::optional<double> number(const NumberKey& key) const;
  [[nodiscard]] double required_number(const NumberKey& key) const;
  [[nodiscard]] std::optional<std::int64_t> integer(std::string_view key, const std::string& example) const;
  [[nodiscard]] std::optional<bool> on_or_off(std::string_view key) const;
  [[nodiscard]] std::optional<std::string> string(std::string_view key, const std::string& example) const;

  /// Returns the sub-table `key`; throws where the value is not a table. Null where absent.
  [[nodiscard]] const toml::table* table(std::string_view key, const std::string& example) const;

 private:
  const toml::table& table_;
  std::string path_;
  std::vector<std::string_view> known_;
};

}  // namespace carom::detail
