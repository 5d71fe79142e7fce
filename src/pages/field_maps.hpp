#pragma once
// Maps of fields on a grid, for the page of a run.

#include <carom/observe.hpp>

#include <optional>
#include <string>

namespace carom {

/// Returns a page with maps of the table `fields` of observe.fields: density with arrows of the flow, temperature with arrows of
/// the heat flux, and pressure. Absent where the cells are not a grid of two rows and two columns at least: a line of cells is a
/// plot.
[[nodiscard]] std::optional<std::string> field_maps(const Table& fields);

/// Returns the table `fields` of a line of cells as a curve along the axis that has several; absent where both have.
[[nodiscard]] std::optional<Table> profile_of_fields(const Table& fields);

}  // namespace carom
