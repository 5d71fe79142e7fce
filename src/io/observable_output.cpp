#include "io/observable_output.hpp"

#include "io/csv_cell.hpp"
#include "io/text_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace carom {

namespace {

struct AverageWords {
  Average average;
  const char *word, *comment;
};
constexpr AverageWords words_of_averages[] = {{Average::time, "time", "# averages over time; units:"},
                                              {Average::collisions, "collisions", "# averages over collisions; units:"},
                                              {Average::sum, "sum", "# sums since the start; units:"}};

const AverageWords& entry_of(Average average) { return *std::ranges::find(words_of_averages, average, &AverageWords::average); }

}  // namespace

const char* average_word(Average average) { return entry_of(average).word; }

std::optional<Average> average_of_word(std::string_view word) {
  for (const AverageWords& words : words_of_averages)
    if (word == words.word) return words.average;
  return {};
}

std::optional<Average> average_in_comment(std::string_view line) {
  for (const AverageWords& words : words_of_averages)
    if (line.starts_with(words.comment)) return words.average;
  return {};
}

std::string table_file(const Table& table) { return fmt::format("observe_{}.csv", table.name); }

void append_table(std::string& text, std::string_view comment, const Table& table, const std::function<void()>& after_row) {
  text += comment;
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    text += fmt::format("{} {}", c == 0 ? "" : ",", table.columns[c].unit.empty() ? "1" : table.columns[c].unit);
  text += "\n";
  for (std::size_t c = 0; c < table.columns.size(); ++c) text += fmt::format("{}{}", c == 0 ? "" : ",", table.columns[c].name);
  text += "\n";
  const std::size_t rows = table.columns.empty() ? 0 : table.columns.front().values.size();
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      if (c > 0) text += ',';
      append_csv_cell(text, table.columns[c].values[r]);
    }
    text += "\n";
    after_row();
  }
}

void write_table(const std::filesystem::path& path, const Table& table) {
  detail::TextFile file(path);
  append_table(file.buffer(), entry_of(table.average).comment, table, [&file] { file.end_record(); });
  file.close();
}

}  // namespace carom

namespace carom::detail {

namespace {

Json json_of(const Scalar& scalar) {
  Json json = {{"value", number(scalar.value)},
               {"error", number(scalar.error)},
               {"integrated_correlation_time", number(scalar.integrated_correlation_time)},
               {"average", average_word(scalar.average)}};
  if (!scalar.unit.empty()) json["unit"] = scalar.unit;
  if (!scalar.note.empty()) json["note"] = scalar.note;
  return json;
}

Json json_of(const Table& table) {
  Json columns = Json::array();
  for (const Column& column : table.columns) columns.push_back(column.name);
  return {{"file", table_file(table)}, {"average", average_word(table.average)}, {"columns", columns}};
}

}  // namespace

Json observables_json(const std::vector<Measurement>& observables) {
  Json json = Json::object();
  for (const Measurement& measured : observables) {
    Json& one = json[measured.name];
    one = Json::object();
    if (!measured.note.empty()) one["note"] = measured.note;
    // Their names differ: each looked for among those before, as json does by itself, thousands take minutes.
    std::vector<Json::object_t::value_type>& members = one.get_ref<Json::object_t&>();
    for (const Scalar& scalar : measured.scalars) members.emplace_back(scalar.name, json_of(scalar));
    for (const Table& table : measured.tables) one["tables"][table.name] = json_of(table);
  }
  return json;
}

}  // namespace carom::detail
