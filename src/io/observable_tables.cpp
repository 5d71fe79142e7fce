#include "io/observable_tables.hpp"

#include "io/text_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

namespace carom {

std::string table_file(const Table& table) { return fmt::format("observe_{}.csv", table.name); }

void write_table(const std::filesystem::path& path, const Table& table) {
  detail::TextFile file(path);
  std::string& text = file.buffer();
  text += fmt::format("# averages over {}; units:", table.average == Average::time ? "time" : "collisions");
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    text += fmt::format("{} {}", c == 0 ? "" : ",", table.columns[c].unit.empty() ? "1" : table.columns[c].unit);
  text += "\n";
  for (std::size_t c = 0; c < table.columns.size(); ++c) text += fmt::format("{}{}", c == 0 ? "" : ",", table.columns[c].name);
  text += "\n";
  const std::size_t rows = table.columns.empty() ? 0 : table.columns.front().values.size();
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      const double value = table.columns[c].values[r];
      text += std::isfinite(value) ? fmt::format("{}{}", c == 0 ? "" : ",", value) : (c == 0 ? "nan" : ",nan");
    }
    text += "\n";
    file.end_record();
  }
  file.close();
}

}  // namespace carom
