#include "io/h5md_measurements.hpp"

#include "io/observable_tables.hpp"

#include <cstddef>
#include <limits>
#include <string>

namespace carom::detail {

namespace {

/// Absent numbers are NaN: an attribute that is always there needs no asking.
double number_or_nan(const std::optional<double>& value) { return value.value_or(std::numeric_limits<double>::quiet_NaN()); }

void write(hid_t parent, const Scalar& scalar) {
  const Hdf5Id group = create_group(parent, scalar.name);
  write_attribute(group.get(), "value", number_or_nan(scalar.value));
  write_attribute(group.get(), "error", number_or_nan(scalar.error));
  write_attribute(group.get(), "decorrelation_time", number_or_nan(scalar.decorrelation_time));
  write_attribute(group.get(), "average", average_word(scalar.average));
  if (!scalar.unit.empty()) write_attribute(group.get(), "unit", scalar.unit);
  if (!scalar.note.empty()) write_attribute(group.get(), "note", scalar.note);
}

void write(hid_t parent, const Table& table) {
  const Hdf5Id group = create_group(parent, "table_" + table.name);
  write_attribute(group.get(), "average", average_word(table.average));
  std::vector<std::string> names, units;
  for (const Column& column : table.columns) {
    write_fixed(group.get(), column.name, std::span<const double>(column.values));
    names.push_back(column.name);
    units.push_back(column.unit);
  }
  if (!names.empty()) write_attribute(group.get(), "columns", names);
  if (!units.empty()) write_attribute(group.get(), "units", units);
}

}  // namespace

void write_measurements(hid_t file, const std::vector<Measurement>& observables) {
  if (observables.empty()) return;
  const Hdf5Id root = create_group(file, "measurements");
  for (const Measurement& measured : observables) {
    const Hdf5Id group = create_group(root.get(), measured.name);
    if (!measured.note.empty()) write_attribute(group.get(), "note", measured.note);
    for (const Scalar& scalar : measured.scalars) write(group.get(), scalar);
    for (const Table& table : measured.tables) write(group.get(), table);
  }
}

}  // namespace carom::detail
