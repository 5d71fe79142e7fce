#pragma once
// Tables of observables as files of comma-separated values, one per table: a comment with the units, a heading, rows.

#include <carom/observe.hpp>

#include <filesystem>
#include <string>

namespace carom {

/// Over what an average is: "time" or "collisions".
[[nodiscard]] inline const char* average_word(Average average) { return average == Average::time ? "time" : "collisions"; }

/// Returns text such as "observe_NAME.csv"
[[nodiscard]] std::string table_file(const Table& table);

/// Throws OutputError.
void write_table(const std::filesystem::path& path, const Table& table);

}  // namespace carom
