// Cells in the colours of palette.hpp, as SVG. Arrows end where the largest is as long as a cell is wide. The average of a run
// needs no script; its stretches of time are data for page/field_film.js, which shows them in the same cells.

#include "pages/field_maps.hpp"

#include "core/all_equal.hpp"
#include "observe/table_column.hpp"
#include "pages/html_parts.hpp"
#include "pages/palette.hpp"
#include "text/numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace carom {

namespace {

using Values = std::vector<double>;

struct Cells {
  std::size_t across = 0, up = 0;
  double width = 0.0, height = 0.0;

  /// By which a length becomes one of the picture, the longer side of which has 1000.
  [[nodiscard]] double scale() const {
    return 1000.0 / std::max(static_cast<double>(across) * width, static_cast<double>(up) * height);
  }
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

/// What a map shows: the mean of some columns in colours, and a vector as arrows.
struct KindOfMap {
  const char* title;
  std::array<std::string_view, 2> columns;  ///< of which the mean is shown
  std::string_view arrow_x, arrow_y;        ///< columns; empty without arrows
  const char* arrows;
};
constexpr std::array<KindOfMap, 3> kinds_of_maps = {
    {{"Density", {"density", "density"}, "velocity_x", "velocity_y", "flow"},
     {"Temperature", {"temperature", "temperature"}, "heat_flux_x", "heat_flux_y", "heat flux"},
     {"Pressure", {"stress_xx", "stress_yy"}, "", "", ""}}};

/// Numbers of the cells of one stretch of time or of several, or of the average of all.
struct Shown {
  std::string unit;
  Values values, arrow_x, arrow_y;  ///< the last two are empty without arrows
  double low = INFINITY, high = -INFINITY, longest = 0.0;

  [[nodiscard]] bool has_arrows() const { return longest > 0.0; }
};

/// Absent where the table lacks the columns, or has no number in them.
std::optional<Shown> shown_of(const Table& table, const KindOfMap& kind) {
  const Column *one = find_column(table, kind.columns[0]), *other = find_column(table, kind.columns[1]);
  if (one == nullptr || other == nullptr) return {};
  Shown shown;
  shown.unit = one->unit;
  for (std::size_t k = 0; k < one->values.size(); ++k) {
    const double value = 0.5 * (one->values[k] + other->values[k]);
    shown.values.push_back(value);
    if (std::isfinite(value)) shown.low = std::min(shown.low, value), shown.high = std::max(shown.high, value);
  }
  if (!(shown.low <= shown.high)) return {};
  const Column *x = find_column(table, kind.arrow_x), *y = find_column(table, kind.arrow_y);
  if (x == nullptr || y == nullptr) return shown;
  shown.arrow_x = x->values;
  shown.arrow_y = y->values;
  for (std::size_t k = 0; k < x->values.size(); ++k)
    if (const double length = std::hypot(x->values[k], y->values[k]); std::isfinite(length))
      shown.longest = std::max(shown.longest, length);
  return shown;
}

/// Returns how far along the scale a value is, from 0 to 1.
double share_of(double value, double low, double high) { return high > low ? (value - low) / (high - low) : 0.5; }

/// A map with its arrows, where there are any, and its scale. The first paths are the cells, row after row from below.
std::string map_of(const Cells& cells, const KindOfMap& kind, const Shown& shown) {
  const double scale = cells.scale(), w = cells.width * scale, h = cells.height * scale;
  std::string svg =
      fmt::format("<svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\" shape-rendering=\"crispEdges\">",
                  static_cast<double>(cells.across) * w, static_cast<double>(cells.up) * h, kind.title);
  std::string lines;
  for (std::size_t c = 0; c < shown.values.size(); ++c) {
    const std::size_t row = cells.up - 1 - c / cells.across;
    const double left = static_cast<double>(c % cells.across) * w, top = static_cast<double>(row) * h, value = shown.values[c];
    const bool is_known = std::isfinite(value);
    svg += fmt::format("<path fill=\"{}\" d=\"M{:.1f} {:.1f}h{:.1f}v{:.1f}h-{:.1f}z\"><title>{}</title></path>",
                       is_known ? hex(scale_colour(share_of(value, shown.low, shown.high))) : "none", left, top, w, h, w,
                       is_known ? fmt::format("{:.5g}", value) : "none");
    if (!shown.has_arrows() || !std::isfinite(shown.arrow_x[c])) continue;
    const double unit_length = std::min(w, h) / shown.longest, dx = shown.arrow_x[c] * unit_length,
                 dy = -shown.arrow_y[c] * unit_length;
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
  std::string caption = fmt::format(
      "<b>{}</b> <span class=\"low\">{:.4g}</span> <span class=\"scale\"></span> <span class=\"high\">{:.4g}</span> {}",
      kind.title, shown.low, shown.high, unit_words(shown.unit));
  if (!lines.empty())
    caption += fmt::format("<br>Arrows: {}, the longest <span class=\"longest\">{:.3g}</span>", kind.arrows, shown.longest);
  return "<figure><figcaption>" + caption + "</figcaption>" + svg + "</figure>";
}

/// The cells of all stretches of one map as field_film.js reads them.
std::string frames_of(const Shown& shown, std::size_t cells) {
  std::vector<std::string> colours, arrows;
  const auto digits = [](double share) { return fmt::format("{:02x}", static_cast<int>(std::lround(255.0 * share))); };
  const auto component = [&](double value) {
    const double share = shown.has_arrows() && std::isfinite(value) ? value / shown.longest : 0.0;
    return fmt::format("{:02x}", 128 + static_cast<int>(std::lround(127.0 * share)));
  };
  for (std::size_t k = 0; k < shown.values.size(); ++k) {
    if (k % cells == 0) colours.emplace_back(), arrows.emplace_back();
    const double value = shown.values[k];
    colours.back() += std::isfinite(value) ? digits(share_of(value, shown.low, shown.high)) : "--";
    if (!shown.arrow_x.empty()) arrows.back() += component(shown.arrow_x[k]) + component(shown.arrow_y[k]);
  }
  return fmt::format(R"({{"low":{},"high":{},"longest":{},"cells":["{}"],"arrows":["{}"]}})", shown.low, shown.high,
                     shown.longest, fmt::join(colours, R"(",")"), fmt::join(arrows, R"(",")"));
}

/// A slider, and the script that it works with what that shows.
struct Film {
  std::string slider, script;
};

/// Empty where there is nothing that changes in time, or too much for a page.
Film film_of(const Cells& cells, const std::vector<const KindOfMap*>& shown, const Table& in_time) {
  constexpr std::size_t most = 100'000;  // cells of all stretches: 1.4 MB
  const std::size_t count = cells.across * cells.up;
  const Column* const time = find_column(in_time, "time");
  if (time == nullptr || time->values.size() < 2 * count || time->values.size() > most || time->values.size() % count != 0)
    return {};
  std::vector<double> times;
  for (std::size_t k = 0; k < time->values.size(); k += count) times.push_back(time->values[k]);
  std::vector<std::string> frames, colours;
  for (const KindOfMap* const kind : shown) {
    const std::optional<Shown> stretches = shown_of(in_time, *kind);
    if (!stretches) return {};
    frames.push_back(frames_of(*stretches, count));
  }
  for (int level = 0; level < 256; ++level) colours.push_back(hex(scale_colour(level / 255.0)));
  Film film;
  film.slider = fmt::format(R"(<p class="film"><button id="play">Play</button>
<input id="time" type="range" min="0" max="{}" value="0" aria-label="Stretch of the run">
<output id="stretch">average of the run</output></p>
)",
                            times.size());
  film.script = fmt::format(R"(<script type="application/json" id="film">
{{"across":{},"up":{},"width":{},"height":{},"times":[{}],"colours":["{}"],"maps":[{}]}}
</script>
)",
                            cells.across, cells.up, cells.width * cells.scale(), cells.height * cells.scale(),
                            fmt::join(times, ","), fmt::join(colours, R"(",")"), fmt::join(frames, ","));
  for (const char* const file : {"page/errors.js", "page/field_film.js"})
    film.script += "<script>\n" + detail::embedded_text(file) + "</script>\n";
  return film;
}

}  // namespace

std::optional<std::string> field_maps(const Table& fields, const Table* in_time) {
  const std::optional<Cells> cells = cells_of(fields);
  if (!cells) return {};
  std::string figures;
  std::vector<const KindOfMap*> kinds_shown;
  for (const KindOfMap& kind : kinds_of_maps)
    if (const std::optional<Shown> shown = shown_of(fields, kind)) {
      figures += map_of(*cells, kind, *shown);
      kinds_shown.push_back(&kind);
    }
  if (figures.empty()) return {};
  const Film film = in_time == nullptr ? Film{} : film_of(*cells, kinds_shown, *in_time);
  std::string stops;
  for (int k = 0; k <= 8; ++k) stops += (k == 0 ? "" : ",") + hex(scale_colour(k / 8.0));
  return R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Maps of the fields</title><style>
:root { color-scheme: light dark }
body { margin: 0; padding: 1rem; font: 1rem/1.4 system-ui, sans-serif; background: #fff; color: #1b2330 }
.maps { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(15rem, 100%), 1fr)); gap: 1.2rem; align-items: start }
figure { margin: 0 }
svg { display: block; width: 100%; max-height: 32rem }
figcaption { min-height: 3.6em; font-size: .9rem }
.film { margin: 0 0 1rem; display: flex; flex-wrap: wrap; gap: .8rem; align-items: center; font-size: .9rem }
#time { flex: 1 1 12rem }
#play { min-width: 5em; padding: .3rem .6rem }
#stretch { min-width: 12em }
.scale { display: inline-block; width: 5em; height: .7em; background: linear-gradient(to right, )" +
         stops + R"() }
@media (prefers-color-scheme: dark) { body { background: #12161c; color: #e6eaf0 } }
</style></head><body>
)" + film.slider +
         "<div class=\"maps\">" + figures + "</div>\n" + film.script + "</body></html>\n";
}

std::optional<Table> profile_of_fields(const Table& fields) {
  const bool along_x = !all_equal(fields.columns[0].values), along_y = !all_equal(fields.columns[1].values);
  if (along_x && along_y) return {};
  Table profile = fields;
  profile.columns.erase(profile.columns.begin() + (along_x ? 1 : 0));
  return profile;
}

}  // namespace carom
