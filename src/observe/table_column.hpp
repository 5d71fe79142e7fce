#pragma once
// Columns of tables of results, by their names.

#include <carom/observe.hpp>

#include <string_view>

namespace carom {

/// Returns the column of a table with that name; null where it has none.
[[nodiscard]] inline const Column* find_column(const Table& table, std::string_view name) {
  for (const Column& column : table.columns)
    if (column.name == name) return &column;
  return nullptr;
}

}  // namespace carom
