#pragma once
// Maps of fields on a grid, for the page of a run.

#include <carom/observe.hpp>

#include <optional>
#include <string>

namespace carom {

/// Returns a page with maps of the table `fields` of observe.fields: density with arrows of the flow, temperature with arrows of
/// the heat flux, and pressure. With its table `fields_in_time` the page has a slider that shows the stretches of the run, unless
/// these have more than 100,000 cells. Absent where the cells are not a grid of two rows and two columns at least: a line of
/// cells is a plot.
[[nodiscard]] std::optional<std::string> field_maps(const Table& fields, const Table* in_time = nullptr);

/// Returns the table `fields` of a line of cells as a curve along the axis that has several; absent where both have.
[[nodiscard]] std::optional<Table> profile_of_fields(const Table& fields);

}  // namespace carom
