// Cells in the colours of palette.hpp, as SVG without a script. Arrows end where the largest is as long as a cell is wide.

#include "pages/field_maps.hpp"

#include "core/all_equal.hpp"
#include "observe/table_column.hpp"
#include "pages/palette.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

namespace carom {

namespace {

using Values = std::vector<double>;

struct Cells {
  std::size_t across = 0, up = 0;
  double width = 0.0, height = 0.0;
};

/// Cells come row after row, from below.
std::optional<Cells> cells_of(const Table& fields) {
  const Column *x = find_column(fields, "x"), *y = find_column(fields, "y");
  if (x == nullptr || y == nullptr || y->values.empty()) return {};
  Cells cells;
  while (cells.across < y->values.size() && y->values[cells.across] == y->values.front()) ++cells.across;
  cells.up = y->values.size() / cells.across;
  if (cells.across < 2 || cells.up < 2 || cells.across * cells.up != y->values.size()) return {};
  cells.width = x->values[1] - x->values[0];
  cells.height = y->values[cells.across] - y->values[0];
  return cells;
}

std::string hex(const Colour& colour) {
  const auto part = [](double share) { return static_cast<int>(std::lround(255.0 * share)); };
  return fmt::format("#{:02x}{:02x}{:02x}", part(colour.red), part(colour.green), part(colour.blue));
}

/// A map with its arrows, where there are any, and its scale.
std::string map_of(const Cells& cells, const std::string& title, const std::string& unit, const Values& values,
                   const Values* arrow_x, const Values* arrow_y, const std::string& arrows) {
  constexpr double side = 1000.0;  // of the longer side in the picture
  const double width = static_cast<double>(cells.across) * cells.width, height = static_cast<double>(cells.up) * cells.height;
  const double scale = side / std::max(width, height), w = cells.width * scale, h = cells.height * scale;
  double low = INFINITY, high = -INFINITY, longest = 0.0;
  for (std::size_t c = 0; c < values.size(); ++c) {
    if (std::isfinite(values[c])) low = std::min(low, values[c]), high = std::max(high, values[c]);
    if (arrow_x != nullptr)
      if (const double length = std::hypot((*arrow_x)[c], (*arrow_y)[c]); std::isfinite(length))
        longest = std::max(longest, length);
  }
  if (!(low <= high)) return {};
  std::string svg =
      fmt::format("<svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\" shape-rendering=\"crispEdges\">",
                  width * scale, height * scale, title);
  std::string lines;
  for (std::size_t c = 0; c < values.size(); ++c) {
    const std::size_t row = cells.up - 1 - c / cells.across;
    const double left = static_cast<double>(c % cells.across) * w, top = static_cast<double>(row) * h;
    if (std::isfinite(values[c]))
      svg += fmt::format("<path fill=\"{}\" d=\"M{:.1f} {:.1f}h{:.1f}v{:.1f}h-{:.1f}z\"><title>{:.5g}</title></path>",
                         hex(scale_colour(high > low ? (values[c] - low) / (high - low) : 0.5)), left, top, w, h, w, values[c]);
    if (arrow_x == nullptr || !(longest > 0.0) || !std::isfinite((*arrow_x)[c])) continue;
    const double unit_length = std::min(w, h) / longest, dx = (*arrow_x)[c] * unit_length, dy = -(*arrow_y)[c] * unit_length;
    const double x0 = left + 0.5 * (w - dx), y0 = top + 0.5 * (h - dy);
    lines += fmt::format("M{:.1f} {:.1f}l{:.1f} {:.1f}", x0, y0, dx, dy);
    lines += fmt::format("m{:.1f} {:.1f}L{:.1f} {:.1f}l{:.1f} {:.1f}", -0.35 * dx + 0.2 * dy, -0.35 * dy - 0.2 * dx, x0 + dx,
                         y0 + dy, -0.35 * dx - 0.2 * dy, -0.35 * dy + 0.2 * dx);
  }
  const double pen = std::clamp(0.05 * std::min(w, h), 1.0, 6.0);
  if (!lines.empty())
    for (const auto& [colour, thick] : {std::pair("#000", 2.2 * pen), std::pair("#fff", pen)})
      svg += fmt::format(
          "<path fill=\"none\" stroke=\"{}\" stroke-width=\"{:.1f}\" stroke-linecap=\"round\" "
          "shape-rendering=\"geometricPrecision\" d=\"{}\"/>",
          colour, thick, lines);
  svg += "</svg>";
  std::string caption =
      fmt::format("<b>{}</b> {:.4g} <span class=\"scale\"></span> {:.4g} {}", title, low, high, unit_words(unit));
  if (!lines.empty()) caption += fmt::format("<br>Arrows: {}, the longest {:.3g}", arrows, longest);
  return "<figure><figcaption>" + caption + "</figcaption>" + svg + "</figure>";
}

}  // namespace

std::optional<std::string> field_maps(const Table& fields) {
  const std::optional<Cells> cells = cells_of(fields);
  if (!cells) return {};
  const auto values = [&](std::string_view name) -> const Values* {
    const Column* const found = find_column(fields, name);
    return found == nullptr ? nullptr : &found->values;
  };
  const Values *density = values("density"), *u = values("velocity_x"), *v = values("velocity_y"), *kT = values("temperature");
  const Values *qx = values("heat_flux_x"), *qy = values("heat_flux_y"), *xx = values("stress_xx"), *yy = values("stress_yy");
  for (const Values* one : {density, u, v, kT})
    if (one == nullptr) return {};
  Values pressure;
  for (std::size_t c = 0; xx != nullptr && yy != nullptr && c < xx->size(); ++c) pressure.push_back(0.5 * ((*xx)[c] + (*yy)[c]));
  std::string stops;
  for (int k = 0; k <= 8; ++k) stops += (k == 0 ? "" : ",") + hex(scale_colour(k / 8.0));
  const auto unit = [&](std::string_view name) { return find_column(fields, name)->unit; };
  const std::string map_of_pressure =
      pressure.empty() ? std::string() : map_of(*cells, "Pressure", unit("stress_xx"), pressure, nullptr, nullptr, "");
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Maps of the fields</title><style>\n"
         ":root{color-scheme:light dark}body{margin:0;padding:1rem;font:1rem/1.4 "
         "system-ui,sans-serif;background:#fff;color:#1b2330;display:grid;"
         "grid-template-columns:repeat(auto-fit,minmax(min(15rem,100%),1fr));gap:1.2rem;align-items:start}"
         "figure{margin:0}svg{display:block;width:100%;max-height:32rem}figcaption{min-height:3.6em;font-size:.9rem}"
         ".scale{display:inline-block;width:5em;height:.7em;background:linear-gradient(to right," +
         stops + ")}@media(prefers-color-scheme:dark){body{background:#12161c;color:#e6eaf0}}\n</style></head><body>\n" +
         map_of(*cells, "Density", unit("density"), *density, u, v, "flow") +
         map_of(*cells, "Temperature", unit("temperature"), *kT, qx, qy, "heat flux") + map_of_pressure + "\n</body></html>\n";
}

std::optional<Table> profile_of_fields(const Table& fields) {
  const bool along_x = !all_equal(fields.columns[0].values), along_y = !all_equal(fields.columns[1].values);
  if (along_x && along_y) return {};
  Table profile = fields;
  profile.columns.erase(profile.columns.begin() + (along_x ? 1 : 0));
  return profile;
}

}  // namespace carom
