#include "pages/layout.hpp"

#include <algorithm>
#include <cmath>

namespace carom {

namespace {

struct Borders {
  double line, margin, letters, caption;
};

/// Returns borders in proportion to the picture, but never too small to be read.
Borders borders(int longer, bool caption) {
  const double line = std::max(1.0, std::round(longer / 360.0));
  const double letters = caption ? std::clamp(std::round(longer / 50.0), 11.0, 60.0) : 0.0;
  return {.line = line, .margin = std::ceil(3.0 * line + 4.0), .letters = letters, .caption = std::ceil(1.5 * letters)};
}

double width_of(const std::array<double, 4>& extent) { return extent[1] - extent[0]; }
double height_of(const std::array<double, 4>& extent) { return extent[3] - extent[2]; }

}  // namespace

PictureSize fitted_size(const std::array<double, 4>& extent, int longer, bool caption) {
  const Borders border = borders(longer, caption);
  const double aside = 2.0 * border.margin, above = aside + border.caption;
  const double scale = std::min((longer - aside) / width_of(extent), (longer - above) / height_of(extent));
  // A tall box leaves room for its clock.
  const double narrowest = std::min<double>(longer, 16.0 * border.letters);
  const auto pixels = [&](double length, double least) {
    return static_cast<int>(std::clamp(std::round(length), std::max(2.0, least), static_cast<double>(longer)));
  };
  return {pixels(width_of(extent) * scale + aside, narrowest), pixels(height_of(extent) * scale + above, above + 1.0)};
}

Layout layout_of(const std::array<double, 4>& extent, const PictureSize& size, bool caption) {
  const Borders border = borders(std::max(size.width, size.height), caption);
  const double wide = std::max(1.0, size.width - 2.0 * border.margin);
  const double high = std::max(1.0, size.height - 2.0 * border.margin - border.caption);
  const double scale = std::min(wide / width_of(extent), high / height_of(extent));
  Layout layout{.size = size, .scale = scale, .extent = extent, .line = border.line, .letters = border.letters};
  // Edges on whole pixels are sharp.
  layout.left = std::floor(0.5 * (size.width - width_of(extent) * scale));
  layout.top = std::floor(0.5 * (size.height - border.caption - height_of(extent) * scale));
  layout.caption_top = layout.top + height_of(extent) * scale + 2.0 * border.line;
  layout.caption_right = size.width - border.margin;
  return layout;
}

}  // namespace carom
