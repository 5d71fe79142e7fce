#include "scene/csv_table.hpp"

#include "scene/excerpt.hpp"
#include "text/number_in.hpp"

#include <algorithm>
#include <cmath>

namespace carom::detail {
namespace {

void split(std::string_view line, std::vector<CsvField>& fields) {
  fields.clear();
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t first = std::min(line.find_first_not_of(" \t", begin), line.size());
    const std::size_t closing = first < line.size() && line[first] == '"' ? line.find('"', first + 1) : std::string_view::npos;
    const bool is_quoted = closing != std::string_view::npos;
    const std::size_t end = std::min(line.find(',', is_quoted ? closing : begin), line.size());
    std::string_view text = trimmed(line.substr(begin, end - begin));
    int column = static_cast<int>(text.empty() ? begin : static_cast<std::size_t>(text.data() - line.data())) + 1;
    if (is_quoted && text.ends_with('"')) text = trimmed(text.substr(1, text.size() - 2)), ++column;
    fields.push_back({text, column});
    begin = end + 1;
  }
}

}  // namespace

std::optional<double> finite_number_in(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+')
    text.remove_prefix(1);  // from_chars takes no plus sign
  const std::optional<double> value = number_in<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

CsvTable::CsvTable(std::string_view text) : text_(text) {
  if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
}

std::optional<CsvRow> CsvTable::header(const std::function<bool(std::string_view)>& is_name) {
  if (!read_row()) return {};
  if (!finite_number_in(row_.fields.front().text)) return row_;
  const std::size_t begin = std::min(comment_.find_first_not_of("# \t"), comment_.size());
  CsvRow names{.fields = {}, .line = comment_line_};
  split(comment_.substr(begin), names.fields);
  if (std::none_of(names.fields.begin(), names.fields.end(), [&](const CsvField& field) { return is_name(field.text); }))
    return row_;
  for (CsvField& field : names.fields) field.column += static_cast<int>(begin);
  is_pending_ = true;
  return names;
}

const CsvRow* CsvTable::next() {
  if (is_pending_) {
    is_pending_ = false;
    return &row_;
  }
  return read_row() ? &row_ : nullptr;
}

bool CsvTable::read_row() {
  comment_ = {};
  while (!text_.empty()) {
    const std::size_t end = std::min(text_.find('\n'), text_.size());
    std::string_view line = text_.substr(0, end);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    ++line_number_;
    if (line.ends_with('\r')) line.remove_suffix(1);
    const std::string_view content = trimmed(line);
    if (content.starts_with('#')) {
      comment_ = line;
      comment_line_ = line_number_;
    } else if (!content.empty()) {
      split(line, row_.fields);
      row_.line = line_number_;
      return true;
    }
  }
  return false;
}

}  // namespace carom::detail
