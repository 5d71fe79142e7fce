#include "text/table.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace carom {

namespace {

/// Returns the number of characters of UTF-8 text.
std::size_t width_of(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & '\xC0') != '\x80'; }));
}

}  // namespace

void TerminalTable::add(std::vector<std::string> cells) {
  if (cells.size() > widths_.size()) throw std::invalid_argument("a row has more cells than the table has columns");
  const std::size_t aligned = cells.size() < widths_.size() ? std::max<std::size_t>(cells.size(), 1) - 1 : cells.size();
  for (std::size_t c = 0; c < aligned; ++c) widths_[c] = std::max(widths_[c], width_of(cells[c]));
  rows_.push_back(std::move(cells));
}

std::string TerminalTable::text() const {
  std::string text;
  for (const std::vector<std::string>& cells : rows_) {
    std::string line;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const bool is_free = c + 1 == cells.size() && cells.size() < widths_.size();
      const std::string space(is_free ? 0 : widths_[c] - width_of(cells[c]), ' ');
      line += "  " + (alignment_[c] == 'r' ? space + cells[c] : cells[c] + space);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

}  // namespace carom
