#pragma once
// A picture made of the Unicode braille patterns: every character of a terminal is two dots wide and four high, and has one
// colour.

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace carom {

/// The colours that a terminal can show.
enum class TerminalColours { none, palette, all };  ///< palette: the 256 of xterm

class DotCanvas {
 public:
  /// Requires columns and rows >= 1.
  DotCanvas(int columns, int rows);

  [[nodiscard]] int width() const { return 2 * columns_; }  ///< in dots
  [[nodiscard]] int height() const { return 4 * rows_; }

  /// All dots whose middle lies in the disk, and at least the nearest one. In units of dots, y downwards, (0, 0) the upper left
  /// corner of the first dot. What is off the canvas is left out. `shade` is a colour from 0 (slow) to 1 (fast).
  void disk(const Eigen::Vector2d& centre, double radius, double shade);

  /// A straight line and a circle in the colour of text.
  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to);
  void circle(const Eigen::Vector2d& centre, double radius);

  /// One string of `columns` characters for each row; a character has the mean shade of the dots in it.
  [[nodiscard]] std::vector<std::string> text(TerminalColours colours) const;

 private:
  struct Cell {
    std::uint8_t dots = 0;
    float shades = 0.0F;
    float shaded = 0.0F;  ///< how many shades were added
  };
  Cell* set(double x, double y);

  int columns_, rows_;
  std::vector<Cell> cells_;
};

/// Returns the escape sequence that begins a colour, from blue (0) through grey to orange (1), which colour-blind readers can
/// tell apart on dark and light terminals; empty without colours.
[[nodiscard]] std::string colour_sequence(double shade, TerminalColours colours);

}  // namespace carom
