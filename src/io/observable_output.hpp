#pragma once
// The results of observables in files: the key `observables` of summary.json, and tables of comma-separated values, each with a
// comment with the units, a heading and rows.

#include "io/json.hpp"

#include <carom/observe.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace carom {

/// Over what an average is: "time" or "collisions".
[[nodiscard]] inline const char* average_word(Average average) { return average == Average::time ? "time" : "collisions"; }

/// Returns text such as "observe_NAME.csv"
[[nodiscard]] std::string table_file(const Table& table);

/// Throws OutputError.
void write_table(const std::filesystem::path& path, const Table& table);

}  // namespace carom

namespace carom::detail {

[[nodiscard]] Json observables_json(const std::vector<Measurement>& observables);

}  // namespace carom::detail
