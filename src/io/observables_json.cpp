#include "io/observables_json.hpp"

#include "io/observable_tables.hpp"

namespace carom::detail {

namespace {

Json json_of(const Scalar& scalar) {
  Json json = {{"value", number(scalar.value)},
               {"error", number(scalar.error)},
               {"decorrelation_time", number(scalar.decorrelation_time)},
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
    for (const Scalar& scalar : measured.scalars) one[scalar.name] = json_of(scalar);
    for (const Table& table : measured.tables) one["tables"][table.name] = json_of(table);
  }
  return json;
}

}  // namespace carom::detail
