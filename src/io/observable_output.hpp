#pragma once
// The results of observables in files: the key `observables` of summary.json, and tables of comma-separated values, each with a
// comment with the units, a heading and rows.

#include "io/json.hpp"

#include <carom/observe.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// Returns over what an average is: "time", "collisions", or "sum" where it is none.
[[nodiscard]] const char* average_word(Average average);
/// Returns the average of such a word, or nothing where it is another one.
[[nodiscard]] std::optional<Average> average_of_word(std::string_view word);
/// Returns the average that the comment in the first line of a table names, or nothing where the line is no such comment.
[[nodiscard]] std::optional<Average> average_in_comment(std::string_view line);

/// Returns text such as "observe_NAME.csv"
[[nodiscard]] std::string table_file(const Table& table);

/// Appends a table as files have it: `comment`, which ends in "units:", with the units, a heading and rows. Calls `after_row`
/// after each of these.
void append_table(std::string& text, std::string_view comment, const Table& table, const std::function<void()>& after_row);

/// Throws OutputError.
void write_table(const std::filesystem::path& path, const Table& table);

}  // namespace carom

namespace carom::detail {

[[nodiscard]] Json observables_json(const std::vector<Measurement>& observables);

}  // namespace carom::detail
