#include "scene/start_rows.hpp"

#include "scene/excerpt.hpp"
#include "scene/known_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace carom::detail {
namespace {

enum Column : std::size_t { x, y, vx, vy, radius, mass };

std::string unknown_column(std::string_view name) {
  const std::string problem = fmt::format("there is no column \"{}\"", excerpt(name, 40));
  const std::string_view near = name.size() > 1 ? nearest_word(name, start_columns) : std::string_view();
  if (!near.empty()) return fmt::format("{}; did you mean {}?", problem, near);
  return fmt::format("{}; the columns are {}", problem, fmt::join(start_columns, ", "));
}

}  // namespace

void StartRows::name_columns(std::span<const std::string_view> names) {
  std::array<bool, start_columns.size()> has{};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto* const known = std::find(start_columns.begin(), start_columns.end(), names[i]);
    if (known == start_columns.end()) fail_(i, unknown_column(names[i]));
    const auto column = static_cast<std::size_t>(known - start_columns.begin());
    if (has[column]) fail_(i, fmt::format("the column {} is named twice; name it once", names[i]));
    has[column] = true;
    order_.push_back(column);
  }
  for (const std::size_t column : {x, y}) {
    if (!has[column]) fail_(0, fmt::format("there is no column {}; the columns x and y are required", start_columns[column]));
  }
  if (has[vx] != has[vy]) fail_(0, fmt::format("there is no column {}; give both vx and vy, or neither", has[vx] ? "vy" : "vx"));
  file_.has_velocities = has[vx];
  file_.has_radii = has[radius];
  file_.has_masses = has[mass];
}

void StartRows::add(std::span<const double> values, std::array<int, 2> place) {
  std::array<double, start_columns.size()> of{};
  for (std::size_t i = 0; i < order_.size(); ++i) {
    if (!std::isfinite(values[i])) {
      fail_(i, fmt::format("{} is {}; it must be a finite number, such as 0.5", name(i), values[i]));
    }
    if (order_[i] >= radius && values[i] <= 0.0) fail_(i, fmt::format("{} is {}; it must be above zero", name(i), values[i]));
    of[order_[i]] = values[i];
  }
  file_.positions.emplace_back(of[x], of[y]);
  if (file_.has_velocities) file_.velocities.emplace_back(of[vx], of[vy]);
  if (file_.has_radii) file_.radii.push_back(of[radius]);
  if (file_.has_masses) file_.masses.push_back(of[mass]);
  file_.rows.places.push_back(place);
}

}  // namespace carom::detail
