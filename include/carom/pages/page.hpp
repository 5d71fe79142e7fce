#pragma once
// A page of results as plain data, and its HTML: one file that opens anywhere, without a network.
//
// All text is plain text: it is escaped, so scene titles and paths may hold anything. Text between `backquotes` in a
// paragraph or a caption is set as code. Every member has a default, so that designated initialisers name what they need.

#include <carom/version.hpp>

#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace carom {

struct Axis {
  std::string title = {};  ///< title with its unit
  bool log = false;        ///< then points at zero and below are left out of the plot
};

enum class Style {
  line,
  dashed,  ///< a dashed line
  points,
  levels,  ///< a short horizontal line at each point
  line_and_points,
  band,  ///< a line in a shaded region from y_low to y_high
};

/// One curve. A point that is not finite is not drawn, and interrupts a line; the page still lists its other numbers.
struct Series {
  std::string name = {};
  std::vector<double> x = {};
  std::vector<double> y = {};
  std::vector<double> y_low = {};        ///< error bars, or the region of a band; empty, or as long as x, like y_high
  std::vector<double> y_high = {};       ///< these are values, not differences from y
  std::vector<std::string> labels = {};  ///< a line of text per point, shown where the mouse is; empty, or as long as x
  Style style = Style::line_and_points;
  int group = 0;        ///< colour and symbol: the same number is the same method in every plot of a page; 0 or more, 8 differ
  bool visible = true;  ///< false: only named in the legend until the reader clicks there
};

/// A reference line across the plot.
struct Mark {
  enum class Across { x, y };  ///< the axis that `value` belongs to: x is an upright line
  Across axis = Across::y;
  double value = 0.0;
  std::string label = {};
};

struct Plot {
  std::string id = {};  ///< names the plot's numbers in the page: lower-case letters, digits and hyphens; unique in the page
  std::string title = {};
  std::string caption = {};  ///< one sentence below the plot
  Axis x = {};
  Axis y = {};
  std::vector<Series> series = {};
  std::vector<Mark> marks = {};
};

struct TextTable {
  std::string title = {};
  std::vector<std::string> columns = {};            ///< headings; where all are empty, there is no row of them
  std::vector<std::vector<std::string>> rows = {};  ///< rows with as many cells as columns; the first cell names the row
  std::string caption = {};
};

struct Paragraph {
  std::string text = {};
};

/// Text as it is, folded away until the reader opens it: a scene, a command.
struct Listing {
  std::string title = {};
  std::string text = {};
};

/// A whole page of another kind within this one, in a frame: its scripts and styles end at the frame.
struct EmbeddedPage {
  std::string title = {};
  std::string html = {};  ///< UTF-8, with a content security policy no narrower than that of html_page()
};

using Block = std::variant<Paragraph, Plot, TextTable, Listing, EmbeddedPage>;

struct Section {
  std::string heading = {};
  std::vector<Block> blocks = {};
};

/// A result in large figures at the top of the page.
struct KeyNumber {
  std::string value = {};
  std::string label = {};
};

/// Names and values that say where results come from.
using Facts = std::vector<std::pair<std::string, std::string>>;

struct Page {
  std::string generator = {};  ///< the command that makes such pages, near the beginning of the file; empty: nothing is said
  std::string title = {};
  std::string subtitle = {};
  std::string lead = {};  ///< the answer in a few sentences
  std::vector<KeyNumber> key_numbers = {};
  std::vector<Section> sections = {};
  Facts facts = {};  ///< the sources of the results, at the foot of the page
};

/// Adds the program that made the results, and its compiler.
void add_build(Facts& facts, const BuildInfo& build = build_info());

/// Returns the page as one HTML file, about 1.2 MB and its numbers. Throws std::invalid_argument where lengths differ that must
/// not, a group is negative, or an id is unfit or there twice.
std::string html_page(const Page& page);

}  // namespace carom
