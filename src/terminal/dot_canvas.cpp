#include "terminal/dot_canvas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace carom {

namespace {

/// U+2800 and eight bits, one per dot.
void append_braille(std::string& text, std::uint8_t dots) {
  text += '\xE2';
  text += static_cast<char>(0xA0 | (dots >> 6));
  text += static_cast<char>(0x80 | (dots & 0x3F));
}

constexpr int shades = 9;

}  // namespace

std::string colour_sequence(double shade, TerminalColours colours) {
  if (colours == TerminalColours::none) return {};
  using Shades = std::array<double, 3>;
  constexpr Shades slow = {75, 125, 230}, middle = {160, 160, 160}, fast = {240, 130, 20};
  const double x = 2.0 * std::clamp(shade, 0.0, 1.0);
  const auto mix = [&](std::size_t part) {
    const double value =
        x < 1.0 ? slow[part] + x * (middle[part] - slow[part]) : middle[part] + (x - 1.0) * (fast[part] - middle[part]);
    return static_cast<int>(std::lround(value));
  };
  if (colours == TerminalColours::all) return fmt::format("\x1b[38;2;{};{};{}m", mix(0), mix(1), mix(2));
  const auto level = [](int value) { return value < 48 ? 0 : value < 115 ? 1 : (value - 35) / 40; };  // of xterm's colour cube
  return fmt::format("\x1b[38;5;{}m", 16 + 36 * level(mix(0)) + 6 * level(mix(1)) + level(mix(2)));
}

DotCanvas::DotCanvas(int columns, int rows)
    : columns_(columns), rows_(rows), cells_(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)) {}

/// Returns the cell of a dot that is now there; null off the canvas.
DotCanvas::Cell* DotCanvas::set(double x, double y) {
  if (!(x >= 0.0 && x < width() && y >= 0.0 && y < height())) return nullptr;
  const auto column = static_cast<unsigned>(x), row = static_cast<unsigned>(y);
  static constexpr std::array<std::array<std::uint8_t, 4>, 2> bits = {{{0x01, 0x02, 0x04, 0x40}, {0x08, 0x10, 0x20, 0x80}}};
  Cell& cell = cells_[static_cast<std::size_t>(row / 4) * static_cast<std::size_t>(columns_) + column / 2];
  cell.dots |= bits[column % 2][row % 4];
  return &cell;
}

void DotCanvas::disk(const Eigen::Vector2d& centre, double radius, double shade) {
  const auto shaded = [&](Cell* cell) {
    if (cell == nullptr) return;
    cell->shades += static_cast<float>(shade);
    cell->shaded += 1.0F;
  };
  shaded(set(centre.x(), centre.y()));
  if (!(radius >= 0.5)) return;
  const double left = std::max(std::floor(centre.x() - radius), 0.0), right = std::min(centre.x() + radius, width() - 0.5);
  const double top = std::max(std::floor(centre.y() - radius), 0.0), bottom = std::min(centre.y() + radius, height() - 0.5);
  for (double y = top + 0.5; y <= bottom; y += 1.0)
    for (double x = left + 0.5; x <= right; x += 1.0)
      if ((Eigen::Vector2d(x, y) - centre).squaredNorm() <= radius * radius) shaded(set(x, y));
}

void DotCanvas::line(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const double steps = std::min(std::ceil((to - from).cwiseAbs().maxCoeff()), 4.0 * (width() + height()));
  for (double k = 0.0; k <= steps; k += 1.0) {
    const Eigen::Vector2d point = from + (steps > 0.0 ? k / steps : 0.0) * (to - from);
    set(point.x(), point.y());
  }
}

void DotCanvas::circle(const Eigen::Vector2d& centre, double radius) {
  const double steps = std::clamp(std::ceil(2.0 * std::numbers::pi * radius), 4.0, 4.0 * (width() + height()));
  for (double k = 0.0; k < steps; k += 1.0) {
    const double angle = 2.0 * std::numbers::pi * k / steps;
    set(centre.x() + radius * std::cos(angle), centre.y() + radius * std::sin(angle));
  }
}

std::vector<std::string> DotCanvas::text(TerminalColours colours) const {
  std::vector<std::string> rows;
  for (int row = 0; row < rows_; ++row) {
    std::string text;
    int current = -1;  // of the shades; -1 for the colour of text
    for (int column = 0; column < columns_; ++column) {
      const Cell& cell =
          cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column)];
      if (cell.dots == 0) {
        text += ' ';
        continue;
      }
      const int shade = cell.shaded > 0.0F && colours != TerminalColours::none
                            ? static_cast<int>(std::lround(cell.shades / cell.shaded * (shades - 1)))
                            : -1;
      if (shade != current) text += shade < 0 ? "\x1b[39m" : colour_sequence(static_cast<double>(shade) / (shades - 1), colours);
      current = shade;
      append_braille(text, cell.dots);
    }
    if (current >= 0) text += "\x1b[39m";
    rows.push_back(std::move(text));
  }
  return rows;
}

}  // namespace carom
