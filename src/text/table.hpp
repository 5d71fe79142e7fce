#pragma once
// Tables of the terminal.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace carom {

/// Rows of cells as lines of text, with every column as wide as its widest cell and two spaces between columns.
class TerminalTable {
 public:
  /// `alignment` holds a letter for each column: l for left, r for right.
  explicit TerminalTable(std::string_view alignment) : alignment_(alignment), widths_(alignment.size(), 0) {}

  /// Adds a row. A row with fewer cells than columns ends in free text, which may be wider than its column; one without cells is
  /// an empty line. Throws std::invalid_argument for more cells than columns.
  void add(std::vector<std::string> cells);

  /// Returns the lines, each of which begins with two spaces and ends without any.
  [[nodiscard]] std::string text() const;

 private:
  std::string alignment_;
  std::vector<std::size_t> widths_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace carom
